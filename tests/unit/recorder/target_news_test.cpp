// Targets of the plotters at work on their way into a recording.
#include "server/recorder/target_news.hpp"

#include <gtest/gtest.h>

#include "tests/unit/net/fake_plotters.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

constexpr std::uint64_t kMs = 1'000'000;

// Plotters that tell a list whenever the test says so.
class TargetNewsTest : public testing::Test {
 protected:
  void tell(std::uint64_t after_ms) {
    plotters_.change([&](wire::TargetList& list) { list.set_utc_ns(kFirst + after_ms * kMs); });
  }
  TargetNews::News look(std::uint32_t view = 0) { return news_.take(plotters_, 0, view); }

  static constexpr std::uint64_t kFirst = 1'795'000'000'000'000'000;
  FakePlotters plotters_;
  TargetNews news_;
};

TEST_F(TargetNewsTest, OfTwoListsASecondOneIsRecorded) {
  std::vector<std::uint64_t> told_ms;
  for (std::uint64_t ms = 0; ms <= 4000; ms += 500) {
    tell(ms);
    for (int i = 0; i < 3; ++i) {
      if (const auto news = look(); news.list)
        told_ms.push_back((news.list->utc_ns() - kFirst) / kMs);
    }
  }
  EXPECT_EQ(told_ms, (std::vector<std::uint64_t>{0, 1000, 2000, 3000, 4000}));
}

TEST_F(TargetNewsTest, ListsWhoseTimesWaverAreStillOneASecond) {
  std::size_t lists = 0;
  for (std::uint64_t i = 0; i < 40; ++i) {
    tell(500 * i + (i % 3) * 60);
    lists += look().list.has_value();
  }
  EXPECT_EQ(lists, 20u);
}

TEST_F(TargetNewsTest, AListIsWithoutPastPlaces) {
  plotters_.change([](wire::TargetList& list) {
    wire::Target& target = *list.add_targets() = FakePlotters::target(7, 3000.0);
    target.add_past()->set_range_m(3100.0);
  });
  const auto news = look();
  ASSERT_TRUE(news.list);
  ASSERT_EQ(news.list->targets_size(), 1);
  EXPECT_EQ(news.list->targets(0).past_size(), 0);
  wire::Target wanted = FakePlotters::target(7, 3000.0);
  EXPECT_EQ(news.list->targets(0).SerializeAsString(), wanted.SerializeAsString());
}

TEST_F(TargetNewsTest, AllPlotsAreRecordedOnce) {
  std::vector<std::uint64_t> firsts;
  for (std::uint64_t i = 0; i < 8; ++i) {
    tell(500 * i);
    wire::TargetPlots plots;
    plots.set_first(10 * i);
    if (i != 3) plots.add_plots()->set_range_m(500.0);  // at i = 3 none was found
    plotters_.tell_plots(plots);
    for (int k = 0; k < 2; ++k) {
      if (const auto news = look(); news.plots) firsts.push_back(news.plots->first());
    }
  }
  EXPECT_EQ(firsts, (std::vector<std::uint64_t>{0, 10, 20, 40, 50, 60, 70}));
}

TEST_F(TargetNewsTest, OfAViewThatNobodyWantsThereIsNothing) {
  plotters_.tell_plots({});
  for (const std::uint32_t view : {1u, 2u}) {
    const auto news = look(view);
    EXPECT_FALSE(news.list);
    EXPECT_EQ(news.plots, nullptr);
  }
  EXPECT_FALSE(plotters_.is_wanted()) << "recording them starts no plotter";
}

TEST_F(TargetNewsTest, APlotterThatBeginsAnewIsToldAtOnce) {
  ASSERT_TRUE(look().list);
  plotters_.forget();
  EXPECT_FALSE(look().list);
  tell(100);
  EXPECT_TRUE(look().list);
}

