// Each console's own picture: a recording of every view of a running server, played again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "protocol/recording/recording.pb.h"
#include "protocol/wire/spoke_message.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using recording::Kind;
using recording::RecordingReader;
using testing::HasSubstr;

// A console with a view of its own of radar 0, at that range and gain once this returns.
class Trainee {
 public:
  Trainee(const RunningServer& server, double range_nm, double gain) : client_(connected(server)) {
    const auto view = client_.subscribe_new_view(0, 0, kAnswerTime);
    if (!view) throw std::runtime_error(view.error().text);
    number_ = *view;
    wire::Set set;
    set.set_view(number_);
    set.set_range_nm(range_nm);
    set.set_gain(gain);
    if (!client_.set(set, kAnswerTime)) throw std::runtime_error("cannot set its view");
    see_until([&](const Spoke& spoke) {
      return spoke.header.range_scale == *RangeScale::find(range_nm);
    });
  }
  std::uint32_t view() const { return number_; }
  // Spokes that come while it does not look may overtake it.
  void see_turns(std::uint32_t turns) {
    see_until([](const Spoke&) { return true; });
    const std::uint32_t last = seen_.rbegin()->second.header.scan + turns;
    see_until([&](const Spoke& spoke) { return spoke.header.scan >= last; });
  }
  // All it was shown, by sequence.
  const std::map<std::uint64_t, Spoke>& seen() const { return seen_; }

 private:
  void see_until(const std::function<bool(const Spoke&)>& last) {
    await<Spoke>(client_, [&](const Spoke& spoke) {
      seen_.insert_or_assign(spoke.header.sequence, spoke);
      return last(spoke);
    });
  }

  client::SpokeClient client_;
  std::uint32_t number_ = 0;
  std::map<std::uint64_t, Spoke> seen_;
};

// The spokes of a view of radar 0 in a file, in order; its settings stand before the first.
std::vector<Spoke> recorded_spokes(const RecordingReader& reader, std::uint32_t view) {
  std::vector<Spoke> spokes;
  bool settings_told = false;
  auto cursor = reader.items({{Kind::settings, 0, view}, {Kind::spoke, 0, view}});
  wire::Spoke message;
  while (const auto item = cursor.next()) {
    settings_told = settings_told || item->topic.kind == Kind::settings;
    if (item->topic.kind != Kind::spoke) continue;
    EXPECT_TRUE(settings_told);
    EXPECT_TRUE(message.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size())));
    auto spoke = from_message(message);
    EXPECT_TRUE(spoke.ok());
    if (spoke) spokes.push_back(std::move(spoke).value());
  }
  return spokes;
}

std::string bytes_of(const Spoke& spoke) {
  wire::Spoke message;
  to_message(spoke, message);
  return message.SerializeAsString();
}

// Spokes of a view that were overwritten before they were taken, on a busy machine.
std::uint64_t told_lost(const RecordingReader& reader, std::uint32_t view) {
  std::uint64_t lost = 0;
  auto cursor = reader.items({{Kind::event, 0, 0}});
  recording::Event event;
  while (const auto item = cursor.next()) {
    EXPECT_TRUE(event.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size())));
    const bool of_view = event.radar() == 0 && event.view() == view;
    if (of_view && event.kind() == recording::Event::LOST) lost += event.count();
  }
  return lost;
}

// The recording has no untold gap, and is what the trainee was shown, bit for bit.
void expect_seen(const std::vector<Spoke>& recorded, std::uint64_t lost,
                 const std::map<std::uint64_t, Spoke>& seen) {
  ASSERT_FALSE(recorded.empty());
  // Those lost before the first or behind the last leave no gap.
  const std::uint64_t span = recorded.back().header.sequence - recorded.front().header.sequence + 1;
  EXPECT_GE(span, recorded.size());
  EXPECT_LE(span, recorded.size() + lost);
  std::size_t both = 0;
  for (const Spoke& spoke : recorded) {
    const auto found = seen.find(spoke.header.sequence);
    if (found == seen.end()) continue;
    ASSERT_EQ(bytes_of(spoke), bytes_of(found->second)) << spoke.header.sequence;
    ++both;
  }
  EXPECT_GT(both, 0u);
}

// A console at a playback gets each of them, and the settings that held at the end.
void expect_played(client::SpokeClient& console, const std::vector<Spoke>& recorded,
                   std::uint64_t lost, double gain) {
  std::map<UtcTime, const Spoke*> wanted;
  for (const Spoke& spoke : recorded) wanted[spoke.header.utc] = &spoke;
  ASSERT_EQ(wanted.size(), recorded.size());
  std::uint64_t received = 0;
  double told_gain = -1.0;
  while (received + console.losses().lost() < recorded.size() + lost || told_gain != gain) {
    const client::ClientEvent event = next_event(console);
    if (const auto* settings = std::get_if<wire::Settings>(&event)) told_gain = settings->gain();
    const auto* spoke = std::get_if<Spoke>(&event);
    if (spoke == nullptr) continue;
    ++received;
    const auto found = wanted.find(spoke->header.utc);
    ASSERT_NE(found, wanted.end());
    const Spoke& as_recorded = *found->second;
    ASSERT_EQ(spoke->header.view, as_recorded.header.view);
    ASSERT_EQ(spoke->header.index, as_recorded.header.index);
    ASSERT_EQ(spoke->header.range_scale, as_recorded.header.range_scale);
    ASSERT_EQ(spoke->cells, as_recorded.cells);
    wanted.erase(found);
  }
}

Ending recording_tool(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), {skerry_program(), "recording"});
  return run(std::move(arguments));
}

