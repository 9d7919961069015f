// The ellipsoid that charts are drawn on.
#pragma once

// Source: NIMA TR8350.2 (2000), table 3.1.
namespace skerry::echo::wgs84 {

inline constexpr double kSemiMajor = 6378137.0;  // metres
inline constexpr double kFlattening = 1.0 / 298.257223563;
inline constexpr double kE2 = kFlattening * (2.0 - kFlattening);  // first eccentricity squared

}  // namespace skerry::echo::wgs84
