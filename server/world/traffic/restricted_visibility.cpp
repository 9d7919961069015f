#include "server/world/traffic/restricted_visibility.hpp"

#include <algorithm>
#include <cmath>

#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr double kBeam_deg = 90.0;
constexpr double kAstern_deg = 5.0;  // either side of right astern no turn is towards her
constexpr double kSteerageWay_kn = 6.0;
constexpr double kLeastShare = 0.5;  // of her speed, at no visibility

}  // namespace

OpenSides open_sides(std::span<const Unseen> others) {
  OpenSides open;
  for (const Unseen& other : others) {
    const double off_bow_deg = std::fabs(other.relative_deg);
    if (off_bow_deg > 180.0 - kAstern_deg) continue;
    if (off_bow_deg < kBeam_deg) {
      if (!other.is_overtaken) open.port = false;
    } else if (other.relative_deg > 0.0) {
      open.starboard = false;
    } else {
      open.port = false;
    }
  }
  return open;
}

double safe_speed_mps(double speed_mps, const Visibility& visibility) {
  if (!visibility.has_fog()) return speed_mps;
  const double share = kLeastShare + (1.0 - kLeastShare) * visibility.by_eye_m / kFog_m;
  return std::min(speed_mps, std::max(share * speed_mps, knots_in_mps(kSteerageWay_kn)));
}

}  // namespace skerry::server
