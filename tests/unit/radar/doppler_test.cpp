// Doppler colours, from ships on the water to the cells of a view.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "server/radar/view_renderers.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::server {
namespace {

constexpr double kRange = 3000.0;

struct Seen {
  std::size_t approaching = 0, receding = 0, shown = 0;
  std::size_t bright = 0,
              bright_and_coloured = 0;  // no side lobes, no cells that only touch the ship
  std::size_t coloured() const { return approaching + receding; }
};

class Doppler : public testing::Test {
 protected:
  static constexpr std::uint32_t kCells = 512, kSpokes = 1024;
  const ScanGeometry geometry_{kSpokes, kCells, 8};
  const RangeScale range_ = *RangeScale::find(3.0);

  // A ship kRange off on that bearing, with that velocity over ground.
  static echo::Hull ship(double bearing_deg, PlanePoint velocity) {
    const double angle = bearing_deg * std::numbers::pi / 180.0;
    echo::Hull hull;
    hull.centre = {kRange * std::sin(angle), kRange * std::cos(angle)};
    hull.velocity = velocity;
    hull.length_m = 60.0, hull.beam_m = 12.0, hull.height_m = 15.0;
    hull.identity = 7;
    hull.cross_section_m2 = 2e4;
    return hull;
  }
  echo::Scene scene_with(std::vector<echo::Hull> hulls, PlanePoint own_velocity = {}) const {
    echo::Scene scene = *scenes::scene_at({}, scenes::kBergen, range_, geometry_, std::move(hulls));
    scene.own_velocity = own_velocity;
    return scene;
  }
  echo::ViewControls controls() const {
    echo::ViewControls made;
    made.range_scale = range_;
    made.sea = 0.0;
    made.doppler = echo::DopplerMode::both;
    made.doppler_threshold_mps = 2.0;
    return made;
  }
  // Looks at the spokes about a bearing.
  Seen look(const echo::Scene& scene, double bearing_deg,
            const echo::ViewControls& controls) const {
    ViewRenderers made(echo::RadarSet{}, geometry_, echo::SpokeClock(24.0, kSpokes), 0, range_, {},
                       echo::serial_for);
    made.set_view(0, controls);
    const auto middle = static_cast<std::uint64_t>(bearing_deg / 360.0 * kSpokes);
    made.render(scene, kSpokes + middle - 8, 16);
    Seen seen;
    const auto video = made.video(0);
    const auto classes = made.doppler(0);
    EXPECT_EQ(classes.size(), controls.doppler == echo::DopplerMode::off ? 0u : video.size());
    for (std::size_t i = 0; i < classes.size(); ++i) {
      seen.shown += video[i] > 0 ? 1 : 0;
      seen.bright += video[i] > 150 ? 1 : 0;
      seen.bright_and_coloured += video[i] > 150 && classes[i] != DopplerClass::none ? 1 : 0;
      seen.approaching += classes[i] == DopplerClass::approaching ? 1 : 0;
      seen.receding += classes[i] == DopplerClass::receding ? 1 : 0;
      if (classes[i] != DopplerClass::none) {
        EXPECT_GT(video[i], 0);
      }
    }
    return seen;
  }
};

// The range now and a second later says what must be seen, on every bearing and course.
TEST_F(Doppler, TellsWhetherTheRangeGrowsOrShrinks) {
  int approaching = 0, receding = 0, none = 0;
  for (const double bearing : {30.0, 100.0, 200.0, 315.0}) {
    for (int course = 0; course < 360; course += 30) {
      const double angle = course * std::numbers::pi / 180.0;
      const PlanePoint velocity{6.0 * std::sin(angle), 6.0 * std::cos(angle)};
      const PlanePoint own{3.0, 2.0};
      const echo::Hull hull = ship(bearing, velocity);
      const PlanePoint later = hull.centre + velocity - own;
      const double closing = kRange - std::hypot(later.east_m, later.north_m);
      if (std::fabs(std::fabs(closing) - 2.0) < 0.05) continue;
      const Seen seen = look(scene_with({hull}, own), bearing, controls());
      ASSERT_GT(seen.shown, 20u);
      const bool fast = std::fabs(closing) >= 2.0;
      EXPECT_EQ(seen.approaching > 20, fast && closing > 0.0) << bearing << ' ' << course;
      EXPECT_EQ(seen.receding > 20, fast && closing < 0.0) << bearing << ' ' << course;
      EXPECT_TRUE(seen.approaching == 0 || seen.receding == 0);
      (!fast ? none : closing > 0.0 ? approaching : receding)++;
    }
  }
  EXPECT_GT(approaching, 8);
  EXPECT_GT(receding, 8);
  EXPECT_GT(none, 4);
}

TEST_F(Doppler, WhatLiesStillHasNoColourHoweverFastTheOwnShipIs) {
  EXPECT_EQ(look(scene_with({ship(45.0, {})}, {7.0, 7.0}), 45.0, controls()).coloured(), 0u);
  scenes::NamedScene islands;
  for (scenes::NamedScene& named : scenes::made_up_scenes()) {
    if (named.name == "islands") islands = std::move(named);
  }
  echo::Scene under_way = *islands.scene;
  under_way.own_velocity = {0.0, 10.0};
  ViewRenderers made(islands.set, islands.geometry,
                     echo::SpokeClock(24.0, islands.geometry.spokes_per_turn), 0,
                     islands.controls.range_scale, {}, echo::serial_for);
  echo::ViewControls both = islands.controls;
  both.doppler = echo::DopplerMode::both;
  made.set_view(0, both);
  made.render(under_way, 0, 16);
  const auto classes = made.doppler(0);
  EXPECT_EQ(std::count(classes.begin(), classes.end(), DopplerClass::none),
            static_cast<std::ptrdiff_t>(classes.size()));
}

TEST_F(Doppler, ColoursWhatIsAskedFor) {
  const echo::Scene coming = scene_with({ship(45.0, {-5.0, -5.0})});
  const echo::Scene going = scene_with({ship(45.0, {5.0, 5.0})});
  echo::ViewControls asked = controls();
  asked.doppler = echo::DopplerMode::approaching;
  EXPECT_GT(look(coming, 45.0, asked).approaching, 20u);
  EXPECT_EQ(look(going, 45.0, asked).coloured(), 0u);
  asked.doppler_threshold_mps = 8.0;
  EXPECT_EQ(look(coming, 45.0, asked).coloured(), 0u) << "7.07 m/s are less";
  asked.doppler_threshold_mps = 7.0;
  EXPECT_GT(look(coming, 45.0, asked).approaching, 20u);
  asked.doppler = echo::DopplerMode::off;
  EXPECT_EQ(look(coming, 45.0, asked).coloured(), 0u);
}

TEST_F(Doppler, ColoursStretchedAndResampledEchoesWhole) {
  const echo::Scene coming = scene_with({ship(45.0, {-5.0, -5.0})});
  const Seen plain = look(coming, 45.0, controls());
  echo::ViewControls wide = controls();
  wide.echo_stretch = 100.0;
  const Seen stretched = look(coming, 45.0, wide);
  EXPECT_GT(stretched.approaching, plain.approaching + 40);
  echo::ViewControls other = controls();
  for (const double times : {0.7, 1.0, 1.6, 2.0}) {
    other.instrumented_range_m = times * range_.length().in_metres();
    const Seen seen = look(coming, 45.0, other);
    EXPECT_GT(seen.bright, 10u) << times;
    EXPECT_EQ(seen.bright_and_coloured, seen.bright) << times;
  }
}

TEST_F(Doppler, ChangesNoVideo) {
  const echo::Scene coming = scene_with({ship(45.0, {-5.0, -5.0})});
  const auto video = [&](echo::DopplerMode mode) {
    ViewRenderers made(echo::RadarSet{}, geometry_, echo::SpokeClock(24.0, kSpokes), 0, range_, {},
                       echo::serial_for);
    echo::ViewControls asked = controls();
    asked.doppler = mode;
    made.set_view(0, asked);
    made.render(coming, 112, 32);
    return std::vector<std::uint8_t>(made.video(0).begin(), made.video(0).end());
  };
  EXPECT_EQ(video(echo::DopplerMode::both), video(echo::DopplerMode::off));
}

}  // namespace
}  // namespace skerry::server
