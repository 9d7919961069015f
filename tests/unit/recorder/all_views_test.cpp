// Recordings of every view: those there are, those that come and those that go.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <memory>
#include <vector>

#include "protocol/wire/spoke_message.hpp"
#include "server/net/common/encoders.hpp"
#include "server/recorder/view_readers.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

using recording::Event;
using recording::Kind;
using State = wire::RecorderState;

class AllViews : public testing::Test {
 protected:
  AllViews() {
    config_.folder = folder_.path();
    config_.reserve_bytes = 0;
    config_.sync = Sync::none;
    config_.compression = recording::Compression::none;
  }
  Recorder& recorder() {
    if (!recorder_) {
      recorder_ = std::make_unique<Recorder>(host_, config_);
      recorder_->start();
    }
    return *recorder_;
  }
  void begin(const std::vector<std::uint32_t>& radars = {}) {
    host_.begin_utc = std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now());
    wire::Record record = record_of(wire::Record::START, "a");
    record.set_all_views(true);
    for (const std::uint32_t radar : radars) record.add_radars(radar);
    ASSERT_EQ(recorder().record(record, "instructor").code(), wire::Reply::OK);
    ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  }
  void end() {
    ASSERT_EQ(recorder().record(record_of(wire::Record::STOP), "instructor").code(),
              wire::Reply::OK);
    ASSERT_TRUE(reaches(recorder(), State::OFF)) << recorder().state().ShortDebugString();
  }
  // A view with the recorder's format.
  std::uint32_t open_unread(std::uint32_t radar = 0) {
    const auto view = host_.open_view(radar, 0, false, [](VideoChannel& channel) {
      channel.add_format(kNativeFormat, native_encoder());
    });
    return view.value();
  }
  // The recorder has seen all that was opened and closed: orders wait until it has looked.
  void settle() {
    const std::uint32_t marks = recorder().state().marks();
    EXPECT_EQ(recorder().record(record_of(wire::Record::MARK), "").code(), wire::Reply::OK);
    EXPECT_TRUE(comes_true([&] { return recorder().state().marks() == marks + 1; }));
  }
  std::uint32_t open(std::uint32_t radar = 0) {
    const std::uint32_t view = open_unread(radar);
    settle();
    return view;
  }
  void close(std::uint32_t view) {
    host_.close_view(0, view);
    settle();
  }
  // All of them taken.
  void publish(int sectors, std::uint32_t radar = 0) {
    const std::uint64_t before = taken();
    const std::uint64_t views = host_.view_count(radar);
    for (int i = 0; i < sectors; ++i) host_.publish(radar);
    EXPECT_TRUE(comes_true([&] { return taken() == before + sectors * 16u * views; }));
  }
  std::uint64_t taken() {
    const wire::RecorderState state = recorder().state();
    return state.spokes() + state.spokes_lost();
  }
  std::string spoke_bytes(std::uint32_t radar, std::uint32_t view, std::uint64_t sequence) const {
    Spoke made = host_.spoke(radar, sequence);
    made.header.view = view;
    wire::Spoke message;
    to_message(made, message);
    return message.SerializeAsString();
  }
  // Sequence numbers [from, to) of a view and no others, byte for byte.
  void expect_spokes(const Recorded& file, std::uint32_t radar, std::uint32_t view,
                     std::uint64_t from, std::uint64_t to) const {
    std::uint64_t next = from;
    for (const Recorded::Item& item : file.items) {
      if (item.topic != recording::Topic{Kind::spoke, radar, view}) continue;
      ASSERT_EQ(item.bytes, spoke_bytes(radar, view, next++));
    }
    EXPECT_EQ(next, to) << "radar " << radar << " view " << view;
  }
  // How often it is told that a view of radar 0 came and went.
  static void expect_told(const Recorded& file, std::uint32_t view, int opened, int closed) {
    std::map<std::string, int> told;
    for (const Event& event : file.events(Event::OTHER)) {
      ++told[event.text()];
      EXPECT_EQ(event.radar(), 0u);
      EXPECT_EQ(event.view(), view);
    }
    EXPECT_EQ(told, (std::map<std::string, int>{{"view opened", opened}, {"view closed", closed}}));
  }
  // Every spoke of a view comes after its settings.
  static void expect_settings_first(const Recorded& file) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, bool> told;
    for (const Recorded::Item& item : file.items) {
      bool& is_told = told[{item.topic.radar, item.topic.view}];
      if (item.topic.kind == Kind::settings) is_told = true;
      if (item.topic.kind != Kind::spoke) continue;
      ASSERT_TRUE(is_told) << "radar " << item.topic.radar << " view " << item.topic.view;
    }
  }

  ScratchFolder folder_;
  RecordedHost host_{2};
  RecorderConfig config_;
  std::unique_ptr<Recorder> recorder_;
};