TEST_F(TargetNewsTest, TimeThatGoesBackIsFollowed) {
  tell(60'000);
  ASSERT_TRUE(look().list);
  tell(0);
  const auto back = look();
  ASSERT_TRUE(back.list);
  EXPECT_EQ(back.list->utc_ns(), kFirst);
  tell(500);
  EXPECT_FALSE(look().list);
  tell(1000);
  EXPECT_TRUE(look().list);
}

// With a plotter at work on radar 0 alone.
class RecordingOfTargets : public testing::Test {
 protected:
  RecordingOfTargets() { host_.plotters = &plotters_; }
  Recorded record(const wire::Record& record) {
    RecorderConfig config;
    config.folder = folder_.path();
    config.reserve_bytes = 0;
    config.sync = Sync::none;
    Recorder recorder(host_, config);
    recorder.start();
    EXPECT_EQ(recorder.record(record, "test").code(), wire::Reply::OK);
    EXPECT_TRUE(reaches(recorder, wire::RecorderState::RECORDING));
    for (std::uint64_t second = 0; second < 3; ++second) {
      wire::TargetPlots plots;
      plots.set_first(second);
      plots.add_plots()->set_range_m(100.0 * static_cast<double>(second + 1));
      plotters_.tell_plots(plots);
      plotters_.change([&](wire::TargetList& list) {
        list.set_utc_ns(list.utc_ns() + 1000 * kMs);
        if (second == 1) *list.add_targets() = FakePlotters::target(3, 1852.0);
      });
      // Two looks: the first may have begun before the change.
      const int looks = host_.looks;
      EXPECT_TRUE(comes_true([&] { return host_.looks >= looks + 2; }));
    }
    recorder.record(record_of(wire::Record::STOP), "test");
    EXPECT_TRUE(reaches(recorder, wire::RecorderState::OFF));
    recorder.stop();
    return recorded(folder_.path(record.name() + ".mcap"));
  }

  // Counts the recorder's looks at the plotters.
  class WatchedHost final : public RecordedHost {
   public:
    using RecordedHost::RecordedHost;
    TargetPort* targets() override {
      ++looks;
      return FakeHost::targets();
    }
    std::atomic<int> looks = 0;
  };
  const ScratchFolder folder_;
  WatchedHost host_{2};
  FakePlotters plotters_;
};

TEST_F(RecordingOfTargets, HasTheListsAndPlotsOfTheViewWhosePlotterIsAtWork) {
  const Recorded file = record(record_of(wire::Record::START, "a"));
  EXPECT_TRUE(file.is_whole);
  const auto lists = file.of(recording::Kind::targets), plots = file.of(recording::Kind::plots);
  ASSERT_GE(lists.size(), 3u);
  ASSERT_EQ(plots.size(), 3u);
  wire::TargetList last;
  ASSERT_TRUE(last.ParseFromString(lists.back()));
  ASSERT_EQ(last.targets_size(), 1);
  EXPECT_EQ(last.targets(0).number(), 3u);
  EXPECT_EQ(last.targets(0).range_m(), 1852.0);
  for (std::size_t i = 0; i < plots.size(); ++i) {
    wire::TargetPlots told;
    ASSERT_TRUE(told.ParseFromString(plots[i]));
    EXPECT_EQ(told.first(), i);
  }
  EXPECT_TRUE(file.of(recording::Kind::targets, 1).empty());
  EXPECT_TRUE(file.of(recording::Kind::plots, 1).empty());
}

TEST_F(RecordingOfTargets, OfInputsAloneHasNone) {
  host_.has_exercise = true;
  host_.inputs.add("first");
  wire::Record inputs = record_of(wire::Record::START, "inputs");
  inputs.set_inputs_only(true);
  const Recorded file = record(inputs);
  EXPECT_FALSE(file.of(recording::Kind::input).empty());
  EXPECT_TRUE(file.of(recording::Kind::targets).empty());
  EXPECT_TRUE(file.of(recording::Kind::plots).empty());
}

}  // namespace
}  // namespace skerry::server
