#include "server/world/logged_checks.hpp"

#include <fmt/format.h>

#include "protocol/quantity/length.hpp"
#include "server/world/route_checks.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {

void check_logged(const scenario::Target& target, const std::string& path, YamlSource& source) {
  if (target.waypoints().empty()) {
    source.refuse(path + ".as_logged", "given without waypoints; allowed: with them");
    return;
  }
  for (const char* key : {".speed_kn", ".anchored", ".follows", ".fishes_within_nm", ".along_nm",
                          ".gives_way", ".route_end"}) {
    if (!source.has(path + key)) continue;
    source.refuse(path + key, "given besides as_logged; allowed: one of the two");
  }
  if (!source.is_sound(path)) return;
  double leaves_min = target.start_min();
  GeoPoint from = geo_point(target.position());
  for (int i = 0; i < target.waypoints_size(); ++i) {
    const wire::Waypoint& waypoint = target.waypoints(i);
    const std::string to_path = fmt::format("{}.waypoints[{}]", path, i);
    for (const char* key : {".speed_kn", ".stop_min"}) {
      if (!source.has(to_path + key)) continue;
      source.refuse(to_path + key, "given besides as_logged; allowed: arrive_min alone");
    }
    if (!waypoint.has_arrive_min()) {
      source.refuse(to_path + ".arrive_min", "missing; as_logged needs it at each waypoint");
      return;
    }
    const double takes_min = waypoint.arrive_min() - leaves_min;
    if (takes_min <= 0.0) {
      source.refuse(to_path + ".arrive_min",
                    fmt::format("{} min; allowed: later than {} min, when she leaves for it",
                                waypoint.arrive_min(), leaves_min));
      return;
    }
    const double speed_kn =
        60.0 * distance_between(from, geo_point(waypoint)).in_nautical_miles() / takes_min;
    if (speed_kn > kMostLoggedSpeed_kn) {
      source.refuse(to_path + ".arrive_min",
                    fmt::format("she would need {:.0f} kn to be there at {} min; allowed: up to "
                                "{:.0f} kn",
                                speed_kn, waypoint.arrive_min(), kMostLoggedSpeed_kn));
    }
    leaves_min = waypoint.arrive_min();
    from = geo_point(waypoint);
  }
}

bool are_parts_of_a_log(const scenario::Target& one, const scenario::Target& other) {
  if (!one.as_logged() || !other.as_logged()) return false;
  if (one.waypoints().empty() || other.waypoints().empty()) return false;
  const auto end_min = [](const scenario::Target& target) {
    return target.waypoints(target.waypoints_size() - 1).arrive_min();
  };
  return end_min(one) <= other.start_min() || end_min(other) <= one.start_min();
}

}  // namespace skerry::server
