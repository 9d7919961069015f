// SpokeReturns: all that a radar's spokes bring back, before any receiver.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/artefacts/radar_faults.hpp"
#include "echo/kernel/parallel_for.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// Rows of power, one per spoke: instantaneous echo power over the receiver's mean noise, at the
// cells of the radar's range scale, shared by all views of the radar.  >= 0, < 1e30.
struct PowerRows {
  std::uint64_t first = 0;  // spoke, from the antenna's start
  std::uint32_t count = 0;
  std::size_t pitch = 0;  // floats from row to row: not a multiple of 4 KiB
  std::span<const float> cells;
  // How fast what echoes in a cell comes nearer, m/s (radial_speeds.hpp); empty unless wanted.
  std::span<const float> closing = {};
};

// Joins what echoes (land, sea, rain, targets, beacons) and what is not there (false echoes) to the
// power of each spoke.  A contributor of which the scene has nothing costs one branch.
// The rows are a pure function of the sequence of (Scene, sector), for any number of threads and
// any instruction set.  Thread: one at a time.
class SpokeReturns {
 public:
  // The range scale of `model` is the one that the pulses are for.
  SpokeReturns(const RadarModel& model, ParallelFor parallel);
  ~SpokeReturns();
  SpokeReturns(SpokeReturns&&) noexcept;
  SpokeReturns& operator=(SpokeReturns&&) noexcept;

  const RadarModel& model() const;

  // The loss of echoes by detuning, dB >= 0; SARTs and other radars keep their strength.
  void set_tune_loss(double db);

  // What is wrong with the set; nothing at first.  The tune that a fault loses is besides that
  // above, and acts on what it acts on.
  void set_faults(const RadarFaults& faults);

  // Whether rows come with radial speeds; not at first.
  void set_doppler(bool wanted);

  // Rows of spokes first .. first + count - 1, valid until the next call.  count: 1 to kMaxSector.
  // scene.index is not read here: it serves is_ashore().
  // Rows that the last call made ahead of this one's first are not made again, whatever has become
  // of the scene.
  static constexpr std::uint32_t kMaxSector = 128;
  PowerRows make(const Scene& scene, std::uint64_t first, std::uint32_t count);
  // The rows last made have been seen up to spoke `from`: their memory goes to whichever radar is
  // next, but for a copy of those made ahead.  Not needed, but a radar that keeps its rows from
  // sector to sector finds them in no near cache.
  void release(std::uint64_t from);

 private:
  struct Sector;
  struct Contributors;
  std::unique_ptr<Contributors> all_;
};

}  // namespace skerry::echo
