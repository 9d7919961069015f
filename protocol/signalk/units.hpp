// Signal K speaks SI, Skerry's messages degrees.
#pragma once

#include <numbers>

namespace skerry::signalk {

// rad; one degree.
inline constexpr double kRadian = std::numbers::pi / 180.0;

}  // namespace skerry::signalk
