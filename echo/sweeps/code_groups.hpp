// CodeGroups: decimation of a converter's codes as they come.
#pragma once

#include <cstdint>
#include <span>

#include "echo/sweeps/sweep_channel.hpp"

namespace skerry::echo {

// Codes come in pieces of any length; every `group` of them make one of `out`, in exact integers:
// the largest, the mean rounded to the nearest (halves upwards) or the sum, 65535 at most.
// Thread: one at a time.
class CodeGroups {
 public:
  // group: 1 .. 65536.
  CodeGroups(CodeDecimation mode, std::uint32_t group, std::span<std::uint16_t> out)
      : mode_(mode), group_(group), out_(out) {}

  // What would not fit into `out` is dropped.
  void add(std::span<const std::uint16_t> codes);

 private:
  void begin_or_end(std::span<const std::uint16_t> codes);

  CodeDecimation mode_;
  std::uint32_t group_;
  std::span<std::uint16_t> out_;        // what is still to be made
  std::uint32_t value_ = 0, held_ = 0;  // of the group that is begun
};

}  // namespace skerry::echo
