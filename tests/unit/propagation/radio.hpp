// Units of the tests of propagation: metres.
#pragma once

namespace skerry::echo {

inline constexpr double kMile = 1852.0;
inline constexpr double kEarth = 6371000.0 * 4.0 / 3.0;  // effective radius in the standard air
inline constexpr double kX = 299792458.0 / 9.41e9, kS = 299792458.0 / 3.05e9;  // wavelengths

}  // namespace skerry::echo
