// Checks for every input of a fuzz target, and numbers drawn from the input.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <span>

namespace skerry::fuzz {

// Ends the program if `holds` is false: libFuzzer then keeps the input.
inline void require(bool holds, const char* what) {
  if (holds) return;
  std::fprintf(stderr, "fuzz: does not hold: %s\n", what);
  std::abort();
}

// Numbers that depend on the input alone (FNV-1a, then a linear congruence), for choices such as
// where to cut a stream.
class Choices {
 public:
  explicit Choices(std::span<const std::uint8_t> input) {
    for (const std::uint8_t byte : input) state_ = (state_ ^ byte) * 0x100000001B3;
  }
  // 0 .. count-1.  Requires count > 0.
  std::size_t below(std::size_t count) {
    state_ = state_ * 6364136223846793005 + 1442695040888963407;
    return static_cast<std::size_t>(state_ >> 33) % count;
  }

 private:
  std::uint64_t state_ = 0xCBF29CE484222325;
};

}  // namespace skerry::fuzz
