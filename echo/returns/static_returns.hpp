// StaticReturns: land and what is built on it, made seldom and moved between.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/parallel_for.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// Mean power of coast, land and structures behind beam and pulse, kept by true bearing.  A row is
// made afresh when the own ship has sailed too far from where it was made; until then it is moved
// to where she is now.
class StaticReturns {
 public:
  StaticReturns(const RadarModel& model, ParallelFor parallel);
  ~StaticReturns();

  // Makes what spokes first .. first + count - 1 need.  Thread: the radar's.
  void prepare(const Scene& scene, std::uint64_t first, std::uint32_t count);

  // Mean signal-to-noise ratio of that spoke, added to power[i].  Returns false, nothing done,
  // where nothing echoes.  Thread: any, after prepare().
  bool add(const Scene& scene, const SpokeAim& aim, std::span<float> power) const;

  // Height over the water below which land hides what is at that place, metres; 0 over open water
  // and within sight.  The Earth's own curve apart.  Thread: any, after prepare().
  float hidden_height(std::uint32_t plane_units, double range_m) const;

 private:
  struct Rows;
  std::unique_ptr<Rows> rows_;
};

}  // namespace skerry::echo
