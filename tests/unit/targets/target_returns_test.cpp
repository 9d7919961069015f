#include "echo/targets/target_returns.hpp"

#include <gtest/gtest.h>

#include "echo/kernel/hash.hpp"
#include "echo/radar/radar_equation.hpp"
#include "tests/unit/targets/targets_support.hpp"

namespace skerry::echo {
namespace {

PointTarget buoy_at(PlanePoint place, Fluctuation fluctuation = Fluctuation::steady) {
  return {place, {0, 0}, 3.5, 10.0, 1.0, fluctuation, 9};
}

TEST(TargetReturns, APointFallsWithTheFourthPowerOfRange) {
  const RadarModel model = model_at(12.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  // At 1 NM: -57.638 dBm for 1 m2 without losses (SOURCES.md "Vectors"), 3 dB losses, noise of the
  // pulse.
  scene.points = {buoy_at(place_at(1852.0, 30.0))};
  const double noise_dbm = decibels(noise_watts(model.set, model.pulse) * 1e3);
  const std::vector<PointEcho> one = echoes_about(returns, model, scene, 30.0);
  ASSERT_EQ(one.size(), 1u);
  EXPECT_NEAR(decibels(one[0].power), -57.638 - 3.0 + 10.0 - noise_dbm, 0.001);
  EXPECT_NEAR(one[0].range_m, 1852.0, 1e-6);
  EXPECT_NEAR(one[0].bearing_units / 4294967296.0 * 360.0, 30.0, 1e-6);
  for (const double ratio : {0.5, 2.0, 4.0, 8.0}) {
    scene.points = {buoy_at(place_at(1852.0 * ratio, 30.0))};
    const double there = total_power(echoes_about(returns, model, scene, 30.0));
    EXPECT_NEAR(decibels(total_power(one) / there), 40.0 * std::log10(ratio), 0.001);
  }
}

TEST(TargetReturns, BandAndKindChooseTheCrossSection) {
  RadarSet s_band;
  s_band.frequency_hz = 3.05e9;
  const RadarModel x = model_at(6.0), s = model_at(6.0, 1024, s_band);
  TargetReturns x_returns(x), s_returns(s);
  Scene scene = calm_scene();
  scene.points = {buoy_at(place_at(4000.0, 30.0))};
  EXPECT_NEAR(total_power(echoes_about(x_returns, x, scene, 30.0)) / x.unit_snr /
                  (total_power(echoes_about(s_returns, s, scene, 30.0)) / s.unit_snr),
              10.0, 1e-5);
}

TEST(TargetReturns, PointsFluctuateFromScanToScanAsTheirCaseSays) {
  const RadarModel model = model_at(6.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  const auto sample = [&](Fluctuation kind) {
    scene.points = {buoy_at(place_at(4000.0, 200.0))};
    const double mean = total_power(echoes_about(returns, model, scene, 200.0));
    scene.points = {buoy_at(place_at(4000.0, 200.0), kind)};
    std::vector<double> powers;
    for (std::uint64_t turn = 1; turn <= 4000; ++turn)
      powers.push_back(total_power(echoes_about(returns, model, scene, 200.0, turn)) / mean);
    return powers;
  };
  for (const double power : sample(Fluctuation::steady)) ASSERT_EQ(power, 1.0);
  EXPECT_LT(kolmogorov(sample(Fluctuation::rayleigh), exponential_law), kolmogorov_bound(4000));
  EXPECT_LT(kolmogorov(sample(Fluctuation::one_dominant), swerling3_law), kolmogorov_bound(4000));
}

TEST(TargetReturns, FluctuationIsNewAtEachPassingAndTheSameWithinOne) {
  const RadarModel model = model_at(6.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  // Ahead, where the scan's number changes in the middle of the beam.
  scene.points = {buoy_at(place_at(4000.0, 0.0), Fluctuation::rayleigh)};
  const auto power_at = [&](std::uint64_t first) {
    std::vector<PointEcho> echoes;
    returns.prepare(scene, aim_of(scene, model.clock, first), aim_of(scene, model.clock, first + 7),
                    {}, echoes);
    return total_power(echoes);
  };
  const double here = power_at(3 * 4096);
  EXPECT_EQ(power_at(3 * 4096 - 8), here);
  EXPECT_EQ(power_at(3 * 4096 - 16), here);
  EXPECT_NE(power_at(2 * 4096), here);
  EXPECT_NE(power_at(4 * 4096), here);
  scene.seed = 6;
  EXPECT_NE(power_at(3 * 4096), here);
}

TEST(TargetReturns, OnlyWhatTheBeamMayMeetIsMadeAndAllOfThat) {
  const RadarModel model = model_at(6.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.artefacts.side_lobes = false;
  for (int k = 0; k < 720; ++k) scene.points.push_back(buoy_at(place_at(6000.0, 0.5 * k)));
  for (const double bearing : {0.0, 10.0, 89.9, 180.0, 271.0, 359.5}) {
    const std::vector<PointEcho> echoes = echoes_about(returns, model, scene, bearing);
    int within = 0;
    for (int k = 0; k < 720; ++k) {
      const double off = std::fabs(std::remainder(0.5 * k - bearing, 360.0));
      within += off < 1.5 + 0.6;
    }
    EXPECT_GE(static_cast<int>(echoes.size()), within) << bearing;
    EXPECT_LE(static_cast<int>(echoes.size()), within + 4) << bearing;
  }
}

TEST(TargetReturns, StrongTargetsAreKeptAllRoundAndWeakOnesAreNot) {
  const RadarModel model = model_at(6.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.hulls = {ship_at(place_at(3000.0, 100.0), 45.0, 200.0, 30.0)};
  scene.points = {buoy_at(place_at(5000.0, 100.0))};
  EXPECT_TRUE(echoes_about(returns, model, scene, 300.0).empty());
  const auto& away = returns.strong().points;
  ASSERT_FALSE(away.empty());
  EXPECT_LE(away.size(), 3u);
  for (const PointEcho& e : away) {
    EXPECT_EQ(e.body, body_of(BodyKind::ship, 0));
    EXPECT_NEAR(e.range_m, 3000.0, 100.0);
    EXPECT_EQ(e.bearing_units, units_at(100.0));
  }
  // The same for a while, then made anew.
  const std::uint64_t version = returns.strong().version;
  echoes_about(returns, model, scene, 301.0);
  EXPECT_EQ(returns.strong().version, version);
  echoes_about(returns, model, scene, 100.0, 2);
  EXPECT_NE(returns.strong().version, version);
  EXPECT_FALSE(returns.strong().points.empty());

  scene.hulls.clear();
  echoes_about(returns, model, scene, 300.0, 2);
  EXPECT_TRUE(returns.strong().points.empty());
}

TEST(TargetReturns, NothingIsKeptAllRoundWhereNoFalseEchoIsWanted) {
  const RadarModel model = model_at(6.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.hulls = {ship_at(place_at(3000.0, 100.0), 45.0, 200.0, 30.0)};
  scene.artefacts.side_lobes = scene.artefacts.multiple_echoes = false;
  echoes_about(returns, model, scene, 300.0);
  EXPECT_TRUE(returns.strong().points.empty());  // no obstruction, so no indirect echo either
  scene.obstructions = {{}};
  echoes_about(returns, model, scene, 300.0);
  EXPECT_FALSE(returns.strong().points.empty());
}

TEST(TargetReturns, LandHidesShipsAndLeavesTheirMasts) {
  const RadarModel model = model_at(6.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.artefacts.side_lobes = false;
  scene.hulls = {ship_at(place_at(4000.0, 100.0), 45.0)};
  scene.points = {buoy_at(place_at(4000.0, 200.0))};
  const auto open = echoes_about(returns, model, scene, 100.0);
  const auto behind = [&](float metres, double bearing) {
    return total_power(echoes_about(returns, model, scene, bearing, 1,
                                    [&](std::uint32_t, double) { return metres; }));
  };
  EXPECT_EQ(behind(30.0f, 100.0), 0.0);
  EXPECT_NEAR(behind(15.0f, 100.0) / total_power(open), 0.25, 1e-5);
  EXPECT_NEAR(behind(0.0f, 100.0) / total_power(open), 1.0, 1e-6);
  EXPECT_EQ(behind(4.0f, 200.0), 0.0);
  // A headland that hides all of her left of her middle.
  const auto left = [](std::uint32_t units) {
    return static_cast<std::int32_t>(units - units_at(100.0)) < 0;
  };
  double expected = 0.0;
  for (const PointEcho& e : open) expected += left(e.bearing_units) ? 0.0 : e.power;
  EXPECT_GT(expected, 0.0);
  EXPECT_LT(expected, total_power(open));
  const auto half = echoes_about(returns, model, scene, 100.0, 1, [&](std::uint32_t units, double) {
    return left(units) ? 50.0f : 0.0f;
  });
  EXPECT_NEAR(total_power(half) / expected, 1.0, 1e-6);
}

TEST(TargetReturns, AShipHidesTheBoatBehindHer) {
  const RadarModel model = model_at(6.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.artefacts.side_lobes = false;
  scene.points = {buoy_at(place_at(3000.0, 100.0))};
  EXPECT_EQ(echoes_about(returns, model, scene, 100.0).size(), 1u);
  scene.hulls = {ship_at(place_at(2500.0, 100.0), 10.0)};
  for (const PointEcho& e : echoes_about(returns, model, scene, 100.0))
    EXPECT_EQ(e.body, body_of(BodyKind::ship, 0));
}

TEST(TargetReturns, IsAFunctionOfTheSceneAndTheSectorAlone) {
  const RadarModel model = model_at(6.0);
  Scene scene = calm_scene();
  scene.artefacts.side_lobes = false;
  for (std::uint64_t k = 0; k < 60; ++k) {
    const PlanePoint p =
        place_at(500.0 + 9000.0 * as_unit(mixed(1, k)), 360.0 * as_unit(mixed(2, k)));
    Hull hull = ship_at(p, 360.0 * as_unit(mixed(3, k)), 10.0 + 5.0 * static_cast<double>(k));
    hull.identity = k, hull.wake = true, hull.velocity = {3.0, 4.0};
    scene.hulls.push_back(hull);
    scene.points.push_back(buoy_at(p, Fluctuation::rayleigh));
  }
  scene.turbines = {{place_at(3000.0, 50.0)}};
  TargetReturns returns(model), other(model);
  for (double bearing = 350.0; bearing > 0.0; bearing -= 37.0)
    echoes_about(other, model, scene, bearing, 2);
  for (double bearing = 0.5; bearing < 360.0; bearing += 7.0) {
    const auto a = echoes_about(returns, model, scene, bearing, 2);
    const auto b = echoes_about(other, model, scene, bearing, 2);
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < a.size(); ++i) {
      ASSERT_EQ(a[i].range_m, b[i].range_m);
      ASSERT_EQ(a[i].bearing_units, b[i].bearing_units);
      ASSERT_EQ(a[i].power, b[i].power);
      ASSERT_EQ(a[i].phase, b[i].phase);
    }
  }
}

TEST(TargetReturns, CountsAreBoundedByTheScene) {
  const RadarModel model = model_at(0.25, 4096);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  for (std::uint64_t k = 0; k < 1000; ++k) {
    Hull hull = ship_at(place_at(1.0 + 0.4 * static_cast<double>(k), 90.0), 17.0, 400.0, 60.0);
    hull.identity = k, hull.wake = true, hull.velocity = {10.0, 0.0};
    scene.hulls.push_back(hull);
  }
  for (std::uint64_t k = 0; k < 4000; ++k)
    scene.points.push_back(buoy_at(place_at(0.1 * static_cast<double>(k), 90.0)));
  const auto echoes = echoes_about(returns, model, scene, 90.0);
  EXPECT_GT(echoes.size(), 4000u);
  EXPECT_LE(echoes.size(), 1000u * (kMaxAlong * kMaxRows + 12u) + 4000u);
  EXPECT_LE(returns.strong().points.size(), 3u * 1000u + 4000u);
  for (const PointEcho& e : echoes) {
    ASSERT_TRUE(std::isfinite(e.power) && e.power >= 0.0f && e.power <= kMaxPointPower);
    ASSERT_TRUE(e.range_m >= 0.0 && e.phase >= 0.0f && e.phase < 1.0f);
  }
}

}  // namespace
}  // namespace skerry::echo
