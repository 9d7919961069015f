#include "server/world/traffic/new_target.hpp"

#include <fmt/format.h>

#include "server/world/ship_units.hpp"
#include "server/world/traffic/class_sizes.hpp"
#include "server/world/traffic/traffic_class.hpp"
#include "server/world/traffic/way_faults.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kLongestName = 64;  // as scenario.proto has it

std::string class_wanted(const wire::NewTarget& wanted) {
  return wanted.ship_class().empty() ? "coaster" : wanted.ship_class();
}

}  // namespace

std::optional<std::string> fault_of(const wire::NewTarget& wanted) {
  if (wanted.name().size() > kLongestName) {
    return fmt::format("name: {} bytes; allowed: at most {}", wanted.name().size(), kLongestName);
  }
  const std::string key = class_wanted(wanted);
  const TrafficClass* const found = find_traffic_class(key);
  if (found == nullptr) return complaint_of_class(key);
  const std::string who = fmt::format("a {}", found->key);
  const double most_mps = knots_in_mps(found->most_kn);
  if (auto fault = fault_of_speed(who, wanted.speed_kn(), most_mps)) return fault;
  return fault_of_way(who, {wanted.latitude_deg(), wrapped_longitude(wanted.longitude_deg())},
                      wanted.route(), most_mps);
}

scenario::Target target_of(const wire::NewTarget& wanted) {
  scenario::Target target;
  target.set_name(wanted.name());
  target.mutable_position()->set_lat(wanted.latitude_deg());
  target.mutable_position()->set_lon(wanted.longitude_deg());
  target.set_course_deg(wanted.course_deg());
  target.set_speed_kn(wanted.speed_kn());
  target.set_ship_class(class_wanted(wanted));
  *target.mutable_waypoints() = wanted.route();
  if (wanted.route_size() > 0) {
    target.set_route_end(static_cast<scenario::RouteEnd>(wanted.route_end()));
  }
  target.set_gives_way(static_cast<scenario::GiveWay>(wanted.gives_way()));
  const TrafficClass& her_class = *find_traffic_class(target.ship_class());
  take_sizes(her_class, {.speed = true}, target);
  // A route is not sailed without way.
  if (wanted.route_size() > 0 && wanted.speed_kn() <= 0.0) {
    target.set_speed_kn(her_class.service_kn);
  }
  return target;
}

}  // namespace skerry::server
