// Tracks as recordings, and the lists of recordings as tables.
#include "server/track_tool/recorded_tracks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <stdexcept>

#include "server/plotter/judge/tracks_csv.hpp"
#include "server/track_tool/track_recording.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::server {
namespace {

using recording::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;
using testing::ElementsAre;
using testing::HasSubstr;

struct Rows : TableWriter {
  void row(const TrackRow& row) override { rows.push_back(row); }
  void finish() override {}
  std::vector<std::uint32_t> numbers() const {
    std::vector<std::uint32_t> all;
    for (const TrackRow& row : rows) all.push_back(row.number);
    return all;
  }
  std::vector<TrackRow> rows;
};

wire::TargetList list_at(Duration since, std::uint64_t plots = 100) {
  wire::TargetList list;
  list.set_utc_ns(static_cast<std::uint64_t>((kRecordedAt + since).time_since_epoch().count()));
  list.set_own_latitude_deg(60.0);
  list.set_own_longitude_deg(4.9332846);
  list.set_plots(plots);
  return list;
}

wire::Target& add_target(wire::TargetList& list, std::uint32_t number,
                         wire::TargetState state = wire::TARGET_TRACKED) {
  wire::Target& target = *list.add_targets();
  target.set_number(number);
  target.set_state(state);
  target.set_latitude_deg(60.0);
  target.set_longitude_deg(5.0);
  target.set_range_m(3704.0);
  target.set_bearing_deg(90.0);
  target.set_hits(8);
  target.set_looks(10);
  if (state != wire::TARGET_TREND && state != wire::TARGET_TRACKED) return target;
  target.set_course_deg(270.0);
  target.set_speed_kn(9.0);
  target.set_cpa_nm(0.25);
  target.set_tcpa_min(4.0);
  return target;
}

std::string csv_of(const std::vector<wire::TargetList>& lists) {
  std::string text;
  TrackCsv csv(1, [&](std::string_view more) { text += more; });
  RecordedTracks tracks(csv);
  for (const wire::TargetList& list : lists) tracks.add(kRecordedAt, list);
  return text.substr(text.find('\n') + 1);
}

TEST(RecordedTracks, AreRowsAsTheSetToldThem) {
  wire::TargetList list = list_at(milliseconds(500));
  add_target(list, 3);
  add_target(list, 4, wire::TARGET_ACQUIRING).set_by_hand(true);
  EXPECT_EQ(csv_of({list}),
            "1795341600.500,1,3,tracked,60.0000000,5.0000000,270.00,9.00,2.0000,90.00,0.2500,4.00,"
            "0.0,8,10,0,60.0000000,4.9332846\n"
            "1795341600.500,1,4,tracked,60.0000000,5.0000000,,,2.0000,90.00,,,"
            "0.0,8,10,1,60.0000000,4.9332846\n");
}

TEST(RecordedTracks, ALostOneHasOneRow) {
  std::vector<wire::TargetList> lists;
  Rows rows;
  RecordedTracks tracks(rows);
  for (int i = 0; i < 5; ++i) {
    wire::TargetList list = list_at(seconds(i));
    add_target(list, 3, i < 2 ? wire::TARGET_TRACKED : wire::TARGET_LOST);
    tracks.add(kRecordedAt, list);
  }
  ASSERT_EQ(rows.rows.size(), 3u);
  EXPECT_EQ(rows.rows.back().status, TrackStatus::lost);
  EXPECT_EQ(tracks.targets(), 1u);
  EXPECT_EQ(tracks.lists(), 5u);
}

TEST(RecordedTracks, APlotterThatBeginsAnewGivesOtherNumbers) {
  Rows rows;
  RecordedTracks tracks(rows);
  for (const std::uint64_t plots : {100u, 200u, 7u, 30u}) {
    wire::TargetList list = list_at(seconds(1), plots);
    add_target(list, 1);
    add_target(list, 5);
    tracks.add(kRecordedAt, list);
  }
  EXPECT_THAT(rows.numbers(), ElementsAre(1, 5, 1, 5, 6, 10, 6, 10));
}

TEST(RecordedTracks, TestTargetsAreNone) {
  wire::TargetList list = list_at({});
  add_target(list, 1'000'001).set_is_test(true);
  add_target(list, 0);
  EXPECT_EQ(csv_of({list}), "");
}

TEST(RecordedTracks, NumbersAndTimesFromOutsideAreBorne) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const RecordedFile recorded([&](recording::RecordingWriter& writer) {
    for (const std::uint64_t plots : {10u, 0u, 5u, 0u}) {
      wire::TargetList list = list_at({}, plots);
      list.set_utc_ns(std::numeric_limits<std::uint64_t>::max());
      for (int i = 0; i < 3000; ++i) {
        wire::Target& target = add_target(list, std::numeric_limits<std::uint32_t>::max());
        target.set_latitude_deg(nan);
        target.set_course_deg(-1e300);
        target.set_cpa_nm(std::numeric_limits<double>::infinity());
        target.set_range_m(nan);
      }
      add(writer, {Kind::targets, 0, 2}, kRecordedAt, list);
    }
    const std::uint8_t junk[] = {0xFF, 0xFF, 0xFF};
    writer.add(recording::Item{{Kind::targets, 0, 2}, kRecordedAt + seconds(1), junk});
  });
  const auto reader = recorded.open();
  std::string text;
  TrackCsv csv(0, [&](std::string_view more) { text += more; });
  const ListsTaken taken = write_recorded(reader, chosen_lists(reader, {}), csv);
  EXPECT_EQ(taken.lists, 4u);
  EXPECT_EQ(taken.refused, 1u);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(text.find("inf"), std::string::npos);
  EXPECT_THAT(text, HasSubstr(",4294967295,tracked,-90.0000000,"));
  EXPECT_LT(text.size(), 1'000'000u);
}

