// Binary angles as numbers: 2^32 units are one turn (protocol/quantity/bearing.hpp).
#pragma once

#include <cstdint>
#include <numbers>

namespace skerry::echo {

inline constexpr double kUnitsPerTurn = 4294967296.0;
inline constexpr double kUnitsPerDegree = kUnitsPerTurn / 360.0;
inline constexpr double kUnitsPerRadian = kUnitsPerTurn / (2.0 * std::numbers::pi);
inline constexpr double kDegreesPerUnit = 360.0 / kUnitsPerTurn;
inline constexpr std::uint32_t kHalfTurn = 1u << 31;  // units

}  // namespace skerry::echo
