#include "server/world/handling/isherwood_load.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>

#include "server/world/handling/ship_dynamics.hpp"

namespace skerry::server {
namespace {

struct Coefficients {
  double cx, cy, cn;
};

// `off_bow_deg` positive where the wind comes from port.
Coefficients coefficients(const Loads& loads, double frontal_m2, double lateral_m2, double length_m,
                          double speed) {
  const double pressure = 0.5 * kAir_kg_m3 * speed * speed;
  return {loads.x / (pressure * frontal_m2), loads.y / (pressure * lateral_m2),
          loads.n / (pressure * lateral_m2 * length_m)};
}

Loads isherwood_at(const IsherwoodShape& shape, double off_bow_deg, double speed) {
  const double angle = off_bow_deg * std::numbers::pi / 180.0;
  return isherwood_load(shape, -speed * std::cos(angle), speed * std::sin(angle));
}

constexpr IsherwoodShape kBox{.length_m = 100.0,
                              .beam_m = 30.0,
                              .frontal_m2 = 300.0,
                              .lateral_m2 = 900.0,
                              .superstructure_m2 = 100.0,
                              .perimeter_m = 100.0,
                              .centre_from_bow_m = 50.0,
                              .masts = 2,
                              .height_m = 7.0};

// Coefficients computed by another program from the same table.
TEST(IsherwoodLoad, IsThatOfAnotherProgram) {
  struct Row {
    double off_bow_deg;
    Coefficients is;
  };
  for (const Row& row :
       {Row{0, {-.8673, 0, 0}}, Row{30, {-.8299, .4051, .0799}}, Row{60, {-.3099, .7861, .0442}},
        Row{90, {-.1440, .6510, .0087}}, Row{120, {-.2252, .6144, -.0646}},
        Row{150, {.4835, .4237, -.1030}}, Row{180, {.7665, 0, 0}}}) {
    for (const double side : {1.0, -1.0}) {
      const Loads loads = isherwood_at(kBox, side * row.off_bow_deg, 12.0);
      const Coefficients c = coefficients(loads, 300.0, 900.0, 100.0, 12.0);
      EXPECT_NEAR(c.cx, row.is.cx, 6e-5) << row.off_bow_deg;
      EXPECT_NEAR(c.cy, side * row.is.cy, 6e-5) << row.off_bow_deg;
      EXPECT_NEAR(c.cn, side * row.is.cn, 6e-5) << row.off_bow_deg;
      EXPECT_NEAR(loads.k, 7.0 * loads.y, 1e-6);
    }
  }
  EXPECT_EQ(isherwood_load(kBox, 0.0, 0.0).x, 0.0);
}

// Half way between two rows: their mean.  The rows are every ten degrees.
TEST(IsherwoodLoad, IsStraightBetweenItsRows) {
  for (int row = 0; row < 18; ++row) {
    const auto at = [&](double deg) {
      return coefficients(isherwood_at(kBox, deg, 10.0), 300.0, 900.0, 100.0, 10.0);
    };
    const Coefficients a = at(10.0 * row), b = at(10.0 * row + 10.0), middle = at(10.0 * row + 5.0);
    EXPECT_NEAR(middle.cx, 0.5 * (a.cx + b.cx), 1e-9) << row;
    EXPECT_NEAR(middle.cy, 0.5 * (a.cy + b.cy), 1e-9) << row;
    EXPECT_NEAR(middle.cn, 0.5 * (a.cn + b.cn), 1e-9) << row;
  }
}

// Merchant ships of the table, with the assumed factors, against Blendermann: across and turning
// near, along from ahead and astern within a factor of 2.5.  In between he has high-sided ships
// driven ahead by a wind before the beam, and back by one behind it; Blendermann has none.
TEST(IsherwoodLoad, IsNearBlendermannForMerchantShips) {
  for (const char* key : {"vlcc", "tanker", "container", "mariner", "ferry", "coaster"}) {
    const ShipClass& ship = *find_ship_class(key);
    const IsherwoodShape& shape = *in_isherwoods_wind(ship).isherwood;
    for (const double deg : {0.0, 30.0, 60.0, 90.0, 120.0, 150.0, 180.0}) {
      const double angle = deg * std::numbers::pi / 180.0, length = ship.hull->length_m();
      const double f = ship.wind.frontal_m2, l = ship.wind.lateral_m2;
      const Coefficients one = coefficients(isherwood_at(shape, deg, 15.0), f, l, length, 15.0);
      const Coefficients other = coefficients(
          wind_load(ship.wind, length, -15.0 * std::cos(angle), 15.0 * std::sin(angle)), f, l,
          length, 15.0);
      std::printf("%-10s %3.0f deg: CX %6.3f %6.3f  CY %6.3f %6.3f  CN %7.4f %7.4f\n", key, deg,
                  one.cx, other.cx, one.cy, other.cy, one.cn, other.cn);
      if (deg == 0.0 || deg == 180.0) {
        EXPECT_GT(one.cx / other.cx, 0.4) << key << deg;
        EXPECT_LT(one.cx / other.cx, 2.5) << key << deg;
      } else {
        EXPECT_NEAR(one.cy / other.cy, 1.0, 0.3) << key << deg;
      }
      EXPECT_NEAR(one.cx, other.cx, 0.7) << key << deg;
      EXPECT_NEAR(one.cn, other.cn, 0.05) << key << deg;
    }
  }
}

TEST(IsherwoodLoad, ActsOnAShipThatHasIt) {
  const ShipClass& plain = *find_ship_class("coaster");
  EXPECT_FALSE(plain.isherwood);
  const ShipClass& other = in_isherwoods_wind(plain);
  ASSERT_TRUE(other.isherwood);
  EXPECT_EQ(other.key, plain.key);
  EXPECT_EQ(other.hull, plain.hull);
  DynamicState a, b;
  const Surroundings wind{.wind_from_deg = 270.0, .wind_mps = 15.0};
  double east_a = 0.0, east_b = 0.0;
  for (int tick = 0; tick < 6000; ++tick) {
    east_a += advance(plain, {}, wind, 0.1, a).east_m;
    east_b += advance(other, {}, wind, 0.1, b).east_m;
  }
  std::printf("drift of a stopped coaster: %.2f m/s by Blendermann, %.2f by Isherwood\n",
              east_a / 600.0, east_b / 600.0);
  EXPECT_NE(east_a, east_b);
  EXPECT_NEAR(east_b / east_a, 1.0, 0.4);
}

}  // namespace
}  // namespace skerry::server
