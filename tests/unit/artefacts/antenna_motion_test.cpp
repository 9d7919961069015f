#include "echo/artefacts/antenna_motion.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "tests/unit/artefacts/small_rig.hpp"

namespace skerry::echo {
namespace {

Scene rolling(double roll_deg, double pitch_deg = 0.0) {
  Scene scene;
  scene.seed = 7;
  scene.motion = {roll_deg, 10.0, pitch_deg, 7.0};
  return scene;
}

double error_deg(const Motion& motion) {
  return motion.bearing_error_units * (360.0 / 4294967296.0);
}

using Vector = std::array<double, 3>;  // ahead, starboard, down

// From the ship's frame to the level one: rolled, starboard down, then pitched, bow up.
Vector level(const Motion& motion, Vector v) {
  const double r = motion.roll_rad, p = motion.pitch_rad;
  const Vector rolled{v[0], v[1] * std::cos(r) - v[2] * std::sin(r),
                      v[2] * std::cos(r) + v[1] * std::sin(r)};
  return {rolled[0] * std::cos(p) + rolled[2] * std::sin(p), rolled[1],
          rolled[2] * std::cos(p) - rolled[0] * std::sin(p)};
}

TEST(AntennaMotion, RollIsASineOfTheScenariosTime) {
  const AntennaMotionModel model(small_model());
  Scene scene = rolling(10.0);
  scene.time = ScenarioTime(std::chrono::seconds(100));
  EXPECT_NEAR(model.at(scene, aim_at(0.0, 0.0)).roll_rad, 0.0, 1e-9);
  EXPECT_NEAR(model.at(scene, aim_at(0.0, 2.5)).roll_rad, 10.0 * kDegree, 1e-9);
  EXPECT_NEAR(model.at(scene, aim_at(0.0, -2.5)).roll_rad, -10.0 * kDegree, 1e-9);
}

TEST(AntennaMotion, BearingErrorOfARollIsASixteenthOfItsTwoLobes) {
  // tan(seen) = tan(shown) / cos(roll): 10 deg give 0.44 deg on the quarters, 0 ahead and abeam.
  const AntennaMotionModel model(small_model());
  const Scene scene = rolling(10.0);
  double most = 0.0;
  for (double shown = 0.0; shown < 360.0; shown += 7.5) {
    const Motion motion = model.at(scene, aim_at(shown, 2.5));
    const double seen =
        std::atan2(std::sin(shown * kDegree), std::cos(shown * kDegree) * std::cos(10.0 * kDegree));
    EXPECT_NEAR(std::remainder(seen / kDegree - shown, 360.0), error_deg(motion), 1e-6) << shown;
    most = std::max(most, error_deg(motion));
  }
  const double phi = 10.0 * kDegree;
  EXPECT_NEAR(most * kDegree, phi * phi / 4.0, 1e-4);
  EXPECT_NEAR(most, 0.44, 0.01);
}

TEST(AntennaMotion, IsThatOfARigidFanBeam) {
  const AntennaMotionModel model(small_model());
  for (const double seconds : {0.3, 1.9, 4.4, 6.1, 8.8}) {
    for (double shown = 3.0; shown < 360.0; shown += 11.0) {
      const Motion motion = model.at(rolling(12.0, 6.0), aim_at(shown, seconds, 77.0));
      const double theta = shown * kDegree;
      // The place seen lies on the horizon and in the plane of mast and axis.
      const double seen = theta + error_deg(motion) * kDegree;
      const Vector mast = level(motion, {0, 0, -1});
      const Vector axis = level(motion, {std::cos(theta), std::sin(theta), 0});
      const Vector horizon{std::cos(seen), std::sin(seen), 0.0};
      const double volume = mast[0] * (axis[1] * horizon[2] - axis[2] * horizon[1]) -
                            mast[1] * (axis[0] * horizon[2] - axis[2] * horizon[0]) +
                            mast[2] * (axis[0] * horizon[1] - axis[1] * horizon[0]);
      EXPECT_NEAR(volume, 0.0, 2e-9);
      EXPECT_LT(std::fabs(error_deg(motion)), 2.0);
      EXPECT_NEAR(motion.tilt_rad, -std::asin(axis[2]), 2e-9);
      // The mast's top has moved by the antenna's height; along and across are as the spoke looks.
      EXPECT_NEAR(motion.along_m, 20.0 * (mast[0] * std::cos(theta) + mast[1] * std::sin(theta)),
                  1e-6);
      EXPECT_NEAR(motion.across_m, 20.0 * (mast[1] * std::cos(theta) - mast[0] * std::sin(theta)),
                  1e-6);
      const double east =
          20.0 * (mast[0] * std::sin(77.0 * kDegree) + mast[1] * std::cos(77.0 * kDegree));
      const double north =
          20.0 * (mast[0] * std::cos(77.0 * kDegree) - mast[1] * std::sin(77.0 * kDegree));
      EXPECT_NEAR(motion.sway.east_m, east, 1e-6);
      EXPECT_NEAR(motion.sway.north_m, north, 1e-6);
    }
  }
}

TEST(AntennaMotion, SwaysByHeightTimesTheSineOfTheRoll) {
  RadarSet high;
  high.antenna_height_m = 40.0;
  const AntennaMotionModel model(small_model(1.5, high));
  const Motion abeam = model.at(rolling(10.0), aim_at(90.0, 2.5));
  EXPECT_NEAR(abeam.along_m, 40.0 * std::sin(10.0 * kDegree), 1e-9);
  EXPECT_NEAR(abeam.across_m, 0.0, 1e-9);
  const SpokeAim before = aim_at(90.0, 2.5, 30.0);
  const Motion motion = model.at(rolling(10.0), before);
  const SpokeAim after = AntennaMotionModel::moved(before, motion);
  EXPECT_NEAR(after.own_ship.east_m, motion.sway.east_m, 1e-12);
  EXPECT_EQ(after.relative_units, before.relative_units);
  EXPECT_EQ(static_cast<std::int32_t>(after.plane_units - before.plane_units),
            motion.bearing_error_units);
}

TEST(AntennaMotion, LosesWhatTheElevationPatternSays) {
  const RadarModel radar = small_model(0.75);
  const AntennaMotionModel model(radar);
  const double width = 22.0 * kDegree;
  double worst = 0.0;
  for (const double seconds : {0.4, 2.5, 7.5}) {
    const Motion motion = model.at(rolling(10.0), aim_at(60.0, seconds));
    std::vector<float> power(1024, 1.0f);
    model.apply(motion, power);
    for (std::uint32_t i = 0; i < 1024; ++i) {
      const double range = (i + 0.5) * radar.cell_m;
      const double down = std::atan(20.0 / range) + range / (2.0 * 6371000.0 * 4.0 / 3.0);
      const auto db = [&](double off) {
        const double beams = off / width;
        return std::max(-40.0, -2.0 * 12.0412 * beams * beams);
      };
      const double want = std::min(0.0, db(motion.tilt_rad + down) - db(down));
      worst = std::max(worst, std::fabs(10.0 * std::log10(double{power[i]}) - want));
      EXPECT_NEAR(double{power[i]}, model.gain(motion, i), 1e-4 * model.gain(motion, i));
    }
  }
  EXPECT_LT(worst, 0.001);
}

TEST(AntennaMotion, OvershootsTheNearestOnTheUpRoll) {
  const RadarModel radar = small_model(0.75);
  const AntennaMotionModel model(radar);
  const auto gain_at = [&](double relative_deg, double metres) {
    const Motion motion = model.at(rolling(10.0), aim_at(relative_deg, 2.5));
    return 10.0 * std::log10(model.gain(motion, static_cast<std::uint32_t>(metres / radar.cell_m)));
  };
  // Starboard down: the port beam looks up, over what is near; the starboard one into the water.
  const double near_up = gain_at(270.0, 80.0), far_up = gain_at(270.0, 1300.0);
  const double near_down = gain_at(90.0, 80.0), far_down = gain_at(90.0, 1300.0);
  std::printf("dB at 80 m and 1300 m: up-roll %.1f %.1f, down-roll %.1f %.1f\n", near_up, far_up,
              near_down, far_down);
  EXPECT_LT(near_up, far_up - 5.0);
  EXPECT_EQ(near_down, 0.0);
  EXPECT_LT(far_down, -3.0);
  EXPECT_NEAR(gain_at(0.0, 80.0), 0.0, 0.01);  // roll does nothing ahead
}

TEST(AntennaMotion, ASmallSwingDoesLittle) {
  const AntennaMotionModel model(small_model(0.75));
  const Motion motion = model.at(rolling(0.05), aim_at(270.0, 2.5));
  std::vector<float> power(1024, 1.0f);
  model.apply(motion, power);
  for (const float p : power) EXPECT_GT(p, 0.96f);
}

TEST(AntennaMotion, SwitchedOffOrStillKeepsTheBits) {
  const AntennaMotionModel model(small_model());
  Scene off = rolling(10.0, 5.0);
  off.artefacts.antenna_motion = false;
  for (const Scene& scene : {off, rolling(0.0)}) {
    const SpokeAim aim = aim_at(123.0, 1.1);
    const Motion motion = model.at(scene, aim);
    EXPECT_FALSE(motion.moves);
    std::vector<float> power(1024, 1.2345f), before = power;
    model.apply(motion, power);
    EXPECT_EQ(power, before);
    EXPECT_EQ(AntennaMotionModel::moved(aim, motion).plane_units, aim.plane_units);
  }
}

}  // namespace
}  // namespace skerry::echo
