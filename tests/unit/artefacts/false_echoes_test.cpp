#include "echo/artefacts/false_echoes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "echo/artefacts/indirect_echoes.hpp"
#include "echo/artefacts/multiple_echoes.hpp"
#include "tests/unit/artefacts/small_rig.hpp"

namespace skerry::echo {
namespace {

// A body of one point with that cross-section.
PointEcho target(const RadarModel& model, double metres, double plane_deg, double m2,
                 std::uint32_t body = 1) {
  PointEcho p;
  p.range_m = metres;
  p.bearing_units = units(plane_deg);
  p.power = static_cast<float>(model.unit_snr * m2 / std::pow(metres, 4));
  p.phase = 0.3f;
  p.body = body;
  p.height_m = 10.0f;
  return p;
}

std::vector<PointEcho> around(const RadarModel& model, const Scene& scene, double plane_deg,
                              const std::vector<PointEcho>& strong, double heading_deg = 0.0,
                              double half_deg = 0.7) {
  std::vector<PointEcho> out;
  FalseEchoes(model).add(scene, aim_at(plane_deg - heading_deg - half_deg, 0.0, heading_deg),
                         aim_at(plane_deg - heading_deg + half_deg, 0.0, heading_deg), strong, out);
  return out;
}

TEST(MultipleEchoes, AreTheBistaticChain) {
  // Leg by leg, in watts.
  const RadarSet set;
  const double wavelength = 299792458.0 / set.frequency_hz, gain = std::pow(10.0, 3.1);
  const double range = 900.0, ship = 3e4, own = 8e4;
  const auto leg = [&](double watts) { return watts / (4.0 * kPi * range * range); };
  const double aperture = gain * wavelength * wavelength / (4.0 * kPi);
  const double first = leg(leg(set.peak_power_w * gain) * ship) * aperture;
  const double second = leg(leg(leg(leg(set.peak_power_w * gain) * ship) * own) * ship) * aperture;
  EXPECT_NEAR(second_trip_ratio(own, ship, range) / (second / first), 1.0, 1e-12);
}

TEST(MultipleEchoes, OfFlatWallsAreNoMoreThanMirrorsGive) {
  // A mirror of any size sends back what an antenna at twice the range would get:
  // sigma / (4 pi R^2)^2 = 1 / (4 pi (2R)^2).
  const double range = 50.0;
  const double mirror = std::pow(4.0 * kPi * range * range, 2) / (4.0 * kPi * 4.0 * range * range);
  EXPECT_NEAR(second_trip_ratio(1e9, 1e9, range), second_trip_ratio(mirror, mirror, range), 1e-12);
  EXPECT_NEAR(second_trip_ratio(1e9, 1e9, range), 1.0 / 16.0, 1e-12);
}

TEST(MultipleEchoes, StandBehindABigShipCloseByAtMultiplesOfItsRange) {
  const RadarModel model = small_model(3.0);
  const Scene scene;
  const auto echoes = around(model, scene, 90.0, {target(model, 800.0, 90.0, 2e5)});
  ASSERT_EQ(echoes.size(), 3u);
  const double own = own_cross_section(scene.own_hull, model.set.frequency_hz, units(90.0));
  const double ratio = second_trip_ratio(own, 2e5, 800.0);
  std::printf("a second trip %.1f dB, first %.1f dB over noise\n", 10.0 * std::log10(ratio),
              10.0 * std::log10(model.unit_snr * 2e5 / std::pow(800.0, 4)));
  for (int trip = 2; trip <= 4; ++trip) {
    const PointEcho& e = echoes[static_cast<std::size_t>(trip) - 2];
    EXPECT_DOUBLE_EQ(e.range_m, 800.0 * trip);
    EXPECT_EQ(e.bearing_units, units(90.0));
    const double want = model.unit_snr * 2e5 / std::pow(800.0, 4) * std::pow(ratio, trip - 1);
    EXPECT_NEAR(double{e.power} / want, 1.0, 1e-5);
    EXPECT_GE(e.phase, 0.0f);
    EXPECT_LT(e.phase, 1.0f);
  }
}

TEST(MultipleEchoes, ComeOnlyOfBigShipsCloseBy) {
  const RadarModel model = small_model(12.0);
  const Scene scene;
  EXPECT_FALSE(around(model, scene, 90.0, {target(model, 600.0, 90.0, 1e5)}).empty());
  EXPECT_TRUE(around(model, scene, 90.0, {target(model, 600.0, 90.0, 0.5)}).empty());
  EXPECT_TRUE(around(model, scene, 90.0, {target(model, 9000.0, 90.0, 1e4)}).empty());
  EXPECT_TRUE(around(model, scene, 95.0, {target(model, 600.0, 90.0, 1e5)}).empty());
  Scene without;
  without.own_hull.length_m = 0.0;
  EXPECT_TRUE(around(model, without, 90.0, {target(model, 600.0, 90.0, 1e5)}).empty());
}

TEST(MultipleEchoes, OfABodyHaveAllItsPowerInFewPoints) {
  const RadarModel model = small_model(3.0);
  std::vector<PointEcho> ship;
  double power = 0.0;
  for (int i = 0; i < 200; ++i) {
    ship.push_back(target(model, 700.0 + i, 90.0 + 0.002 * i, 500.0 + 30.0 * (i % 17)));
    power += double{ship.back().power};
  }
  const auto echoes = around(model, {}, 90.0, ship);
  std::vector<double> trips(5, 0.0);
  for (const PointEcho& e : echoes) {
    trips[static_cast<std::size_t>(std::lround(e.range_m / 800.0))] += double{e.power};
  }
  EXPECT_EQ(echoes.size(), 3 * kMostPoints);
  EXPECT_GT(trips[2], 0.0);
  // Each trip has the same part of the one before: the body's, not the points'.
  EXPECT_NEAR(trips[3] / trips[2], trips[4] / trips[3], 1e-4 * trips[3] / trips[2]);
  EXPECT_NEAR(trips[2] / power, trips[3] / trips[2], 1e-4 * trips[3] / trips[2]);
}

// A bridge across the bow, seen from its middle.
Scene under_a_bridge(ObjectClass kind, double ahead_m) {
  auto structures = std::make_shared<Structures>();
  structures->walls = {{{-800.0, ahead_m}, {900.0, ahead_m}, 20.0f, 24.0f, kind}};
  Scene scene;
  scene.structure_index = std::make_shared<StructureIndex>(structures, PlanePoint{}, 50.0);
  return scene;
}

TEST(MultipleEchoes, OfABridgeStandBehindItInParallel) {
  const RadarModel model = small_model(1.5);
  const double near_m = 250.0;
  const Scene scene = under_a_bridge(ObjectClass::bridge, near_m);
  for (const double bearing : {0.0, 20.0, -35.0}) {
    const auto echoes = around(model, scene, bearing, {});
    ASSERT_GE(echoes.size(), 4u) << bearing;
    double at_two = 0.0, width = 0.0;
    for (const PointEcho& e : echoes) {
      const double turns = e.bearing_units / 4294967296.0;
      const double north = e.range_m * std::cos(2.0 * kPi * turns);
      const double trip = std::round(north / near_m);
      EXPECT_NEAR(north, trip * near_m, 0.01);
      EXPECT_GE(trip, 2.0);
      if (trip == 2.0) {
        at_two += double{e.power};
        width += 0.6 * kDegree;
      }
    }
    // Leg by leg: 0 dB of four metres' height over the arc, out and back by the own hull.
    const double range = near_m / std::cos(bearing * kDegree);
    const double own = own_cross_section(scene.own_hull, model.set.frequency_hz, units(bearing));
    const double strip = 4.0 * range * 0.7527 * 1.2 * kDegree;
    const double want = model.unit_snr * 4.0 * range * width / std::pow(range, 4) *
                        second_trip_ratio(own, strip, range);
    EXPECT_NEAR(at_two / want, 1.0, 0.01) << bearing;
  }
  EXPECT_TRUE(around(model, scene, 90.0, {}).empty());
  EXPECT_TRUE(around(model, under_a_bridge(ObjectClass::pier, near_m), 0.0, {}).empty());
  EXPECT_TRUE(around(model, under_a_bridge(ObjectClass::bridge, 1100.0), 0.0, {}).empty());
  Scene off = scene;
  off.artefacts.multiple_echoes = false;
  EXPECT_TRUE(around(model, off, 0.0, {}).empty());
}

TEST(MultipleEchoes, OfABridgeAreTheSameInEverySector) {
  const RadarModel model = small_model(1.5);
  const Scene scene = under_a_bridge(ObjectClass::bridge, 250.0);
  const auto one = around(model, scene, 359.5, {}), other = around(model, scene, 0.8, {});
  int shared = 0;
  for (const PointEcho& a : one) {
    for (const PointEcho& b : other) {
      if (a.bearing_units != b.bearing_units || a.range_m != b.range_m) continue;
      ++shared;
      EXPECT_EQ(a.power, b.power);
      EXPECT_EQ(a.body, b.body);
    }
  }
  EXPECT_GE(shared, 3);
}

// The wave from the antenna by the mast to the target, by Fermat: the point of the mast's side
// whose way is shortest, found by trying all.
struct Shortest {
  double way = 1e300, bearing = 0.0;
};
Shortest shortest_by(const Obstruction& mast, double range, double bearing_rad) {
  Shortest best;
  const double middle = mast.bearing_deg * kDegree;
  for (int i = 0; i < 200000; ++i) {
    const double a = 2.0 * kPi * i / 200000;
    const double x = mast.distance_m * std::sin(middle) + 0.5 * mast.width_m * std::sin(a);
    const double y = mast.distance_m * std::cos(middle) + 0.5 * mast.width_m * std::cos(a);
    // Only where it is lit by the antenna.
    if (x * std::sin(a) + y * std::cos(a) > 0.0) continue;
    const double way = std::hypot(x, y) + std::hypot(range * std::sin(bearing_rad) - x,
                                                     range * std::cos(bearing_rad) - y);
    if (way < best.way) best = {way, std::atan2(x, y)};
  }
  return best;
}

TEST(IndirectEchoes, GoTheShortestWayByTheMast) {
  for (const Obstruction& mast :
       {Obstruction{170.0, 0.6, 8.0, 0.5}, Obstruction{300.0, 4.0, 20.0, 0.7}}) {
    for (const double off : {20.0, -75.0, 100.0, 160.0, -130.0}) {
      for (const double range : {150.0, 3000.0}) {
        const double bearing = (mast.bearing_deg + off) * kDegree;
        const Detour detour = detour_by(mast, range, bearing);
        const Shortest want = shortest_by(mast, range, bearing);
        EXPECT_NEAR(range + detour.longer_m, want.way, 1e-4) << off;
        const double came = mast.bearing_deg * kDegree + detour.off_rad;
        EXPECT_NEAR(std::remainder(came - want.bearing, 2.0 * kPi), 0.0, 2e-3) << off;
      }
    }
  }
}

TEST(IndirectEchoes, HaveThePowerOfARoundMirror) {
  // Rays that leave the antenna a little apart, reflected by the law of reflection on the circle,
  // spread over a target far off: power per angle there over that of the straight way.
  const Obstruction mast{0.0, 2.0, 12.0, 0.6};
  for (const double off : {60.0, 110.0, 150.0, 180.0}) {
    const Detour detour = detour_by(mast, 1e6, off * kDegree);
    const auto thrown = [&](double angle) {
      // The point where the ray at `angle` off the mast's middle meets it, and its way on.
      const double r = 1.0, d = 12.0;
      const double along = d * std::cos(angle), missed = d * std::sin(angle);
      const double way = along - std::sqrt(r * r - missed * missed);
      const double x = way * std::sin(angle), y = way * std::cos(angle);
      const double normal = kPi - std::atan2(x, d - y);
      return 2.0 * normal - (angle + kPi);  // outgoing direction
    };
    const double h = 1e-7;
    const double spread =
        std::fabs((thrown(detour.off_rad + h) - thrown(detour.off_rad - h)) / (2.0 * h));
    EXPECT_NEAR(std::remainder(thrown(detour.off_rad) - off * kDegree, 2.0 * kPi), 0.0, 2e-3);
    // Upright the wave spreads as on the straight way.
    EXPECT_NEAR(detour.ratio / (0.36 / spread), 1.0, 0.01) << off;
  }
}

TEST(IndirectEchoes, AStrongTargetOnAnyBearingShowsOnTheMasts) {
  const RadarModel model = small_model(6.0);
  Scene scene;
  scene.artefacts.multiple_echoes = false;
  scene.obstructions = {{180.0, 1.0, 8.0, 0.5}};
  for (const double target_deg : {0.0, 45.0, 120.0, 250.0}) {
    // The ship heads 30, the mast is right astern.
    const auto strong = {target(model, 2000.0, target_deg, 5e4)};
    const auto echoes = around(model, scene, 210.0, strong, 30.0, 3.0);
    ASSERT_EQ(echoes.size(), 1u) << target_deg;
    const Detour detour = detour_by(scene.obstructions[0], 2000.0, (target_deg - 30.0) * kDegree);
    EXPECT_NEAR(
        double{echoes[0].power} / (double{strong.begin()->power} * detour.ratio * detour.ratio),
        1.0, 1e-5);
    EXPECT_LT(std::fabs(echoes[0].range_m - 2000.0), 17.0);
    EXPECT_LT(std::abs(static_cast<std::int32_t>(echoes[0].bearing_units - units(210.0))),
              static_cast<std::int32_t>(units(4.0)));
    EXPECT_TRUE(around(model, scene, target_deg + 60.0, strong, 30.0).empty());
  }
  // Fixed to the ship: when she turns, it turns with her.
  EXPECT_EQ(around(model, scene, 280.0, {target(model, 2000.0, 45.0, 5e4)}, 100.0, 3.0).size(), 1u);
  // Right behind the mast nothing is thrown back.
  EXPECT_TRUE(around(model, scene, 210.0, {target(model, 2000.0, 210.0, 5e4)}, 30.0).empty());
  // Weak ones show nowhere.
  EXPECT_TRUE(around(model, scene, 210.0, {target(model, 2000.0, 45.0, 0.2)}, 30.0, 3.0).empty());
}

TEST(FalseEchoes, SwitchedOffOrWithoutCauseThereAreNone) {
  const RadarModel model = small_model(3.0);
  Scene scene;
  const std::vector<PointEcho> strong{target(model, 600.0, 90.0, 1e5)};
  EXPECT_FALSE(around(model, scene, 90.0, strong).empty());
  EXPECT_TRUE(around(model, scene, 180.0, strong).empty()) << "no mast, no indirect echo";
  scene.artefacts.multiple_echoes = false;
  EXPECT_TRUE(around(model, scene, 90.0, strong).empty());
  scene.obstructions = {{180.0, 1.0, 8.0, 0.5}};
  EXPECT_FALSE(around(model, scene, 177.0, strong).empty());
  scene.artefacts.indirect_echoes = false;
  EXPECT_TRUE(around(model, scene, 177.0, strong).empty());
}

TEST(FalseEchoes, AreBoundedAndAlwaysTheSame) {
  const RadarModel model = small_model(6.0);
  Scene scene;
  for (int i = 0; i < 40; ++i) scene.obstructions.push_back({179.0 + 0.05 * i, 3.0, 10.0, 1.0});
  std::vector<PointEcho> strong;
  for (int i = 0; i < 4000; ++i) {
    strong.push_back(target(model, 200.0 + 0.9 * i, 0.09 * i, 1e5 + 17.0 * (i % 101),
                            static_cast<std::uint32_t>(i / 3)));
  }
  std::vector<PointEcho> first;
  for (int again = 0; again < 2; ++again) {
    auto out = strong;
    FalseEchoes(model).add(scene, aim_at(179.3), aim_at(180.7), out, out);
    EXPECT_GT(out.size(), strong.size());
    EXPECT_LE(out.size(), strong.size() + FalseEchoes::kMostEchoes);
    for (const PointEcho& e : out) {
      EXPECT_TRUE(std::isfinite(e.power) && e.power > 0.0f && e.range_m > 0.0);
    }
    if (again == 0) {
      first = out;
      continue;
    }
    ASSERT_EQ(out.size(), first.size());
    for (std::size_t i = 0; i < out.size(); ++i) {
      EXPECT_EQ(out[i].power, first[i].power);
      EXPECT_EQ(out[i].range_m, first[i].range_m);
      EXPECT_EQ(out[i].bearing_units, first[i].bearing_units);
    }
  }
}

}  // namespace
}  // namespace skerry::echo
