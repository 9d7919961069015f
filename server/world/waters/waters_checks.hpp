// What a scenario's tide, streams and banks must be, beyond their ranges.
#pragma once

#include "server/config/config_error.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

inline constexpr int kMaxTidalDiamonds = 64;
inline constexpr int kStreamHours = 13;  // from 6 h before high water to 6 h after it

inline constexpr int kMaxBanks = 64, kMaxBankPoints = 200;  // points of each
inline constexpr double kLongestBankPart_m = 20'000.0;

// Adds to the source: a constituent twice, two kinds of tide, a diamond without its thirteen hours,
// a name twice, water that falls below the least depth of 2 m, a bank of one point, of too many, or
// whose next point is where the last was or more than 20 km from it.
void check_waters(const scenario::Scenario& scenario, YamlSource& source);

}  // namespace skerry::server
