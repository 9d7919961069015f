// The system's clock is set while an exercise is recorded: UTC follows, antennas and the recording
// go on.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

#include <atomic>
#include <map>
#include <sstream>
#include <thread>
#include <utility>

#include "protocol/recording/recording.pb.h"
#include "protocol/wire/radar.pb.h"
#include "server/app/exercise_files.hpp"
#include "server/app/options/charts.hpp"
#include "server/app/version.hpp"
#include "server/net/common/encoders.hpp"
#include "server/recorder/recorder.hpp"
#include "server/replay/comparison.hpp"
#include "server/replay/video_file.hpp"
#include "server/world/scenario.hpp"
#include "tests/unit/recorder/recorder_kit.hpp"
#include "tests/unit/replay/live_exercise.hpp"

namespace skerry::server {
namespace {

using recording::Event;
using recording::Kind;
using std::chrono::hours;
using std::chrono::seconds;

// A machine's clocks, of which one goes like the other until it is set.
class SetClock {
 public:
  void set_by(Duration by) { off_ns_ += by.count(); }
  ReadClocks read() const {
    return [this] {
      const auto now = std::chrono::steady_clock::now();
      return ClockReading{now, zero_.utc + (now - zero_.steady) + Duration(off_ns_.load())};
    };
  }

 private:
  const ClockReading zero_ = read_clocks();
  std::atomic<std::int64_t> off_ns_{0};
};

class ClockStep : public testing::Test {
 protected:
  ClockStep()
      : server_(parse_scenario(exercise_yaml(), "exercise.yaml"), open_charts({}, {}), 0,
                exercise_documents(exercise_yaml(), {})) {
    server_.set_clocks(clock_.read());
    for (std::uint32_t radar = 0; radar < server_.radar_count(); ++radar) {
      server_.find_channel(radar, 0)->add_format(kNativeFormat, native_encoder());
    }
  }

  UtcTime told() const {
    return UtcTime(Duration(static_cast<std::int64_t>(server_.own_ship(0).utc_ns())));
  }
  // Waits until what is told of own ship is of the clock as it is now, to a second.
  bool follows() const {
    return comes_true([&] { return std::chrono::abs(told() - clock_.read()().utc) < seconds(1); });
  }
  std::uint64_t spokes() const { return server_.status().radars(0).spokes(); }
  void go_on(std::uint64_t more = 200) {
    const std::uint64_t wanted = spokes() + more;
    ASSERT_TRUE(comes_true([&] { return spokes() >= wanted; }));
  }

  SetClock clock_;
  RadarServer server_;
  ScratchFolder folder_;
};

// The spokes of each radar have one sequence, one antenna's clock and the steps in their UTC.
void check_spokes(const recording::RecordingReader& reader, const std::vector<Duration>& steps) {
  std::map<std::uint32_t, std::vector<wire::Spoke>> radars;
  recording::ItemCursor cursor = reader.items();
  UtcTime last{};
  std::map<std::uint32_t, Duration> item_off;
  while (const auto item = cursor.next()) {
    EXPECT_GE(item->time, last);
    last = item->time;
    if (item->topic.kind != Kind::spoke) continue;
    wire::Spoke spoke;
    ASSERT_TRUE(spoke.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size())));
    const Duration off =
        item->time.time_since_epoch() - Duration(static_cast<std::int64_t>(spoke.scenario_ns()));
    EXPECT_EQ(item_off.try_emplace(item->topic.radar, off).first->second, off)
        << "the recording goes by the antenna's clock";
    radars[item->topic.radar].push_back(std::move(spoke));
  }
  EXPECT_LT(reader.summary().end - reader.summary().begin, std::chrono::minutes(5));
  for (const auto& [radar, spokes] : radars) {
    std::vector<Duration> found;
    for (std::size_t i = 1; i < spokes.size(); ++i) {
      const wire::Spoke &before = spokes[i - 1], &now = spokes[i];
      EXPECT_EQ(now.sequence(), before.sequence() + 1);
      const auto between = static_cast<std::int64_t>(now.scenario_ns() - before.scenario_ns());
      EXPECT_GT(between, 0);
      const auto utc_between = static_cast<std::int64_t>(now.utc_ns() - before.utc_ns());
      const Duration step(utc_between - between);
      if (step != Duration{}) found.push_back(step);
    }
    EXPECT_EQ(found, steps) << "radar " << radar;
  }
  EXPECT_EQ(radars.size(), 3u);
}

