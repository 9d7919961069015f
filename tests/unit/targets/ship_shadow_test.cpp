#include "echo/targets/ship_shadow.hpp"

#include <gtest/gtest.h>

#include "echo/radar/beam.hpp"
#include "echo/radar/radar_equation.hpp"
#include "echo/targets/sector_view.hpp"
#include "tests/unit/targets/targets_support.hpp"

namespace skerry::echo {
namespace {

Hull ship(double range_m, double bearing_deg, double heading_deg, double length_m,
          double height_m) {
  Hull hull;
  hull.centre = place_at(range_m, bearing_deg);
  hull.heading_deg = heading_deg;
  hull.length_m = length_m, hull.beam_m = length_m / 7.0, hull.height_m = height_m;
  hull.identity = 3;
  return hull;
}

struct Cast {
  ShipShadow shadow;
  std::vector<ShadowedCells> list;
};
Cast cast_at(const RadarModel& model, const Scene& scene, double bearing_deg) {
  Cast cast{ShipShadow(model, kEffectiveEarth), {}};
  const std::uint64_t spoke =
      4096 + static_cast<std::uint64_t>(std::lround(bearing_deg / 360.0 * 4096));
  const SpokeAim aim = aim_of(scene, model.clock, spoke);
  const SectorView view(aim, aim, cast.shadow.reach_units());
  std::vector<std::uint32_t> met;
  for (std::uint32_t i = 0; i < scene.hulls.size(); ++i) {
    if (view.meets(scene.hulls[i].centre, radius_of(scene.hulls[i]))) met.push_back(i);
  }
  cast.shadow.prepare(scene, view, met);
  cast.shadow.shadows(aim, cast.list);
  return cast;
}

TEST(ShipShadow, EndsWhereTheLineOverTheTopMeetsTheSea) {
  const RadarModel model = model_at(6.0);
  Scene scene = calm_scene();
  // Abeam, 100 m of her at 400 m: far wider than the beam.  Antenna 20 m, top 0.7 * 20 m.
  scene.hulls = {ship(400.0, 45.0, 135.0, 100.0, 20.0)};
  const Cast cast = cast_at(model, scene, 45.0);
  ASSERT_EQ(cast.list.size(), 1u);
  EXPECT_LT(cast.list[0].factor, 0.01f);
  // Over a flat sea 400 * 20 / 6 = 1333 m; where it bends away the line meets it 5 m farther off:
  // r^2 / 2ae - 0.015 r + 20 = 0, with 0.0094 m off the top.
  const double slope = (20.0 - 14.0 + 400.0 * 400.0 / (2.0 * kEffectiveEarth)) / 400.0;
  double r = 1333.0;
  for (int k = 0; k < 50; ++k) r = (20.0 + r * r / (2.0 * kEffectiveEarth)) / slope;
  EXPECT_NEAR((cast.list[0].last_cell + 1) * model.cell_m, r, model.cell_m);
  EXPECT_NEAR(cast.list[0].first_cell * model.cell_m, 400.0 + 50.0 / 7.0, model.cell_m);
}

TEST(ShipShadow, HasNoEndBehindAShipAsHighAsTheAntenna) {
  const RadarModel model = model_at(6.0);
  Scene scene = calm_scene();
  scene.hulls = {ship(800.0, 45.0, 135.0, 300.0, 40.0)};
  const Cast cast = cast_at(model, scene, 45.0);
  ASSERT_EQ(cast.list.size(), 1u);
  EXPECT_EQ(cast.list[0].last_cell, 1023u);
}

TEST(ShipShadow, TakesAwayTheShareOfTheBeamThatTheHullCovers) {
  const RadarModel model = model_at(6.0);
  Scene scene = calm_scene();
  double before = 0.0;
  for (const double range : {200.0, 1000.0, 2000.0, 4000.0, 8000.0}) {
    scene.hulls = {ship(range, 45.0, 135.0, 60.0, 40.0)};
    const Cast cast = cast_at(model, scene, 45.0);
    // The same by brute force: the one-way pattern summed over the hull's angle and over all.
    const double half = 0.45 * 60.0 / range * 180.0 / std::numbers::pi;
    double all = 0.0, open = 0.0;
    for (double off = -1.5; off < 1.5; off += 1e-4) {
      const double v = cosine_taper_voltage(off, 1.2);
      all += v * v;
      if (std::fabs(off) > half) open += v * v;
    }
    const double expected = open / all * open / all;
    if (expected > 0.99) {
      EXPECT_TRUE(cast.list.empty());
      continue;
    }
    ASSERT_EQ(cast.list.size(), 1u);
    EXPECT_NEAR(cast.list[0].factor, expected, 0.003) << range;
    EXPECT_GE(cast.list[0].factor, before);
    before = cast.list[0].factor;
  }
  EXPECT_GT(before, 0.4);
  // Beside her the sea is lit again.
  scene.hulls = {ship(2000.0, 45.0, 135.0, 60.0, 40.0)};
  EXPECT_TRUE(cast_at(model, scene, 48.0).list.empty());
}

TEST(ShipShadow, DimsOnlyTheCellsBehind) {
  const RadarModel model = model_at(6.0);
  Scene scene = calm_scene();
  scene.hulls = {ship(400.0, 45.0, 135.0, 100.0, 20.0)};
  const Cast cast = cast_at(model, scene, 45.0);
  std::vector<float> power(1024, 2.0f);
  cast.shadow.apply(aim_of(scene, model.clock, 4096 + 512), power);
  for (std::uint32_t c = 0; c < 1024; ++c) {
    const bool behind = c >= cast.list[0].first_cell && c <= cast.list[0].last_cell;
    ASSERT_EQ(power[c], behind ? 2.0f * cast.list[0].factor : 2.0f) << c;
  }
}

TEST(ShipShadow, MastsStandOutOverALowerShipAndBoatsDoNot) {
  const RadarModel model = model_at(6.0);
  Scene scene = calm_scene();
  scene.hulls = {ship(1000.0, 45.0, 135.0, 200.0, 20.0)};
  const Cast cast = cast_at(model, scene, 45.0);
  const std::uint32_t there = units_at(45.0);
  // The line over 14 m at 1000 m from 20 m falls 6 m in each 1000 m: at 2000 m it stands 8 m high.
  EXPECT_EQ(cast.shadow.seen(there, 2000.0, 3.0), 0.0f);
  EXPECT_NEAR(cast.shadow.seen(there, 2000.0, 16.0), 0.5, 0.02);
  EXPECT_EQ(cast.shadow.seen(there, 900.0, 3.0), 1.0f);
  EXPECT_EQ(cast.shadow.seen(there, 5000.0, 3.0), 1.0f);
  EXPECT_EQ(cast.shadow.seen(units_at(55.0), 2000.0, 3.0), 1.0f);
  EXPECT_EQ(cast.shadow.seen(there, 2000.0, 3.0, 0), 1.0f);
}

TEST(ShipShadow, AsksNothingWhereNoShipIsNear) {
  const RadarModel model = model_at(6.0);
  Scene scene = calm_scene();
  EXPECT_FALSE(cast_at(model, scene, 45.0).shadow.any());
  scene.hulls = {ship(1000.0, 225.0, 135.0, 200.0, 20.0)};
  EXPECT_FALSE(cast_at(model, scene, 45.0).shadow.any());
  // The own ship inside a hull, or alongside: no shadow, nothing undefined.
  scene.hulls = {ship(0.0, 0.0, 0.0, 200.0, 20.0), ship(20.0, 45.0, 45.0, 200.0, 20.0)};
  EXPECT_FALSE(cast_at(model, scene, 45.0).shadow.any());
}

}  // namespace
}  // namespace skerry::echo