client::SpokeClient console_of(const RunningServer& server, std::uint32_t view) {
  client::SpokeClient console = connected(server);
  if (const auto done = console.subscribe(0, view, kAnswerTime); !done) {
    throw std::runtime_error(done.error().text);
  }
  return console;
}

class RecordedExam : public testing::Test {
 protected:
  // One trainee from before its begin to its end, one who comes and goes.
  RecordedExam() {
    RunningServer server({"--scenario", folder_.write("small.yaml", small_scenario()),
                          "--record-folder", folder_.path("rec"), "--record-reserve-mib", "0"});
    const auto record = [&](std::vector<std::string> arguments) {
      arguments.insert(arguments.begin(), {skerry_program(), "record"});
      arguments.insert(arguments.end(), {"--port", std::to_string(server.tcp_port())});
      return run(std::move(arguments));
    };
    EXPECT_NE(record({"start", "--all-views", "--inputs-only"}).code, 0);
    EXPECT_THAT(record({"start", "--all-views", "--radar", "9"}).err, HasSubstr("no radar 9"));
    Trainee stays(server, 3.0, 85.0);
    const Ending started = record({"start", "exam", "--all-views"});
    EXPECT_EQ(started.code, 0) << started.err;
    std::optional<Trainee> goes(std::in_place, server, 1.5, 30.0);
    goes->see_turns(3);
    stays.see_turns(3);
    goes_ = goes->view();
    seen_[goes_] = goes->seen();
    goes.reset();
    client::SpokeClient observer = connected(server);
    await_status(observer, [](const wire::Status& s) { return s.radars(0).views_size() == 1; });
    client::SpokeClient newcomer = subscribed(server, 0);
    next_scan(newcomer);  // recorded without the view that has gone
    stays.see_turns(1);
    stays_ = stays.view();
    seen_[stays_] = stays.seen();
    const Ending stopped = record({"stop"});
    EXPECT_EQ(stopped.code, 0) << stopped.err;
  }
  RecordingReader reader() const {
    auto reader = RecordingReader::open(file_);
    if (!reader) throw std::runtime_error(reader.error().to_string());
    return std::move(reader).value();
  }

  TempFolder folder_;
  const std::string file_ = folder_.path("rec/exam.mcap");
  std::uint32_t stays_ = 0, goes_ = 0;
  std::map<std::uint32_t, std::map<std::uint64_t, Spoke>> seen_;  // by view
};

TEST_F(RecordedExam, HasWhatEachTraineeSawAndPlaysIt) {
  const RecordingReader exam = reader();
  EXPECT_FALSE(exam.summary().damage.has_value());
  const std::vector<Spoke> staying = recorded_spokes(exam, stays_);
  const std::vector<Spoke> going = recorded_spokes(exam, goes_);
  const std::uint64_t staying_lost = told_lost(exam, stays_), going_lost = told_lost(exam, goes_);
  expect_seen(staying, staying_lost, seen_[stays_]);
  expect_seen(going, going_lost, seen_[goes_]);
  EXPECT_GT(staying.size(), going.size());
  EXPECT_GT(going.front().header.utc, staying.front().header.utc);
  EXPECT_LT(going.back().header.utc, staying.back().header.utc);
  EXPECT_FALSE(recorded_spokes(exam, 0).empty());

  RunningServer server({"--play", file_, "--play-paused"});
  client::SpokeClient of_staying = console_of(server, stays_), of_going = console_of(server, goes_);
  wire::Playback fast;
  fast.set_playing(true);
  fast.set_rate(4.0);
  ASSERT_TRUE(of_staying.playback(fast, kAnswerTime));
  std::jthread other([&] {
    try {
      expect_played(of_staying, staying, staying_lost, 85.0);
    } catch (const std::exception& error) {
      ADD_FAILURE() << error.what();
    }
  });
  expect_played(of_going, going, going_lost, 30.0);
}

TEST_F(RecordedExam, ItsViewsAreForTheToolsToo) {
  const std::string number = std::to_string(goes_);
  const Ending info = recording_tool({"info", file_, "--check"});
  EXPECT_EQ(info.code, 0) << info.err;
  for (const std::uint32_t view : {stays_, goes_}) {
    EXPECT_THAT(info.out, HasSubstr("spokes of radar 0 view " + std::to_string(view) + "\n"));
  }
  const Ending table = recording_tool({"export", file_, "--csv", "--view", number});
  EXPECT_EQ(table.code, 0) << table.err;
  const auto lines = static_cast<std::size_t>(std::count(table.out.begin(), table.out.end(), '\n'));
  const RecordingReader exam = reader();
  EXPECT_EQ(lines, recorded_spokes(exam, goes_).size() + 1);

  const std::string part = folder_.path("part.mcap");
  const Ending cut = recording_tool({"cut", file_, "--from", "0:02", "-o", part});
  ASSERT_EQ(cut.code, 0) << cut.err;
  const auto rest = RecordingReader::open(part);
  ASSERT_TRUE(rest.ok());
  const std::vector<Spoke> all = recorded_spokes(exam, goes_), kept = recorded_spokes(*rest, goes_);
  ASSERT_FALSE(kept.empty());
  ASSERT_LE(kept.size(), all.size());
  for (std::size_t i = 1; i <= kept.size(); ++i) {
    ASSERT_EQ(bytes_of(kept[kept.size() - i]), bytes_of(all[all.size() - i]));
  }

  const Ending verified = recording_tool({"verify", file_});
  EXPECT_EQ(verified.code, 0) << verified.out << verified.err;
  EXPECT_THAT(verified.out, HasSubstr("compared byte by byte, 0"));
}

}  // namespace
}  // namespace skerry::system_test
