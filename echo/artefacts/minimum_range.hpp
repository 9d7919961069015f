// MinimumRange: the receiver is deaf while the transmitter fires and for a moment after.
#pragma once

#include <span>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// The first RadarModel::blind_cells see nothing, c (tau + 0.1 us) / 2.  Behind them the TR cell
// still takes kTailDb, dying away as exp(-t / kTailSeconds).
// Source: SOURCES.md "Artefacts" for the blind range; the tail is an assumption, short enough that
// a buoy at 40 m is seen (MSC.192: from 40 m).
inline constexpr double kTailDb = 6.0;
inline constexpr double kTailSeconds = 0.05e-6;  // 7.5 m

class MinimumRange {
 public:
  explicit MinimumRange(const RadarModel& model);

  // Cost: the cells of the first 75 m or so.  Thread: any.
  void apply(const Artefacts& artefacts, std::span<float> power) const;

 private:
  std::vector<float> factors_;  // of the first cells
};

}  // namespace skerry::echo
