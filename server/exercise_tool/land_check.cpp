#include "server/exercise_tool/land_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "server/app/land_around.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/short_way.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

constexpr double kLookEvery_m = 50.0;
constexpr int kTicksBetweenLooks = 100;  // 10 s
constexpr double kMarginAround_m = 5000.0;
constexpr double kFarthestLooked_m = 300.0 * 1852.0;

double metres_of(const ShortWay& way) { return std::hypot(way.north_m, way.east_m); }

template <typename Place>
GeoPoint place_from(const Place& place) {
  return {place.lat(), place.lon()};
}

std::string text_of(GeoPoint place) {
  return fmt::format("{:.4f}, {:.4f}", place.latitude_deg, place.longitude_deg);
}

// Every position that the scenario names for a ship.
template <typename Take>
void each_place(const scenario::Scenario& scenario, const Take& take) {
  for (const auto& ship : scenario.own_ships()) {
    take(place_from(ship.position()));
    for (const auto& point : ship.route()) take(place_from(point));
  }
  for (const auto& target : scenario.targets()) {
    take(place_from(target.position()));
    for (const auto& point : target.waypoints()) take(place_from(point));
  }
  for (const auto& sart : scenario.sarts()) take(place_from(sart.position()));
}

class LandChecker {
 public:
  LandChecker(const scenario::Scenario& scenario, const LandAround& land)
      : scenario_(scenario), land_(land) {}

  std::vector<std::string> take() { return std::move(complaints_); }

  void check_places() {
    for (int i = 0; i < scenario_.own_ships_size(); ++i) {
      const auto& ship = scenario_.own_ships(i);
      check_way(fmt::format("own_ships[{}] ({})", i, ship.name()), "route",
                place_from(ship.position()), ship.route());
    }
    for (int i = 0; i < scenario_.targets_size(); ++i) {
      const auto& target = scenario_.targets(i);
      const bool floats = target.kind() == scenario::Target::ship ||
                          target.kind() == scenario::Target::small_craft ||
                          target.kind() == scenario::Target::reflector_craft;
      if (!floats) continue;
      check_way(fmt::format("targets[{}] ({})", i, target.name()), "waypoints",
                place_from(target.position()), target.waypoints());
    }
    for (int i = 0; i < scenario_.sarts_size(); ++i) {
      const auto& sart = scenario_.sarts(i);
      check_start(fmt::format("sarts[{}] ({})", i, sart.name()), place_from(sart.position()));
    }
  }

  void check_sailing(double minutes) {
    World world(scenario_);
    const auto ticks = static_cast<std::int64_t>(std::llround(minutes * 600.0));
    for (std::int64_t tick = 0; tick < ticks; ++tick) {
      world.step();
      if ((tick + 1) % kTicksBetweenLooks != 0) continue;
      const WorldState state = world.state();
      const double minute = static_cast<double>(tick + 1) / 600.0;
      for (const ShipState& ship : state.own_ships) check_now("own ship", ship, minute);
      for (const ShipState& ship : state.targets) check_now("target", ship, minute);
    }
  }

 private:
  bool check_start(const std::string& who, GeoPoint place) {
    if (!land_.is_land(place)) return true;
    complaints_.push_back(fmt::format("{}: begins on land at {}", who, text_of(place)));
    return false;
  }

  template <typename Points>
  void check_way(const std::string& who, const char* list, GeoPoint from, const Points& points) {
    if (!check_start(who, from)) {
      ashore_.insert(who.substr(who.find('(') + 1, who.size() - who.find('(') - 2));
      return;
    }
    for (int i = 0; i < points.size(); ++i) {
      const GeoPoint to = place_from(points[i]);
      const ShortWay way = short_way_between(from, to);
      const int looks = std::min(100'000, 1 + static_cast<int>(metres_of(way) / kLookEvery_m));
      for (int k = 1; k <= looks; ++k) {
        const double share = static_cast<double>(k) / looks;
        const GeoPoint at{
            from.latitude_deg + share * (to.latitude_deg - from.latitude_deg),
            wrapped_longitude(from.longitude_deg +
                              share * wrapped_longitude(to.longitude_deg - from.longitude_deg))};
        if (!land_.is_land(at)) continue;
        complaints_.push_back(
            fmt::format("{}: the leg to {}[{}] is over land at {}", who, list, i, text_of(at)));
        ashore_.insert(who.substr(who.find('(') + 1, who.size() - who.find('(') - 2));
        return;
      }
      from = to;
    }
  }

  void check_now(const char* what, const ShipState& ship, double minute) {
    if (!land_.is_land(ship.position) || !ashore_.insert(ship.name).second) return;
    complaints_.push_back(fmt::format("{} {}: comes on land after {:.0f} min at {}", what,
                                      ship.name, minute, text_of(ship.position)));
  }

  const scenario::Scenario& scenario_;
  const LandAround& land_;
  std::vector<std::string> complaints_;
  std::set<std::string> ashore_;  // names of those complained of
};

}  // namespace

std::vector<std::string> land_complaints(const scenario::Scenario& scenario,
                                         const echo::ChartSource& chart, double minutes) {
  const GeoPoint centre = place_from(scenario.own_ships(0).position());
  double reach_m = 0.0;
  each_place(scenario, [&](GeoPoint place) {
    reach_m = std::max(reach_m, metres_of(short_way_between(centre, place)));
  });
  // As far as a fast ship sails besides.
  reach_m += kMarginAround_m + minutes * 60.0 * 15.0;
  const LandAround land(chart, centre, std::min(reach_m, kFarthestLooked_m));
  LandChecker checker(scenario, land);
  checker.check_places();
  checker.check_sailing(minutes);
  return checker.take();
}

}  // namespace skerry::server
