// Speed: held in plain m/s, spoken of in knots.
#pragma once

#include "protocol/quantity/length.hpp"

namespace skerry {

// m/s; one nautical mile an hour, as exact as a double is.
inline constexpr double kKnot = Length::kMetresPerNauticalMile / 3600.0;

}  // namespace skerry