TEST(RecordedTracks, OfAFileWithoutListsAreRefusedInWords) {
  const auto error_of = [](const RecordedFile& file, const RecordedChoice& choice) {
    try {
      chosen_lists(file.open(), choice);
    } catch (const std::runtime_error& error) {
      return std::string(error.what());
    }
    return std::string("no error");
  };
  const RecordedFile without({.turns = 1});
  EXPECT_THAT(error_of(without, {}), HasSubstr(without.path() + ": it holds no lists of targets"));
  const RecordedFile with([](recording::RecordingWriter& writer) {
    add(writer, {Kind::targets, 1, 2}, kRecordedAt, list_at({}));
  });
  EXPECT_EQ(error_of(with, {}), "no error");
  EXPECT_EQ(error_of(with, {.radar = 1, .view = 2}), "no error");
  EXPECT_THAT(error_of(with, {.radar = 0, .view = {}}), HasSubstr("those of radar 1 view 2"));
}

// A ship 2 NM in the east that steers south; own ship goes north with 5 m/s.
PlottedTrack ship(std::uint32_t number, Duration since) {
  PlottedTrack track;
  track.number = number;
  track.status = TrackStatus::tracked;
  track.time = ScenarioTime(since);
  track.utc = kRecordedAt + since;
  track.place = {60.0, 5.0};
  track.velocity_mps = {0.0, -5.0};
  track.relative_velocity_mps = {0.0, -10.0};
  track.own_ship = {60.0, 4.9332846};
  track.range_m = 3704.0;
  track.bearing = TrueBearing::from(degrees(90.0));
  return track;
}

