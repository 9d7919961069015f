#include "clients/recording/recording_edit.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>

#include "clients/recording/recorded_turns.hpp"
#include "clients/recording/recording_info.hpp"
#include "tests/unit/recording_client/recording_maker.hpp"

namespace skerry::client {
namespace {

using recording::Kind;
using std::chrono::milliseconds;
using std::chrono::seconds;

class Editing : public testing::Test {
 protected:
  ~Editing() override {
    for (const std::string& path : paths_) std::filesystem::remove(path);
  }
  std::string path(const std::string& name) {
    paths_.push_back(test_path(name));
    return paths_.back();
  }
  template <typename Edit>
  EditReport edited(const std::string& to, const Edit& edit) {
    RecordingOutput output(to, true);
    recording::RecordingWriter writer(output.sink(), {});
    auto done = edit(writer);
    EXPECT_TRUE(done.ok()) << (done.ok() ? "" : done.error().to_string());
    writer.finish();
    output.commit();
    return done ? *done : EditReport{};
  }
  EditReport cut(const std::string& from_file, const std::string& to_file, Duration from,
                 Duration to) {
    const auto source = opened(from_file);
    return edited(to_file, [&](recording::RecordingWriter& writer) {
      return cut_recording(source, source.summary().begin + from, source.summary().begin + to,
                           writer);
    });
  }
  EditReport join(const std::vector<std::string>& files, const std::string& to) {
    std::vector<recording::RecordingReader> sources;
    for (const std::string& file : files) sources.push_back(opened(file));
    return edited(
        to, [&](recording::RecordingWriter& writer) { return join_recordings(sources, writer); });
  }

