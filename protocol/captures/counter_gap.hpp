// CounterGap: spokes missing from a capture, read off a counter that the packets bear.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/quantity/time.hpp"

namespace skerry::captures {

// A counter of `modulus` values, +1 per spoke.  A jump is believed only if the time since the spoke
// before is less than a turn and the jump too: otherwise the radar stopped, or began anew.
class CounterGap {
 public:
  CounterGap(std::uint64_t modulus, std::uint32_t most) : modulus_(modulus), most_(most) {}

  // Spokes missing before this one.
  std::uint32_t take(std::uint64_t counter, UtcTime time, Duration turn) {
    std::uint32_t missing = 0;
    const Duration longest = turn > Duration{} ? turn : std::chrono::seconds(1);
    if (last_ && time - last_time_ < longest) {
      const std::uint64_t steps = (counter % modulus_ + modulus_ - *last_) % modulus_;
      if (steps > 0 && steps - 1 <= most_) missing = static_cast<std::uint32_t>(steps - 1);
    }
    last_ = counter % modulus_;
    last_time_ = time;
    return missing;
  }

 private:
  std::uint64_t modulus_;
  std::uint32_t most_;
  std::optional<std::uint64_t> last_;
  UtcTime last_time_{};
};

}  // namespace skerry::captures