TEST(TrackRecording, IsReadAsARecordingOfTargetsAndPlots) {
  const RecordedFile file([](recording::RecordingWriter&) {});  // for its name
  wire::Hello hello;
  hello.add_radars()->set_radar(2);
  std::string bytes;
  TrackRecording writer({2, 1, hello}, [&](std::string_view more) { bytes += more; });
  Plot plot;
  plot.utc = kRecordedAt + seconds(1);
  plot.range_m = 1000.0;
  writer.plot(plot);
  writer.plot(plot);
  const PlottedTrack young = ship(1, seconds(2));
  writer.turn({&young, 1}, {});
  writer.turn({}, {});
  const PlottedTrack old = ship(1, seconds(100));
  PlottedTrack gone = ship(2, seconds(90));
  gone.status = TrackStatus::lost;
  writer.turn({&old, 1}, {&gone, 1});
  writer.plot(plot);
  writer.finish();
  std::ofstream(file.path(), std::ios::binary | std::ios::trunc) << bytes;

  const auto reader = file.open();
  EXPECT_FALSE(reader.summary().damage);
  ASSERT_TRUE(reader.hello());
  EXPECT_EQ(reader.hello()->radars(0).radar(), 2u);
  std::vector<wire::TargetList> lists;
  std::vector<wire::TargetPlots> plots;
  auto items = reader.items();
  while (const auto item = items.next()) {
    const int size = static_cast<int>(item->bytes.size());
    if (item->topic == recording::Topic{Kind::targets, 2, 1}) {
      ASSERT_TRUE(lists.emplace_back().ParseFromArray(item->bytes.data(), size));
      EXPECT_EQ(static_cast<std::uint64_t>(item->time.time_since_epoch().count()),
                lists.back().utc_ns());
    } else if (item->topic == recording::Topic{Kind::plots, 2, 1}) {
      ASSERT_TRUE(plots.emplace_back().ParseFromArray(item->bytes.data(), size));
    } else {
      EXPECT_EQ(item->topic.kind, Kind::hello);
    }
  }
  ASSERT_EQ(lists.size(), 2u);
  ASSERT_EQ(lists[0].targets_size(), 1);
  EXPECT_EQ(lists[0].targets(0).state(), wire::TARGET_ACQUIRING);
  EXPECT_FALSE(lists[0].targets(0).has_course_deg() || lists[0].targets(0).has_cpa_nm());
  ASSERT_EQ(lists[1].targets_size(), 2);
  const wire::Target& told = lists[1].targets(0);
  EXPECT_EQ(told.state(), wire::TARGET_TREND);
  EXPECT_NEAR(told.course_deg(), 180.0, 1e-9);
  EXPECT_NEAR(told.speed_kn(), 5.0 * 3600.0 / 1852.0, 1e-9);
  EXPECT_NEAR(told.relative_speed_kn(), 10.0 * 3600.0 / 1852.0, 1e-9);
  EXPECT_NEAR(told.cpa_nm(), 2.0, 1e-9);
  EXPECT_EQ(lists[1].targets(1).state(), wire::TARGET_LOST);
  EXPECT_NEAR(lists[1].own_course_deg(), 0.0, 1e-9);
  EXPECT_NEAR(lists[1].own_speed_kn(), 5.0 * 3600.0 / 1852.0, 1e-9);
  EXPECT_EQ(lists[1].tracked(), 1u);
  ASSERT_EQ(plots.size(), 2u);
  EXPECT_EQ(plots[0].plots_size(), 2);
  EXPECT_EQ(plots[0].plots(0).range_m(), 1000.0);
  EXPECT_EQ(plots[1].first(), 2u);

  // And its lists are a table again, which a judge can read.
  std::string csv;
  TrackCsv table(2, [&](std::string_view more) { csv += more; });
  EXPECT_EQ(write_recorded(reader, chosen_lists(reader, {}), table).lists, 2u);
  const ReadTracks read = read_tracks_csv(csv, "known.csv");
  ASSERT_EQ(read.told.size(), 1u);
  ASSERT_EQ(read.told[0].tracks.size(), 2u);
  EXPECT_EQ(read.told[0].tracks[0].points.size(), 2u);
  EXPECT_FALSE(read.told[0].tracks[0].points[0].course_deg);
  EXPECT_EQ(read.told[0].tracks[1].points[0].status, ToldStatus::lost);
}

TEST(TrackRecording, OfNothingHasAHelloAlone) {
  const RecordedFile file([](recording::RecordingWriter&) {});
  std::string bytes;
  TrackRecording writer({}, [&](std::string_view more) { bytes += more; });
  writer.turn({}, {});
  writer.finish();
  std::ofstream(file.path(), std::ios::binary | std::ios::trunc) << bytes;
  EXPECT_TRUE(file.open().hello());
  EXPECT_FALSE(file.open().summary().damage);
}

}  // namespace
}  // namespace skerry::server