// The video is made again, and its file is as good as the first.
void check_verify(const recording::RecordingReader& reader, const std::string& video) {
  const auto exercise = RecordedExercise::read(reader);
  ASSERT_TRUE(exercise.ok()) << exercise.error().to_string();
  const ExercisePlan plan = exercise_plan(exercise->scenario_yaml, "scenario.yaml");
  const auto chart = open_charts({}, {});
  Comparison comparison(reader, *exercise);
  ExerciseReplay replay(*exercise, plan, *chart, 0);
  VideoFile file(video, reader, exercise->zero);
  replay.run(
      [&](const Sector& sector) {
        for (const SpokePtr& spoke : sector.spokes) {
          comparison.add(*spoke);
          file.add(*spoke);
        }
      },
      [](double) { return true; });
  file.finish();
  const ComparisonResult result = comparison.finish();
  EXPECT_TRUE(result.is_identical()) << result.first_difference;
  EXPECT_GT(result.compared, 1000u);
  EXPECT_LT(length_to_replay(reader, *exercise, {}, "--minutes"), std::chrono::minutes(5));
}

TEST_F(ClockStep, IsFollowedInEverythingButTheAntennasTime) {
  std::ostringstream log;
  const auto sink = std::make_shared<spdlog::sinks::ostream_sink_mt>(log);
  spdlog::default_logger()->sinks().push_back(sink);
  RecorderConfig config;
  config.folder = folder_.path();
  config.reserve_bytes = 0;
  config.sync = Sync::none;
  Recorder recorder(server_, config);
  server_.start();
  recorder.start();
  ASSERT_EQ(recorder.record(record_of(wire::Record::START, "a"), "test").code(), wire::Reply::OK);
  ASSERT_TRUE(reaches(recorder, wire::RecorderState::RECORDING));
  go_on();
  const std::vector<Duration> steps{hours(1), hours(-2)};
  for (const Duration by : steps) {
    clock_.set_by(by);
    EXPECT_TRUE(follows());
    go_on();
  }
  recorder.record(record_of(wire::Record::STOP), "test");
  ASSERT_TRUE(reaches(recorder, wire::RecorderState::OFF));
  // Another one, which begins an hour before the exercise did.
  ASSERT_EQ(recorder.record(record_of(wire::Record::START, "b"), "test").code(), wire::Reply::OK);
  ASSERT_TRUE(reaches(recorder, wire::RecorderState::RECORDING));
  go_on(1500);
  recorder.record(record_of(wire::Record::STOP), "test");
  ASSERT_TRUE(reaches(recorder, wire::RecorderState::OFF));
  recorder.stop();
  server_.stop();
  spdlog::default_logger()->sinks().pop_back();

  EXPECT_THAT(log.str(), testing::HasSubstr("the system's clock was set by +3600.000 s, from 20"));
  EXPECT_THAT(log.str(), testing::HasSubstr("the system's clock was set by -7200.000 s, from 20"));
  const Recorded file = recorded(folder_.path("a.mcap"));
  std::vector<std::string> marks;
  for (const Event& event : file.events(Event::MARK)) {
    if (event.mark_kind() == "clock") marks.push_back(event.text());
  }
  EXPECT_THAT(marks, testing::ElementsAre("the system's clock was set by +3600.000 s",
                                          "the system's clock was set by -7200.000 s"));
  const auto first = recording::RecordingReader::open(folder_.path("a.mcap"));
  ASSERT_TRUE(first.ok());
  check_spokes(*first, steps);
  check_verify(*first, folder_.path("a-again.mcap"));
  const auto again = recording::RecordingReader::open(folder_.path("a-again.mcap"));
  ASSERT_TRUE(again.ok());
  EXPECT_LT(again->summary().end - again->summary().begin, std::chrono::minutes(5));
  const auto second = recording::RecordingReader::open(folder_.path("b.mcap"));
  ASSERT_TRUE(second.ok());
  check_spokes(*second, {});
  EXPECT_LT(std::chrono::abs(second->summary().end - clock_.read()().utc), std::chrono::minutes(5));
  check_verify(*second, folder_.path("b-again.mcap"));
}

}  // namespace
}  // namespace skerry::server
