// The one door to the echo: from a Scene to the video of a sector.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/parallel_for.hpp"
#include "echo/radar/beam.hpp"
#include "echo/radar/spoke_clock.hpp"
#include "echo/receiver/receiver.hpp"
#include "echo/returns/ray_returns.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// Makes the spokes of one view of one radar, in order.  Rays are made half a beam ahead of the
// spokes and kept until the beam has passed them, each from the Scene in force when it entered; so
// the video is a pure function of the sequence of (Scene, sector), for any number of threads and
// any instruction set.
// Thread: one at a time.
class SpokeRenderer {
 public:
  // Requires a valid geometry.  `radar` tells noise of radars apart.
  SpokeRenderer(const RadarSet& set, const ScanGeometry& geometry, const SpokeClock& clock,
                std::uint32_t radar, ParallelFor parallel = serial_for);

  const ScanGeometry& geometry() const { return geometry_; }
  const ViewControls& controls() const { return controls_; }
  void set_controls(const ViewControls& controls);

  // Video of spokes first .. first + count - 1, counted from the antenna's start (spoke n of scan s
  // is s * spokes_per_turn + n), into video[k * cells ...].  scene.index must serve its own ship.
  void render(const Scene& scene, std::uint64_t first, std::uint32_t count,
              std::span<std::uint8_t> video);

  // Mean signal-to-noise ratio of one ray (numbered from the antenna's start) before beam and
  // receiver: for tests and benches of the geometry.
  void ray_power(const Scene& scene, std::uint64_t ray, std::span<float> power);
  std::uint32_t rays_per_spoke() const { return beam_.per_spoke; }

 private:
  struct Row {
    std::uint64_t ray = ~std::uint64_t{0};
    bool echoes = false;
  };
  std::size_t row_offset(std::uint64_t ray) const { return (ray % rows_.size()) * pitch_; }
  void make_rays(const Scene& scene, std::uint64_t begin, std::uint64_t end);
  void make_spoke(const Scene& scene, std::uint64_t spoke, std::span<std::uint8_t> video) const;

  RadarSet set_;
  ScanGeometry geometry_;
  SpokeClock clock_;
  SpokeClock ray_clock_;
  std::uint32_t radar_;
  ParallelFor parallel_;
  ViewControls controls_;
  RayModel model_;
  Beam beam_;
  Receiver receiver_;
  std::size_t pitch_;      // floats from row to row: not a multiple of 4 KiB
  std::vector<Row> rows_;  // ring of rays by number
  std::vector<float> powers_;
};

}  // namespace skerry::echo
