// Views that follow another, and views that show more or less than the radar's range scale.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

#include "server/radar/radar_view.hpp"
#include "server/radar/view_renderers.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::server {
namespace {

const auto kNoFormats = [](VideoChannel&) {};

TEST(FollowingViews, HaveTheControlsOfAnotherButTheirOwnInstrumentedRange) {
  RadarViewList views(echo::ViewControls{}, 8);
  const RadarViewPtr hidden = views.open(0, true, kNoFormats);
  echo::ViewControls own;
  own.instrumented_range_m = 30'000.0;
  hidden->set_controls(own);
  echo::ViewControls console;
  console.gain = 77.0;
  console.instrumented_range_m = 24'000.0;
  views.find(0)->controls.set(console);

  EXPECT_TRUE(hidden->follows());
  EXPECT_EQ(hidden->controls_in_force().gain, 77.0);
  EXPECT_EQ(hidden->controls_in_force().instrumented_range_m, 30'000.0);
  EXPECT_FALSE(views.find(0)->follows());
}

TEST(FollowingViews, ChangeWhatTheyFollow) {
  RadarViewList views(echo::ViewControls{}, 8);
  const RadarViewPtr hidden = views.open(0, true, kNoFormats);
  const RadarViewPtr behind = views.open(hidden->number, true, kNoFormats);
  const RadarViewPtr own = views.open(0, false, kNoFormats);
  EXPECT_EQ(behind->followed, views.find(0)) << "a chain of views ends at the first";

  echo::ViewControls wanted = behind->controls_in_force();
  wanted.sea = 66.0;
  wanted.instrumented_range_m = 25'000.0;
  behind->set_controls(wanted);
  EXPECT_EQ(views.find(0)->controls.get()->sea, 66.0);
  EXPECT_EQ(views.find(0)->controls.get()->instrumented_range_m, 0.0);
  EXPECT_EQ(hidden->controls_in_force().sea, 66.0);
  EXPECT_EQ(hidden->controls_in_force().instrumented_range_m, 0.0);
  EXPECT_NE(own->controls_in_force().sea, 66.0);
}

TEST(FollowingViews, GoOnWhenWhatTheyFollowHasEnded) {
  RadarViewList views(echo::ViewControls{}, 8);
  echo::ViewControls controls;
  controls.gain = 31.0;
  const std::uint32_t number = views.open(0, false, kNoFormats)->number;
  views.find(number)->controls.set(controls);
  const RadarViewPtr hidden = views.open(number, true, kNoFormats);
  views.close(number);
  EXPECT_EQ(hidden->controls_in_force().gain, 31.0);
}

// A ship due north of an own ship on open water, seen on 3 NM.
class InstrumentedRange : public testing::Test {
 protected:
  static constexpr double kScale = 3.0 * 1852.0;
  static constexpr std::uint32_t kCells = 512, kSpokes = 1024;
  const ScanGeometry geometry_{kSpokes, kCells, 8};
  const RangeScale range_ = *RangeScale::find(3.0);

  static echo::Hull ship_at(double north_m) {
    echo::Hull hull;
    hull.centre = {0.0, north_m};
    hull.length_m = 100.0, hull.beam_m = 16.0, hull.height_m = 20.0;
    hull.identity = 5;
    hull.cross_section_m2 = 1e5;
    return hull;
  }
  echo::ScenePtr with(std::vector<echo::Hull> hulls) const {
    return scenes::scene_at({}, scenes::kBergen, *RangeScale::find(6.0), geometry_,
                            std::move(hulls));
  }
  ViewRenderers renderers() const {
    return {echo::RadarSet{}, geometry_, echo::SpokeClock(24.0, kSpokes), 0, range_, {},
            echo::serial_for};
  }
  echo::ViewControls reaching(double instrumented_m) const {
    echo::ViewControls controls;
    controls.range_scale = range_;
    controls.gain = 40.0;
    controls.sea = 0.0;
    controls.instrumented_range_m = instrumented_m;
    return controls;
  }
  // The cell of the strongest video over the bow, and how strong.
  static std::pair<std::uint32_t, int> strongest(std::span<const std::uint8_t> video) {
    const auto bow = video.first(kCells);
    const auto at = std::max_element(bow.begin(), bow.end());
    return {static_cast<std::uint32_t>(at - bow.begin()), *at};
  }
};

TEST_F(InstrumentedRange, ShowsWhatLiesBeyondTheRangeScale) {
  const echo::ScenePtr scene = with({ship_at(1.6 * kScale)});
  for (const double times : {1.7, 2.0, 1.81}) {
    ViewRenderers made = renderers();
    made.set_view(0, reaching(0.0));
    made.set_view(1, reaching(times * kScale));
    made.render(*scene, 0, 16);
    EXPECT_LT(strongest(made.video(0)).second, 60) << "beyond the range scale";
    const auto [cell, level] = strongest(made.video(1));
    EXPECT_GT(level, 150) << times;
    EXPECT_NEAR((cell + 0.5) * times * kScale / kCells, 1.6 * kScale, 80.0) << times;
    EXPECT_DOUBLE_EQ(made.instrumented_range_of(1).in_metres(), times * kScale);
    EXPECT_EQ(made.instrumented_range_of(0).in_metres(), 0.0);
  }
}

TEST_F(InstrumentedRange, MayEndBeforeTheRangeScale) {
  ViewRenderers made = renderers();
  made.set_view(1, reaching(0.7 * kScale));
  made.render(*with({ship_at(0.5 * kScale)}), 0, 16);
  const auto [cell, level] = strongest(made.video(1));
  EXPECT_GT(level, 150);
  EXPECT_NEAR((cell + 0.5) * 0.7 * kScale / kCells, 0.5 * kScale, 60.0);
}

TEST_F(InstrumentedRange, IsCutToTwiceTheRangeScale) {
  echo::ViewControls far = reaching(100'000.0);
  EXPECT_DOUBLE_EQ(echo::reach_of(far).in_metres(), 2.0 * kScale);
  EXPECT_EQ(echo::row_cells_for(geometry_, range_, far), 2 * kCells);
  EXPECT_EQ(echo::row_cells_for(geometry_, range_, reaching(1.3 * kScale)), kCells * 3 / 2);
  EXPECT_EQ(echo::row_cells_for(geometry_, range_, reaching(0.0)), kCells);
  EXPECT_EQ(echo::row_cells_for(geometry_, *RangeScale::find(12.0), far), kCells)
      << "a view on a shorter scale than the radar's";
}

// On the sea, among ships, the cells a console shows are not touched by longer rows.  (Land that
// the end of the rows cuts is as high as far as it is seen to go.)
TEST_F(InstrumentedRange, ChangesNothingInTheViewsOfOthers) {
  scenes::NamedScene traffic;
  for (scenes::NamedScene& named : scenes::made_up_scenes()) {
    if (named.name == "traffic") traffic = std::move(named);
  }
  const auto shown = [&](double times) {
    ViewRenderers made(traffic.set, traffic.geometry,
                       echo::SpokeClock(24.0, traffic.geometry.spokes_per_turn), 0,
                       traffic.controls.range_scale, {}, echo::serial_for);
    echo::ViewControls other = traffic.controls;
    other.instrumented_range_m = times * traffic.controls.range_scale.length().in_metres();
    std::vector<std::uint8_t> video;
    for (std::uint64_t first = 0; first < 512; first += 16) {
      made.set_view(0, traffic.controls);
      if (times > 0.0) made.set_view(1, other);
      made.render(*traffic.scene, first, 16);
      video.insert(video.end(), made.video(0).begin(), made.video(0).end());
    }
    return video;
  };
  const auto alone = shown(0.0);
  EXPECT_EQ(shown(2.0), alone);
  EXPECT_EQ(shown(0.6), alone);
}

// A view keeps what it has learnt of the turn when rows become longer for another.
TEST_F(InstrumentedRange, LongerRowsInterruptNobody) {
  const echo::ScenePtr scene = with({ship_at(0.5 * kScale)});
  echo::ViewControls summing = reaching(0.0);
  summing.integration = 100.0;
  const auto shown = [&](bool company) {
    ViewRenderers made = renderers();
    made.set_view(0, summing);
    std::vector<std::uint8_t> video;
    for (std::uint64_t first = 0; first < 64; first += 16) {
      if (company && first == 32) made.set_view(1, reaching(1.5 * kScale));
      if (company && first == 48) made.keep_views([](std::uint32_t view) { return view == 0; });
      made.render(*scene, first, 16);
      video.insert(video.end(), made.video(0).begin(), made.video(0).end());
    }
    return video;
  };
  EXPECT_EQ(shown(true), shown(false));
}

}  // namespace
}  // namespace skerry::server
