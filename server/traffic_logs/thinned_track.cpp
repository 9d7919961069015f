#include "server/traffic_logs/thinned_track.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/world/short_way.hpp"

namespace skerry::server {

LogFix log_fix(std::int64_t utc_ms, GeoPoint place) {
  return {utc_ms, static_cast<std::int32_t>(std::lround(place.latitude_deg * 1e7)),
          static_cast<std::int32_t>(std::lround(place.longitude_deg * 1e7))};
}

double metres_off(const LogFix& from, const LogFix& to, const LogFix& fix) {
  const double share =
      static_cast<double>(fix.utc_ms - from.utc_ms) / static_cast<double>(to.utc_ms - from.utc_ms);
  const GeoPoint begin = from.place(), end = to.place();
  const GeoPoint sailed = {
      begin.latitude_deg + share * (end.latitude_deg - begin.latitude_deg),
      wrapped_longitude(begin.longitude_deg +
                        share * std::remainder(end.longitude_deg - begin.longitude_deg, 360.0))};
  const ShortWay way = short_way_between(sailed, fix.place());
  return std::hypot(way.north_m, way.east_m);
}

Thinned thin(std::span<const LogFix> fixes, double tolerance_m) {
  Thinned thinned;
  const std::size_t last = fixes.size() - 1;
  thinned.kept.push_back(last);
  std::vector<std::pair<std::size_t, std::size_t>> legs = {{0, last}};
  while (!legs.empty()) {
    const auto [from, to] = legs.back();
    legs.pop_back();
    double worst_m = 0.0;
    std::size_t worst = from;
    for (std::size_t i = from + 1; i < to; ++i) {
      const double off_m = metres_off(fixes[from], fixes[to], fixes[i]);
      if (off_m > worst_m) {
        worst_m = off_m;
        worst = i;
      }
    }
    if (worst_m > tolerance_m) {
      legs.push_back({from, worst});
      legs.push_back({worst, to});
    } else {
      thinned.kept.push_back(from);
      thinned.worst_m = std::max(thinned.worst_m, worst_m);
    }
  }
  std::sort(thinned.kept.begin(), thinned.kept.end());
  return thinned;
}

}  // namespace skerry::server
