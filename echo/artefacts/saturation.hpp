// Saturation: the receiver recovers slowly behind an echo it could not take.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// An echo over kSaturationDb drives the receiver beyond its range by so many decibels; it then
// loses as many, dying away as exp(-t / kRecoverySeconds), and what echoes behind is dimmed.
// Source: SOURCES.md "Artefacts": log amplifiers of 80 to 100 dB, an exponential tail.  The level
// within them and the time are assumptions: sets differ.  The receiver's noise is not dimmed.
inline constexpr double kSaturationDb = 90.0;       // over noise
inline constexpr double kRecoverySeconds = 1.0e-6;  // 150 m
// The receiver is driven into no more than this.
inline constexpr double kMostExcessDb = 40.0;

class Saturation {
 public:
  explicit Saturation(const RadarModel& model);

  // Row operation after all echoes.  A row that stays below the level keeps its bits and costs one
  // pass for its peak; returns whether it did not.  Thread: any.
  bool apply(const Artefacts& artefacts, std::span<float> power) const;

 private:
  static constexpr std::size_t kRun = 16;  // cells without a strong echo, dimmed at once

  std::array<float, kRun> decay_;  // of the loss in decibels, 1 cell on, 2, ...
};

}  // namespace skerry::echo