 private:
  std::vector<std::string> paths_;
};

TEST_F(Editing, APartHasItsSpokesByteByByteAndWhatWasInForce) {
  const std::string whole = path("whole.mcap"), part = path("part.mcap");
  RecordingMaker maker(whole, kBegin);
  maker.add_hello({{0, "bow"}});
  maker.add_gain({}, 0, 10.0);
  maker.add_gain(seconds(3), 0, 30.0);
  maker.add_gain(seconds(7), 0, 70.0);
  maker.add_input({}, 1, 0);
  maker.add_input(seconds(1), 1, 1);
  maker.add_input(seconds(6), 1, 2);
  maker.add_mark(seconds(6), "contact");
  maker.add_spokes(0);
  maker.writer().attach({"scenario.yaml", "application/yaml", kBegin, "name: test"});
  maker.finish();

  const EditReport report = cut(whole, part, seconds(5), seconds(8));
  EXPECT_EQ(report.spokes, 300u);
  const auto source = opened(whole), got = opened(part);
  auto wanted = items_of(source, Kind::spoke);
  wanted.erase(wanted.begin() + 800, wanted.end());
  wanted.erase(wanted.begin(), wanted.begin() + 500);
  EXPECT_EQ(items_of(got, Kind::spoke), wanted);
  EXPECT_EQ(got.hello()->radars(0).name(), "bow");
  EXPECT_EQ(got.summary().begin, kBegin + seconds(5));
  EXPECT_EQ(got.summary().attachments.at(0).bytes, "name: test");
  EXPECT_EQ(got.summary().marks.at(0).name, "contact");
  const auto gains = items_of(got, Kind::settings);
  ASSERT_EQ(gains.size(), 2u);
  EXPECT_EQ(parsed<wire::Settings>(gains[0]).gain(), 30.0);
  EXPECT_EQ(gains[0].time, kBegin + seconds(5));
  EXPECT_EQ(parsed<wire::Settings>(gains[1]).gain(), 70.0);
  EXPECT_EQ(items_of(got, Kind::input).size(), 3u);
}

TEST_F(Editing, ThePartsOfARecordingJoinedAreTheRecordingAgain) {
  const std::string whole = path("whole.mcap"), a = path("a.mcap"), b = path("b.mcap"),
                    both = path("both.mcap");
  RecordingMaker maker(whole, kBegin);
  maker.add_hello({{0, "bow"}, {1, "stern"}});
  maker.add_input({}, 1, 0);
  maker.add_input(seconds(1), 1, 1);
  maker.add_input(seconds(6), 1, 2);
  maker.add_spokes(0);
  maker.add_spokes(1);
  maker.finish();
  cut(whole, a, {}, seconds(5));
  cut(whole, b, seconds(5), seconds(100));
  EXPECT_TRUE(join({b, a}, both).notes.empty() == false);  // b comes first: a does not follow it
  const EditReport report = join({a, b}, both);
  EXPECT_TRUE(report.notes.empty());
  const auto source = opened(whole), got = opened(both);
  EXPECT_EQ(items_of(got, Kind::spoke), items_of(source, Kind::spoke));
  EXPECT_EQ(items_of(got, Kind::input).size(), 3u);
  EXPECT_EQ(items_of(got, Kind::hello).size(), 1u);
  EXPECT_EQ(got.hello()->radars_size(), 2);
}

TEST_F(Editing, RadarsOfRecordingsAtTheSameTimeGetNumbersOfTheirOwn) {
  const std::string a = path("a.mcap"), b = path("b.mcap"), both = path("both.mcap");
  RecordingMaker first(a, kBegin);
  first.add_hello({{0, "bow"}, {4, "mast"}});
  first.add_gain({}, 0, 10.0);
  first.add_input({}, 1, 0);
  first.add_spokes(0, 300);
  first.finish();
  RecordingMaker second(b, kBegin + seconds(1));
  second.add_hello({{0, "tower"}, {5, "pier"}});
  second.add_gain({}, 0, 20.0);
  second.add_gain({}, 5, 50.0);
  second.add_input({}, 2, 0);
  recording::Event lost;
  lost.set_kind(recording::Event::LOST);
  lost.set_count(3);
  second.add({Kind::event, 0, 0}, seconds(1), lost);
  second.add_spokes(0, 300);
  second.finish();

  const EditReport report = join({a, b}, both);
  ASSERT_EQ(report.notes.size(), 3u);  // and that inputs were left out
  EXPECT_EQ(report.notes[0], "radar 0 of " + b + " is radar 5 now");
  const auto got = opened(both);
  // The tower's 0 became 5, and the pier's 5 the next.
  ASSERT_EQ(got.hello()->radars_size(), 4);
  EXPECT_EQ(got.hello()->radars(2).name(), "tower");
  EXPECT_EQ(got.hello()->radars(2).radar(), 5u);
  EXPECT_EQ(got.hello()->radars(3).radar(), 6u);
  std::map<std::uint32_t, std::size_t> spokes;
  UtcTime last = UtcTime::min();
  for (const TimedBytes& item : items_of(got, Kind::spoke)) {
    const auto spoke = parsed<wire::Spoke>(item);
    EXPECT_EQ(spoke.radar(), item.topic.radar);
    EXPECT_GE(item.time, last);
    last = item.time;
    ++spokes[spoke.radar()];
  }
  EXPECT_EQ(spokes, (std::map<std::uint32_t, std::size_t>{{0, 300}, {5, 300}}));
  std::map<std::uint32_t, double> gains;
  for (const TimedBytes& item : items_of(got, Kind::settings)) {
    const auto settings = parsed<wire::Settings>(item);
    EXPECT_EQ(settings.radar(), item.topic.radar);
    gains[settings.radar()] = settings.gain();
  }
  EXPECT_EQ(gains, (std::map<std::uint32_t, double>{{0, 10.0}, {5, 20.0}, {6, 50.0}}));
  EXPECT_EQ(parsed<recording::Event>(items_of(got, Kind::event).at(0)).radar(), 5u);
  // The other exercise's inputs would make nothing of this one.
  EXPECT_EQ(items_of(got, Kind::input).size(), 1u);
}

TEST_F(Editing, SaysWhenThereIsNothingAndGivesUpWhenAsked) {
  const std::string whole = path("whole.mcap");
  RecordingMaker maker(whole, kBegin);
  maker.add_spokes(0);
  maker.finish();
  const auto source = opened(whole);
  recording::RecordingWriter writer([](std::span<const std::uint8_t>) { return true; }, {});
  const auto none = cut_recording(source, kBegin + seconds(50), kBegin + seconds(60), writer);
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().text, "there is nothing from 0:50.000 to 1:00.000; it ends at 0:12.790");
  const auto given_up =
      cut_recording(source, kBegin, kBegin + seconds(60), writer, [](double) { return false; });
  ASSERT_FALSE(given_up.ok());
  EXPECT_EQ(given_up.error().text, "given up");
}

TEST_F(Editing, ARecordingIsWholeOrNotThereAndReplacesNothingUnasked) {
  const std::string file = path("out.mcap");
  const auto parts = [&] {
    std::size_t count = 0;
    for (const auto& each : std::filesystem::directory_iterator(testing::TempDir())) {
      count += each.path().string().starts_with(file + ".part-");
    }
    return count;
  };
  {
    RecordingOutput output(file, false);
    const std::uint8_t byte = 1;
    EXPECT_TRUE(output.sink()(std::span(&byte, 1)));
    EXPECT_EQ(parts(), 1u);
  }
  EXPECT_EQ(parts(), 0u);
  EXPECT_FALSE(std::filesystem::exists(file));
  RecordingOutput early(file, false);
  std::ofstream(file) << "mine";
  EXPECT_THROW(RecordingOutput(file, false), std::runtime_error);
  // It came to be there meanwhile: what was written stays beside it.
  std::string left;
  try {
    early.commit();
    ADD_FAILURE();
  } catch (const std::runtime_error& error) {
    const std::string text = error.what();
    left = text.substr(std::min(text.size(), text.rfind(file + ".part-")));
  }
  EXPECT_EQ(std::filesystem::file_size(file), 4u);
  EXPECT_EQ(parts(), 1u);
  EXPECT_TRUE(std::filesystem::remove(left)) << left;
  RecordingOutput forced(file, true);
  forced.commit();
  EXPECT_EQ(std::filesystem::file_size(file), 0u);
  EXPECT_EQ(parts(), 0u);
  EXPECT_THROW(RecordingOutput(testing::TempDir(), true), std::runtime_error);
  EXPECT_THROW(RecordingOutput("/nowhere/out.mcap", true), std::runtime_error);
}

TEST_F(Editing, TurnsComeWithTheLabelsOfTheirTime) {
  const std::string whole = path("whole.mcap");
  RecordingMaker maker(whole, kBegin);
  maker.add_hello({{0, "bow"}});
  maker.add_gain({}, 0, 10.0);
  maker.add_gain(seconds(3), 0, 30.0);
  maker.add_spokes(0, 1290);
  maker.finish();
  const auto reader = opened(whole);
  RecordedTurns all(reader, {});
  std::vector<RecordedTurn> turns;
  while (auto turn = all.next()) turns.push_back(std::move(*turn));
  ASSERT_EQ(turns.size(), 11u);
  EXPECT_EQ(turns[0].scan.received, 128u);
  EXPECT_EQ(turns[0].labels.radar, "bow");
  EXPECT_EQ(turns[0].labels.settings->gain(), 10.0);
  EXPECT_EQ(turns[2].labels.settings->gain(), 30.0);
  EXPECT_EQ(turns[10].scan.received, 10u);  // begun, no more
  EXPECT_EQ(turns[10].number, 11u);

  RecordedTurns part(reader, {0, 0, kBegin + milliseconds(6400), kBegin + milliseconds(7680)});
  const auto turn = part.next();
  ASSERT_TRUE(turn.has_value());
  EXPECT_EQ(turn->number, 1u);
  EXPECT_EQ(turn->scan.number, 5u);
  EXPECT_EQ(turn->labels.settings->gain(), 30.0);
  EXPECT_FALSE(part.next().has_value());

  std::uint64_t lines = 0;
  EXPECT_EQ(each_spoke(reader, {}, [&](const Spoke&) { ++lines; })->spokes, 1290u);
  EXPECT_EQ(lines, 1290u);
  const auto none = each_spoke(reader, {7, 0, {}, {}}, [](const Spoke&) {});
  ASSERT_FALSE(none.ok());
  EXPECT_EQ(none.error().text, "it has no spokes of radar 7 view 0; there are radar 0 view 0");
}

TEST_F(Editing, WhatIsNoSpokeIsPassedOverAndCounted) {
  const std::string file = path("nonsense.mcap");
  RecordingMaker maker(file, kBegin);
  maker.add_hello({{0, "bow"}});
  maker.add_spokes(0, 3);
  // A spoke of no cells, and one of another radar.
  maker.add({Kind::spoke, 0, 0}, seconds(1), wire::Spoke{});
  maker.add({Kind::spoke, 1, 0}, seconds(1), wire::Spoke{});
  maker.finish();
  const auto reader = opened(file);
  const auto read = each_spoke(reader, {}, [](const Spoke&) {});
  EXPECT_EQ(read->spokes, 3u);
  EXPECT_EQ(read->not_read.text(), "1 spoke could not be read whole");
  RecordedTurns turns(reader, {});
  EXPECT_EQ(turns.next()->scan.received, 3u);
  EXPECT_EQ(turns.not_read().spokes, 1u);
  EXPECT_EQ(turns.not_read().chunks, 0u);
  const auto none = each_spoke(reader, {1, 0, {}, {}}, [](const Spoke&) {});
  EXPECT_EQ(none.error().text,
            "there are no spokes of radar 1 view 0 in that part; 1 spoke could not be read whole");
  EXPECT_EQ((NotRead{2, 3}).text(), "2 spokes and 3 chunks could not be read whole");
}

TEST_F(Editing, InfoTellsWhatIsThereAndWhatIsDamaged) {
  const std::string whole = path("whole.mcap");
  RecordingMaker maker(whole, kBegin);
  maker.add_hello({{0, "bow\x1b"}});
  maker.add_mark(seconds(6), "contact");
  maker.add_spokes(0);
  maker.finish();
  {
    const auto reader = opened(whole);
    const auto check = check_recording(reader);
    ASSERT_TRUE(check.ok());
    EXPECT_EQ(check->items, 1282u);
    const std::string text = info_text(reader, *check);
    for (const char* told :
         {"bow?, 128 spokes of 256 cells of 8 bits", "1280 spokes of radar 0 view 0",
          "0:06.000 contact", "0:12.790 long", "checked: all 1282 items can be read"}) {
      EXPECT_NE(text.find(told), std::string::npos) << told << " in\n" << text;
    }
    const std::string json = info_json(reader, *check);
    for (const char* told : {"\"length_s\": 12.79", "\"name\": \"contact\"", "\"damage\": null",
                             "\"position_s\": 6.0", "\"begin_ns\": 1714564800000000000"}) {
      EXPECT_NE(json.find(told), std::string::npos) << told << " in\n" << json;
    }
  }
  std::filesystem::resize_file(whole, std::filesystem::file_size(whole) - 100);
  const auto cut_short = opened(whole);
  EXPECT_NE(info_text(cut_short, {}).find("damaged: " + whole + ": byte"), std::string::npos);
  EXPECT_EQ(info_json(cut_short, {}).find("\"damage\": null"), std::string::npos);
}

}  // namespace
}  // namespace skerry::client
