// Fluctuation: how an echo changes from one passing of the beam to the next.
#pragma once

#include <algorithm>
#include <cstdint>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/scene/targets.hpp"

namespace skerry::echo {

// Unit-mean exponential out of the upper 24 bits of a hash: 0 to 17.3.
// Error: that of fast_log2, 8.3e-5 absolute.
inline float exponential_of(std::uint64_t hash) {
  const float u = (static_cast<float>(hash >> 40) + 0.5f) * 0x1p-24f;
  return std::max(0.0f, -0.693147181f * fast_log2(u));
}

// Unit-mean power of one passing: 1 (Swerling 0), exponential (Swerling 1) or chi-square of four
// degrees of freedom (Swerling 3).  Constant while the beam passes, new at the next one.  `key`
// names target, radar and passing.  Source: SOURCES.md "Targets".
// Held by Fluctuation.IsOfItsSwerlingCase.
inline float fluctuation_of(Fluctuation kind, std::uint64_t key) {
  switch (kind) {
    case Fluctuation::steady:
      return 1.0f;
    case Fluctuation::rayleigh:
      return exponential_of(key);
    case Fluctuation::one_dominant:
      return 0.5f * (exponential_of(key) + exponential_of(mixed(key, 0x53)));
  }
  return 1.0f;
}

}  // namespace skerry::echo
