// SweepChannel: the settings of one video channel of an interface board.
#pragma once

#include <cstdint>

namespace skerry::echo {

enum class VideoDetector : std::uint8_t { log, linear };
// What becomes of the codes of a group of ticks.
enum class CodeDecimation : std::uint8_t { peak, mean, sum };

struct SweepChannel {
  double sample_clock_hz = 20e6;
  std::uint32_t delay_ticks = 0;  // range of the first sample
  std::uint32_t samples = 2048;   // after decimation
  std::uint32_t decimation = 1;
  CodeDecimation mode = CodeDecimation::peak;
  VideoDetector detector = VideoDetector::log;
  unsigned bits = 12;
  bool inverted = false;
  double gain_db = 0.0;
  double offset = 0.0;  // steps
  double stc = 0.0;     // 0 .. 100, as the sea control
  friend bool operator==(const SweepChannel&, const SweepChannel&) = default;
};

}  // namespace skerry::echo
