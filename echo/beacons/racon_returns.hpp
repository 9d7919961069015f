// RaconReturns: radar beacons that answer in Morse.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/beacons/listening.hpp"
#include "echo/beacons/morse.hpp"
#include "echo/radar/antenna_pattern.hpp"

namespace skerry::echo {

// A racon answers a pulse that reaches it over its threshold (one way: EIRP, pattern, propagation),
// in its duty, its sector and its bands, on the radar's own frequency: Morse, drawn outwards from
// delay_s behind the mark.  Its strength is one-way, R^-2, and follows the beam once, so that it is
// about sqrt(2) wider than an echo as strong; the radar's pulse does not lengthen it.  Without
// suppression the side lobes trigger it when it is near: arcs, then rings.
// Sources: SOURCES.md "Beacons" (ITU-R M.824); suppression and threshold are by choice.
// Error: answers to other radars, which may keep it busy, are left out; rain is the caller's.
class RaconReturns {
 public:
  // Suppression: only what comes by this much of the beam's axis or more is answered (-20 dB).
  static constexpr double kSuppressedBelow = 0.01;

  void prepare(const Listening& at);
  bool any() const { return !replies_.empty(); }
  // Thread: any, after prepare().
  void add(const AntennaPattern& pattern, const SpokeAim& aim, float factor,
           std::span<float> power) const;

  // Whether it answers at that time: the first on_s of each period, which begins when its identity
  // says.  In whole nanoseconds: the same after a year as now.
  static bool on_duty(const Racon& racon, ScenarioTime time);
  // Whether a ship at that bearing from the racon is in its sector, clockwise from the plane's
  // north.
  static bool in_sector(const Racon& racon, std::uint32_t bearing_units);

 private:
  struct Reply {
    std::uint32_t bearing_units;
    float level;       // of the axis, from which it is triggered and heard
    float power;       // on the axis, over noise
    double from_cell;  // where the code begins
    double dot_cells;
    MorseMarks code;
  };
  std::vector<Reply> replies_;
};

}  // namespace skerry::echo
