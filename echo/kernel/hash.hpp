// Counter-based randomness: every random number is a pure function of what it is for.
#pragma once

#include <cstdint>

namespace skerry::echo {

// SplitMix64's finaliser (Steele, Lea, Flood 2014): a bijection, good in all bits.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}
constexpr std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return mixed(mixed(a) ^ b); }
constexpr std::uint64_t mixed(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return mixed(mixed(a, b) ^ c);
}

// In [0, 1), 53 bits.
constexpr double as_unit(std::uint64_t hash) { return static_cast<double>(hash >> 11) * 0x1p-53; }

}  // namespace skerry::echo
