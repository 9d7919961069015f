// Times and lengths that the tests of the watch share.
#pragma once

#include "protocol/quantity/speed.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

inline const UtcTime kBegin{std::chrono::seconds(1'790'000'040)};  // a whole minute
inline UtcTime utc_at(double t_s) { return kBegin + seconds_as_duration(t_s); }

inline constexpr double kNm = Length::kMetresPerNauticalMile;

}  // namespace skerry::server
