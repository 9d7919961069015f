// CodeGroups: decimation of a converter's codes as they come.
#pragma once

#include <cstdint>
#include <span>

namespace skerry::echo {

enum class VideoDetector : std::uint8_t { log, linear };
// How the codes of a group of ticks are combined.
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

// Codes come in pieces of any length; every `group` of them make one of `out`, in exact integers:
// the largest, the mean rounded to the nearest (halves upwards) or the sum, 65535 at most.
// Thread: one at a time.
class CodeGroups {
 public:
  // group: 1 .. 65536.
  CodeGroups(CodeDecimation mode, std::uint32_t group, std::span<std::uint16_t> out)
      : mode_(mode), group_(group), out_(out) {}

  // Drops groups that do not fit into `out`.
  void add(std::span<const std::uint16_t> codes);

 private:
  void begin_or_end(std::span<const std::uint16_t> codes);

  CodeDecimation mode_;
  std::uint32_t group_;
  std::span<std::uint16_t> out_;        // what is still to be made
  std::uint32_t value_ = 0, held_ = 0;  // of the group that is begun
};

}  // namespace skerry::echo
