#include "echo/beacons/far_echoes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/beacons/beacon_scene.hpp"

namespace skerry::echo {
namespace {

using beacons::at;
using beacons::fast_model;
using beacons::kNauticalMile;
using beacons::model_at;
using beacons::propagation_of;

Scene ducted() {
  Scene scene;
  scene.atmosphere.ducting = 1.0;
  return scene;
}

Hull ship_at(double bearing_deg, double nm) {
  Hull hull;
  hull.centre = at(bearing_deg, nm * kNauticalMile);
  hull.length_m = 250.0, hull.beam_m = 35.0, hull.height_m = 40.0;
  hull.identity = 7;
  return hull;
}

// Echoes of one turn, sector by sector.
std::vector<PointEcho> echoes_of(FarEchoes& far, const RadarModel& model, const Scene& scene,
                                 const HiddenHeight& hidden = {}) {
  const Propagation propagation = propagation_of(model, scene);
  std::vector<PointEcho> out;
  for (std::uint64_t first = 0; first < 4096; first += 16)
    far.append(scene, propagation, aim_of(scene, model.clock, first),
               aim_of(scene, model.clock, first + 15), hidden, out);
  return out;
}
std::vector<PointEcho> echoes_of(const RadarModel& model, const Scene& scene,
                                 const HiddenHeight& hidden = {}) {
  FarEchoes far(model);
  return echoes_of(far, model, scene, hidden);
}

TEST(FarEchoes, ShowAShipFortyMilesOffAtThirteen) {
  Scene scene = ducted();
  scene.hulls = {ship_at(77.0, 40.0)};
  const auto echoes = echoes_of(fast_model(24.0), scene);
  ASSERT_FALSE(echoes.empty());
  for (const PointEcho& echo : echoes) {
    EXPECT_NEAR(echo.range_m / kNauticalMile, 13.02, 0.01);
    EXPECT_NEAR(echo.bearing_units * (360.0 / 4294967296.0), 77.0, 0.01);
  }
  EXPECT_LT(echoes.size(), 20u);  // the sectors whose beam meets her
}

TEST(FarEchoes, NeedADuct) {
  Scene scene;
  scene.hulls = {ship_at(77.0, 40.0)};
  EXPECT_TRUE(echoes_of(fast_model(24.0), scene).empty());
}

TEST(FarEchoes, AreTheInstructorsToTakeAway) {
  Scene scene = ducted();
  scene.hulls = {ship_at(77.0, 40.0)};
  scene.artefacts.second_trace = false;
  EXPECT_TRUE(echoes_of(fast_model(24.0), scene).empty());
}

TEST(FarEchoes, LeaveWhatIsWithinTheUnambiguousRangeToOthers) {
  Scene scene = ducted();
  scene.hulls = {ship_at(10.0, 5.0), ship_at(20.0, 26.9), ship_at(30.0, 90.0)};
  PointTarget buoy;
  buoy.place = at(40.0, 20.0 * kNauticalMile);
  scene.points = {buoy};
  EXPECT_TRUE(echoes_of(fast_model(24.0), scene).empty());
}

TEST(FarEchoes, HoldStrongPointsToo) {
  Scene scene = ducted();
  PointTarget platform;
  platform.place = at(300.0, 35.0 * kNauticalMile);
  platform.height_m = 60.0, platform.x_band_m2 = 1e5;
  platform.fluctuation = Fluctuation::steady;
  scene.points = {platform};
  const auto echoes = echoes_of(fast_model(12.0), scene);
  ASSERT_FALSE(echoes.empty());
  EXPECT_NEAR(echoes[0].range_m / kNauticalMile, 35.0 - 26.98, 0.01);
}

TEST(FarEchoes, AreHiddenByLandBetween) {
  Scene scene = ducted();
  scene.hulls = {ship_at(77.0, 40.0)};
  const HiddenHeight cliff = [](std::uint32_t, double) { return 90.0f; };
  EXPECT_TRUE(echoes_of(fast_model(24.0), scene, cliff).empty());
}

CoastPicturePtr coast_at(double north_m, double range_m) {
  std::vector<PlanePoint> vertices;
  for (int i = 200; i >= -200; --i) vertices.push_back({1000.0 * i, north_m});
  const auto count = static_cast<std::uint32_t>(vertices.size());
  return std::make_shared<CoastPicture>(CoastPicture{
      LocalPlane(GeoPoint{60.0, 5.0}), {}, 0.0, range_m, false, std::move(vertices), {0, count}});
}

TEST(FarEchoes, FollowAFarCoastAsTheShipSails) {
  const RadarModel model = fast_model(12.0);
  FarEchoes far(model);
  Scene scene = ducted();
  scene.coast = coast_at(30.0 * kNauticalMile, 100e3);
  const auto nearest = [&] {
    double least = 1e9;
    for (const PointEcho& echo : echoes_of(far, model, scene))
      if (std::fabs(static_cast<std::int32_t>(echo.bearing_units) * (360.0 / 4294967296.0)) < 20.0)
        least = std::min(least, echo.range_m);  // farther round it is a third trace
    return least;
  };
  const double first = nearest();
  EXPECT_NEAR(first / kNauticalMile, 30.0 - 26.98, 0.02);
  for (const double sailed : {10.0, 25.0, 40.0, 500.0}) {
    scene.own_ship = {0.0, sailed};
    EXPECT_NEAR(first - nearest(), sailed, 2.0);
  }
}

TEST(FarEchoes, KnowNothingOfACoastBeyondThePicture) {
  const RadarModel model = fast_model(12.0);
  Scene scene = ducted();
  scene.coast = coast_at(30.0 * kNauticalMile, 12.0 * kNauticalMile);
  EXPECT_TRUE(echoes_of(model, scene).empty());
  scene.coast = coast_at(30.0 * kNauticalMile, 100e3);
  EXPECT_FALSE(echoes_of(model, scene).empty());
}

TEST(FarEchoes, AreNoneWhereThePulsesAreFarApart) {
  Scene scene = ducted();
  scene.hulls = {ship_at(77.0, 90.0)};  // 600 Hz: 135 NM
  EXPECT_TRUE(echoes_of(model_at(48.0), scene).empty());
}

}  // namespace
}  // namespace skerry::echo
