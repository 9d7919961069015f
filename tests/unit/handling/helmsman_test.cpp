#include "server/world/handling/helmsman.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

constexpr double kTick_s = 0.1;

struct Sailor {
  explicit Sailor(const ShipClass& s, double heading_deg = 0.0, double share = 0.9) : ship(s) {
    state = under_way(s, heading_deg, share * s.service_speed_mps);
    helm.keeps_speed = true;
    helm.speed_mps = share * s.service_speed_mps;
    helm.steering = SteeringMode::heading;
    helm.heading_deg = heading_deg;
  }
  bool tick(const TrackView* track = nullptr) {
    bool over = false;
    const ActuatorOrders conn = helmsman.orders(
        ship, state, helm, {way.north_m / kTick_s, way.east_m / kTick_s}, track, kTick_s, over);
    way = {};
    for (int i = 0; i < 2; ++i) {
      const WayMade part = advance(ship, conn, around, kTick_s / 2, state);
      way.north_m += part.north_m;
      way.east_m += part.east_m;
      around.time_s += kTick_s / 2;
    }
    north_m += way.north_m;
    east_m += way.east_m;
    return over;
  }
  double heading_deg() const { return state.heading_rad * kDegreesPerRadian; }

  const ShipClass& ship;
  DynamicState state;
  HelmOrders helm;
  Helmsman helmsman;
  Surroundings around;
  WayMade way;
  double north_m = 0.0, east_m = 0.0;
};

TEST(Helmsman, TurnsEveryClassToItsCourseAndKeepsIt) {
  for (const ShipClass& ship : ship_classes()) {
    for (const double turn_deg : {5.0, 60.0, -120.0, 179.0}) {
      for (const double share : {0.9, 0.4}) {
        Sailor sailor(ship, 0.0, share);
        for (int i = 0; i < 6000; ++i) sailor.tick();
        ASSERT_LT(std::fabs(sailor.heading_deg()), 1.0) << ship.key << " straight on";
        sailor.helm.heading_deg = turn_deg;
        double most = 0.0;
        for (int i = 0; i < 24000; ++i) {
          sailor.tick();
          most = std::max(most, (sailor.heading_deg() - turn_deg) * (turn_deg < 0 ? -1 : 1));
        }
        EXPECT_NEAR(sailor.heading_deg(), turn_deg, 0.8) << ship.key << " " << share;
        EXPECT_LT(most, 4.0) << ship.key << " overshoots at " << turn_deg << ", " << share;
        EXPECT_NEAR(sailor.state.motion.u, sailor.helm.speed_mps, 0.05 * ship.service_speed_mps)
            << ship.key;
      }
    }
  }
}

TEST(Helmsman, KeepsItsCourseInWindAndWaves) {
  for (const ShipClass& ship : ship_classes()) {
    Sailor sailor(ship, 40.0, 0.7);
    sailor.around = {.wind_from_deg = 330.0,
                     .wind_mps = 15.0,
                     .wave_height_m = std::min(3.0, ship.hull->length_m() / 20.0),
                     .waves_from_deg = 330.0};
    double worst = 0.0;
    for (int i = 0; i < 24000; ++i) {
      sailor.tick();
      if (i > 12000) worst = std::max(worst, std::fabs(sailor.heading_deg() - 40.0));
    }
    std::printf("%-11s off course at most %.1f deg\n", ship.key.data(), worst);
    EXPECT_LT(worst, 8.0) << ship.key;
  }
}

// A square in a current of 2 kn and a fresh wind: how far from the legs she is.
TEST(Helmsman, KeepsItsTrackInACurrent) {
  for (const ShipClass& ship : ship_classes()) {
    const double side = 60.0 * ship.hull->length_m();
    const std::vector<RoutePoint> route = {
        {0, 0}, {side, 0}, {side, side}, {0, side}, {0.0, 0.3 * side}};
    Sailor sailor(ship, 0.0, 0.8);
    sailor.helm.steering = SteeringMode::track;
    sailor.around = {
        .wind_from_deg = 300.0, .wind_mps = 8.0, .current_set_deg = 70.0, .current_mps = 1.0};
    std::size_t leg = 0;
    double worst_m = 0.0;
    const auto at = [&](const RoutePoint& p) {
      return RoutePoint{p.north_m - sailor.north_m, p.east_m - sailor.east_m};
    };
    double since_turn_m = 0.0;
    for (long i = 0; i < 1'000'000 && leg + 1 < route.size(); ++i) {
      TrackView track{at(route[leg]), at(route[leg + 1])};
      if (leg + 2 < route.size()) {
        track.has_next = true;
        track.next = at(route[leg + 2]);
      }
      since_turn_m += std::hypot(sailor.way.north_m, sailor.way.east_m);
      // Once settled on a leg.
      const RoutePoint a = track.from, b = track.to;
      const double length = std::hypot(b.north_m - a.north_m, b.east_m - a.east_m);
      const double off =
          (a.north_m * (b.east_m - a.east_m) - a.east_m * (b.north_m - a.north_m)) / length;
      if (since_turn_m > 0.5 * length) worst_m = std::max(worst_m, std::fabs(off));
      if (sailor.tick(&track)) {
        ++leg;
        since_turn_m = 0.0;
      }
    }
    EXPECT_EQ(leg + 1, route.size()) << ship.key;
    std::printf("%-11s off her track at most %.1f m (%.2f lengths)\n", ship.key.data(), worst_m,
                worst_m / ship.hull->length_m());
    EXPECT_LT(worst_m, 0.25 * ship.hull->length_m()) << ship.key;
  }
}

}  // namespace
}  // namespace skerry::server