TEST_F(AllViews, ThoseThereAreThoseThatComeAndUntilTheyGo) {
  EXPECT_EQ(open_unread(1), 1u);
  begin();
  publish(2);
  publish(2, 1);
  const std::uint64_t opened = host_.published(0);
  const std::uint32_t view = open();
  publish(3);
  const std::uint64_t closed = host_.published(0);
  close(view);
  publish(2);
  end();
  EXPECT_EQ(recorder().state().spokes_lost(), 0u);
  const Recorded file = recorded(folder_.path("a.mcap"));
  EXPECT_TRUE(file.is_whole);
  expect_spokes(file, 0, 0, 0, host_.published(0));
  expect_spokes(file, 0, view, opened, closed);
  expect_spokes(file, 1, 0, 0, host_.published(1));
  expect_spokes(file, 1, 1, 0, host_.published(1));
  expect_settings_first(file);
  expect_told(file, view, 1, 1);
  EXPECT_EQ(file.events(Event::STARTED).at(0).text(), "by instructor: radars 0, 1, all views");
}

TEST_F(AllViews, WhatARingHoldsIsTakenBeforeItsViewGoes) {
  begin();
  const std::uint32_t view = open();
  host_.publish();
  host_.close_view(0, view);
  end();
  expect_spokes(recorded(folder_.path("a.mcap")), 0, view, 0, 16);
}

TEST_F(AllViews, WithoutThemViewsAreLeftAlone) {
  ASSERT_EQ(recorder().record(record_of(wire::Record::START, "a"), "").code(), wire::Reply::OK);
  ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  const std::uint32_t view = open();
  EXPECT_FALSE(host_.find_channel(0, view)->format(kNativeFormat).has_readers());
  end();
  EXPECT_TRUE(recorded(folder_.path("a.mcap")).events(Event::OTHER).empty());
}

TEST_F(AllViews, OfTheRadarsThatAreRecorded) {
  begin({1});
  const std::uint32_t other = open_unread(0);
  open(1);
  publish(1, 1);
  EXPECT_FALSE(host_.find_channel(0, other)->format(kNativeFormat).has_readers());
  end();
  expect_spokes(recorded(folder_.path("a.mcap")), 1, 1, 0, 16);
}

TEST_F(AllViews, EachFileOfASeriesHasTheSettingsOfItsViewsFirst) {
  config_.roll_bytes = 400'000;
  begin();
  const std::uint32_t view = open();
  publish(16);
  ASSERT_TRUE(comes_true([&] { return folder_.recordings().size() > 1; }));
  close(view);
  const std::size_t files = folder_.recordings().size();
  publish(32);
  ASSERT_TRUE(comes_true([&] { return folder_.recordings().size() > files; }));
  end();
  std::uint64_t spokes = 0;
  const auto names = folder_.recordings();
  for (const std::string& name : names) {
    const Recorded file = recorded(folder_.path(name));
    expect_settings_first(file);
    for (const Recorded::Item& item : file.items) {
      spokes += item.topic == recording::Topic{Kind::spoke, 0, view};
    }
  }
  EXPECT_EQ(spokes, 256u);
  const auto number = fmt::format("a-{:03}.mcap", files + 1);
  for (const Recorded::Item& item : recorded(folder_.path(number)).items) {
    EXPECT_EQ(item.topic.view, 0u) << "it was closed before";
  }
}

TEST_F(AllViews, SettingsThatWereLostWithTheirChunkStandBeforeTheNextSpokes) {
  config_.max_queue = 300'000;
  begin();
  const std::uint32_t view = open();
  // More at once than may wait for the disk.
  ASSERT_TRUE(comes_true([&] {
    publish(16);
    return recorder().state().spokes_lost() > 0;
  }));
  publish(1);
  end();
  const Recorded file = recorded(folder_.path("a.mcap"));
  expect_settings_first(file);
  std::uint64_t lost = 0;
  for (const Event& event : file.events(Event::LOST)) {
    lost += event.view() == view ? event.count() : 0;
  }
  EXPECT_GT(lost, 0u);
  const auto spokes = std::count_if(file.items.begin(), file.items.end(), [&](const auto& item) {
    return item.topic == recording::Topic{Kind::spoke, 0, view};
  });
  EXPECT_EQ(static_cast<std::uint64_t>(spokes) + lost, host_.published(0));
}

