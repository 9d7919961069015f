// Views of a radar: how many, which numbers, one set of returns for all.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

#include "server/radar/radar_view.hpp"
#include "server/radar/view_renderers.hpp"
#include "tests/scenes/scenes.hpp"

namespace skerry::server {
namespace {

RadarViewPtr opened(RadarViewList& views) {
  return views.open(0, false, [](VideoChannel&) {});
}

TEST(RadarViews, AreBoundedAndTheFirstIsAlwaysThere) {
  RadarViewList views(echo::ViewControls{}, 8);
  std::set<std::uint32_t> numbers = {0};
  while (const RadarViewPtr view = opened(views)) numbers.insert(view->number);
  EXPECT_EQ(numbers.size(), RadarViewList::kMaxViews);
  views.close(0);
  EXPECT_NE(views.find(0), nullptr);
  EXPECT_EQ(opened(views), nullptr);
  views.close(5);
  EXPECT_EQ(views.find(5), nullptr);
  const RadarViewPtr again = opened(views);
  ASSERT_NE(again, nullptr);
  EXPECT_EQ(again->number, RadarViewList::kMaxViews) << "5 is not given again at once";
}

TEST(RadarViews, BeginWithTheControlsOfAnotherAndThenHaveTheirOwn) {
  echo::ViewControls controls;
  controls.gain = 61.0;
  RadarViewList views(controls, 8);
  const RadarViewPtr own = opened(views);
  EXPECT_EQ(own->controls.get()->gain, 61.0);
  controls.gain = 20.0;
  own->controls.set(controls);
  EXPECT_EQ(views.get()->front()->controls.get()->gain, 61.0);
}

TEST(RadarViews, FormatsAreThereBeforeAnybodySeesTheView) {
  RadarViewList views(echo::ViewControls{}, 8);
  std::size_t seen = 0;
  views.open(0, false, [&](VideoChannel&) { seen = views.get()->size(); });
  EXPECT_EQ(seen, 1u);
  EXPECT_EQ(views.get()->size(), 2u);
}

class SharedReturns : public testing::Test {
 protected:
  static scenes::NamedScene islands() {
    for (scenes::NamedScene& named : scenes::made_up_scenes()) {
      if (named.name == "islands") return std::move(named);
    }
    throw std::logic_error("there is no scene of islands");
  }
  const scenes::NamedScene islands_ = islands();
  const RangeScale range_ = islands_.controls.range_scale;

  ViewRenderers renderers() const {
    return {islands_.set,
            islands_.geometry,
            echo::SpokeClock(24.0, islands_.geometry.spokes_per_turn),
            0,
            range_,
            {},
            echo::serial_for};
  }
  static echo::ViewControls at(RangeScale range, double gain) {
    echo::ViewControls controls;
    controls.range_scale = range;
    controls.gain = gain;
    return controls;
  }
  static double mean(std::span<const std::uint8_t> video) {
    return std::accumulate(video.begin(), video.end(), 0.0) / static_cast<double>(video.size());
  }
};

TEST_F(SharedReturns, TwoViewsOfTheSameControlsShowTheSame) {
  ViewRenderers both = renderers();
  both.set_view(0, at(range_, 50.0));
  both.set_view(7, at(range_, 50.0));
  both.render(*islands_.scene, 0, 16);
  const auto a = both.video(0), b = both.video(7);
  ASSERT_EQ(a.size(), std::size_t{16} * islands_.geometry.cells);
  EXPECT_GT(mean(a), 0.0);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
}

TEST_F(SharedReturns, AViewsControlsChangeNoOthersVideo) {
  const RangeScale shorter = *RangeScale::from_index(range_.index() - 1);
  const auto shown = [&](bool company) {
    ViewRenderers made = renderers();
    made.set_view(0, at(range_, 50.0));
    if (company) made.set_view(1, at(shorter, 85.0));
    std::vector<std::uint8_t> video;
    for (std::uint64_t first = 0; first < 64; first += 16) {
      made.render(*islands_.scene, first, 16);
      video.insert(video.end(), made.video(0).begin(), made.video(0).end());
      if (company) {
        EXPECT_GT(mean(made.video(1)), mean(made.video(0)) + 10.0);
        EXPECT_EQ(made.range_of(1), shorter);
      }
    }
    return video;
  };
  EXPECT_EQ(shown(false), shown(true));
}

TEST_F(SharedReturns, AViewThatIsGoneIsForgotten) {
  ViewRenderers made = renderers();
  made.set_view(0, at(range_, 50.0));
  made.set_view(1, at(range_, 50.0));
  made.keep_views([](std::uint32_t number) { return number == 0; });
  EXPECT_THROW(made.video(1), std::out_of_range);
  EXPECT_NO_THROW(made.video(0));
}

}  // namespace
}  // namespace skerry::server