TEST_F(AllViews, AViewThatIsClosedIsHeldNoLonger) {
  begin();
  const std::uint32_t view = open();
  const std::weak_ptr<VideoChannel> channel = host_.find_channel(0, view);
  publish(4);
  close(view);
  EXPECT_TRUE(channel.expired());
  end();
}

TEST_F(AllViews, AThousandViewsThatComeAndGoEndInAWholeFile) {
  constexpr std::size_t kRead = 10;
  begin();
  std::vector<std::uint32_t> read;
  for (int i = 0; i < 1000; ++i) {
    const std::uint32_t view = open_unread();
    if (i % 100 == 0) {
      settle();
      publish(1);
      read.push_back(view);
    }
    host_.close_view(0, view);
  }
  settle();
  publish(1);
  end();
  EXPECT_EQ(recorder().state().spokes_lost(), 0u);
  const Recorded file = recorded(folder_.path("a.mcap"));
  EXPECT_TRUE(file.is_whole);
  expect_spokes(file, 0, 0, 0, host_.published(0));
  for (std::size_t i = 0; i < kRead; ++i) expect_spokes(file, 0, read.at(i), i * 16, i * 16 + 16);
  expect_settings_first(file);
}

TEST_F(AllViews, ANumberThatComesBackIsAnotherView) {
  begin();
  const std::uint32_t view = open();
  publish(2);
  const std::weak_ptr<VideoChannel> first = host_.find_channel(0, view);
  host_.close_view(0, view);
  host_.count_views_from(view - 1);
  ASSERT_EQ(open(), view);
  EXPECT_TRUE(first.expired());
  publish(2);
  end();
  const Recorded file = recorded(folder_.path("a.mcap"));
  expect_spokes(file, 0, view, 0, 64);
  expect_told(file, view, 2, 1);
}

TEST_F(AllViews, OneWithoutTheFormatIsPassedOver) {
  begin();
  ASSERT_TRUE(host_.open_view(0, 0, false, [](VideoChannel&) {}));
  EXPECT_EQ(open(), 2u);
  host_.publish();
  ASSERT_TRUE(comes_true([&] { return taken() == 32; }));
  end();
  EXPECT_TRUE(recorded(folder_.path("a.mcap")).is_whole);
}

TEST_F(AllViews, AreNotOfInputsAloneNorOfRadarsThatAreNotThere) {
  host_.has_exercise = true;
  wire::Record record = record_of(wire::Record::START);
  record.set_all_views(true);
  record.set_inputs_only(true);
  const wire::Reply reply = recorder().record(record, "");
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_NE(reply.text().find("all_views"), std::string::npos) << reply.text();
  record.set_inputs_only(false);
  record.add_radars(0);
  record.add_radars(7);
  EXPECT_EQ(recorder().record(record, "").code(), wire::Reply::UNKNOWN);
  EXPECT_TRUE(folder_.recordings().empty());
}

TEST_F(AllViews, FromTheStartIfConfigured) {
  config_.record_at_start = config_.record_all_views = true;
  ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  EXPECT_TRUE(recorder().state().all_views());
  const std::uint32_t view = open();
  publish(1);
  recorder().stop();
  expect_spokes(recorded(folder_.path(folder_.recordings().at(0))), 0, view, 0, 16);
}

// A file's list of views is held until its end, so there is a bound.
TEST(ViewReaders, TakesNoMoreViewsIntoAFileThanItMay) {
  RecordedHost host;
  ViewReaders readers(host, {{0}, true, kNativeFormat}, [] {});
  std::size_t opened = 0, left_out = 0;
  const ViewReaders::Changes changes{.opened = [&](RingReader&) { ++opened; },
                                     .closed = [](RingReader&) {},
                                     .left_out = [&](std::uint32_t, std::uint32_t) { ++left_out; }};
  const auto open_and_close = [&] {
    const auto view = host.open_view(0, 0, false, [](VideoChannel& channel) {
      channel.add_format(kNativeFormat, native_encoder());
    });
    readers.look(changes);
    host.close_view(0, *view);
    readers.look(changes);
  };
  for (std::size_t i = 1; i < ViewReaders::kMaxInFile; ++i) open_and_close();
  EXPECT_EQ(opened, ViewReaders::kMaxInFile - 1) << "and view 0";
  EXPECT_EQ(left_out, 0u);
  open_and_close();
  open_and_close();
  EXPECT_EQ(opened, ViewReaders::kMaxInFile - 1);
  EXPECT_EQ(left_out, 1u) << "told once";
  readers.file_begins();
  open_and_close();
  EXPECT_EQ(opened, ViewReaders::kMaxInFile);
}

}  // namespace
}  // namespace skerry::server
