#include "server/recorder/recorder.hpp"

#include <google/protobuf/unknown_field_set.h>
#include <gtest/gtest.h>

#include <fstream>

#include "protocol/recording/inputs.pb.h"
#include "tests/unit/recorder/recorder_kit.hpp"

namespace skerry::server {
namespace {

using recording::Event;
using recording::Kind;
using State = wire::RecorderState;

class Recording : public testing::Test {
 protected:
  Recording() {
    config_.folder = folder_.path();
    config_.reserve_bytes = 0;
    config_.sync = Sync::none;
  }
  Recorder& recorder() {
    if (!recorder_) {
      recorder_ = std::make_unique<Recorder>(host_, config_);
      recorder_->start();
    }
    return *recorder_;
  }
  wire::Reply ask(wire::Record::Action action, const std::string& name = {}) {
    return recorder().record(record_of(action, name), "console 192.0.2.7:1");
  }
  // Spokes are later than the recorder's start, however long a loaded machine takes to start it.
  void set_clock_ahead() {
    host_.begin_utc = std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now()) +
                      std::chrono::seconds(5);
  }
  void begin(const std::string& name = "a") {
    set_clock_ahead();
    before_ = host_.published(0) + host_.published(1);
    ASSERT_EQ(ask(wire::Record::START, name).code(), wire::Reply::OK);
    ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  }
  void end() {
    ASSERT_EQ(ask(wire::Record::STOP).code(), wire::Reply::OK);
    ASSERT_TRUE(reaches(recorder(), State::OFF)) << recorder().state().ShortDebugString();
  }
  void publish(int sectors, std::uint32_t radar = 0) {
    for (int i = 0; i < sectors; ++i) {
      host_.publish(radar);
      // Publishes like a radar, not faster than the ring is read.
      if (i % 16 != 15) continue;
      EXPECT_TRUE(comes_true([&] { return taken() + 512 > given(); }));
    }
  }
  std::uint64_t taken() {
    const wire::RecorderState state = recorder().state();
    return state.spokes() + state.spokes_lost();
  }
  std::uint64_t given() const { return host_.published(0) + host_.published(1) - before_; }

  ScratchFolder folder_;
  RecordedHost host_{2};
  RecorderConfig config_;
  std::unique_ptr<Recorder> recorder_;
  std::uint64_t before_ = 0;  // published before the recording
};

TEST_F(Recording, HasEverySpokeOfEveryRadarByteForByte) {
  using recording::Compression;
  int number = 0;
  for (const auto& [compression, compact] :
       {std::pair(Compression::none, false), std::pair(Compression::lz4, false),
        std::pair(Compression::zstd, false), std::pair(Compression::zstd, true)}) {
    recorder_.reset();
    config_.compression = compression;
    config_.compact = compact;
    const std::string name = "with " + std::to_string(++number);
    const std::uint64_t first = host_.published(0), other_first = host_.published(1);
    begin(name);
    publish(100);
    publish(3, 1);
    end();
    EXPECT_EQ(recorder().state().spokes(), 1600u + 48u);
    EXPECT_EQ(recorder().state().spokes_lost(), 0u);
    const Recorded file = recorded(folder_.path(name + ".mcap"));
    EXPECT_TRUE(file.is_whole);
    const auto spokes = file.of(Kind::spoke, 0), others = file.of(Kind::spoke, 1);
    ASSERT_EQ(spokes.size(), 1600u);
    ASSERT_EQ(others.size(), 48u);
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      ASSERT_EQ(spokes[i], host_.spoke_bytes(0, first + i));
    }
    for (std::size_t i = 0; i < others.size(); ++i) {
      ASSERT_EQ(others[i], host_.spoke_bytes(1, other_first + i));
    }
  }
}

TEST_F(Recording, TellsTheDisksFreeSpaceBeforeItBegins) {
  EXPECT_TRUE(comes_true([&] { return recorder().state().free_bytes() > 0; }));
  EXPECT_EQ(recorder().state().phase(), State::OFF);
}

TEST_F(Recording, BeginsWithAllThatIsInForceAndHasWhatChanges) {
  TrafficItem ship;
  ship.name = "Skerryvore";
  host_.traffic_items.push_back(ship);
  host_.change_world(3.0);
  begin();
  publish(1);
  host_.change_world(4.5);
  wire::Set set;
  set.set_gain(61);
  host_.apply(set, "");
  publish(1);
  ASSERT_TRUE(comes_true([&] { return taken() == given(); }));
  end();
  const Recorded file = recorded(folder_.path("a.mcap"));
  ASSERT_FALSE(file.items.empty());
  EXPECT_EQ(file.items.front().topic.kind, Kind::hello);
  const auto worlds = file.of(Kind::world);
  ASSERT_EQ(worlds.size(), 2u);
  wire::World world;
  ASSERT_TRUE(world.ParseFromString(worlds[0]));
  EXPECT_EQ(world.sea_state(), 3.0);
  ASSERT_TRUE(world.ParseFromString(worlds[1]));
  EXPECT_EQ(world.sea_state(), 4.5);
  const auto settings = file.of(Kind::settings, 0);
  ASSERT_EQ(settings.size(), 2u);
  wire::Settings changed;
  ASSERT_TRUE(changed.ParseFromString(settings.back()));
  EXPECT_EQ(changed.gain(), 61.0);
  EXPECT_GE(file.of(Kind::own_ship, 1).size(), 1u);
  recording::Traffic traffic;
  ASSERT_TRUE(traffic.ParseFromString(file.of(Kind::traffic).at(0)));
  EXPECT_EQ(traffic.items(0).name(), "Skerryvore");
  EXPECT_EQ(file.events(Event::STARTED).size(), 1u);
  EXPECT_EQ(file.events(Event::STARTED).at(0).text(), "by console 192.0.2.7:1: radars 0, 1");
  EXPECT_EQ(file.events(Event::STOPPED).size(), 1u);
}

TEST_F(Recording, OfOneRadarHasThatAlone) {
  wire::Record record = record_of(wire::Record::START, "one");
  record.add_radars(1);
  record.add_radars(1);
  set_clock_ahead();
  ASSERT_EQ(recorder().record(record, "test").code(), wire::Reply::OK);
  ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  host_.publish(0);
  host_.publish(1);
  ASSERT_TRUE(comes_true([&] { return taken() == 16; }));
  end();
  const Recorded file = recorded(folder_.path("one.mcap"));
  EXPECT_TRUE(file.of(Kind::spoke, 0).empty());
  EXPECT_EQ(file.of(Kind::spoke, 1).size(), 16u);
  wire::Hello hello;
  ASSERT_TRUE(hello.ParseFromString(file.items.front().bytes));
  ASSERT_EQ(hello.radars_size(), 1);
  EXPECT_EQ(hello.radars(0).radar(), 1u);
}

TEST_F(Recording, HasMarksLinesOfTheLogAndControls) {
  recorder().log(2, "before: not recorded");
  begin();
  EXPECT_EQ(ask(wire::Record::MARK, "collision!").code(), wire::Reply::OK);
  EXPECT_EQ(ask(wire::Record::MARK).code(), wire::Reply::OK);
  recorder().log(3, "a line");
  recorder().control_changed("radar 0 gain 50 -> 60");
  ASSERT_TRUE(comes_true([&] { return recorder().state().marks() == 2; }));
  end();
  const Recorded file = recorded(folder_.path("a.mcap"));
  const auto marks = file.events(Event::MARK);
  ASSERT_EQ(marks.size(), 2u);
  EXPECT_EQ(marks[0].text(), "collision!");
  EXPECT_EQ(marks[1].text(), "mark 2");
  EXPECT_EQ(file.events(Event::CONTROL).at(0).text(), "radar 0 gain 50 -> 60");
  const auto lines = file.of(Kind::log);
  ASSERT_EQ(lines.size(), 1u);
  recording::Log line;
  ASSERT_TRUE(line.ParseFromString(lines[0]));
  EXPECT_EQ(line.text(), "a line");
  EXPECT_EQ(line.level(), 3u);
}

AuditEntryPtr entry_of(std::uint32_t n) {
  auto entry = std::make_shared<recording::AuditEntry>();
  entry->set_n(n);
  entry->set_who("Anna, trainee");
  entry->set_what("radar 0 view 0: gain");
  return entry;
}

// From the order to start on, which may be told before the recorder has begun.
TEST_F(Recording, HasTheEntriesOfTheAuditSinceItWasStarted) {
  recorder().audit(entry_of(6));
  set_clock_ahead();
  ASSERT_EQ(ask(wire::Record::START, "a").code(), wire::Reply::OK);
  recorder().audit(entry_of(7));
  ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  recorder().audit(entry_of(8));
  end();
  recorder().audit(entry_of(9));
  const auto entries = recorded(folder_.path("a.mcap")).of(Kind::audit);
  ASSERT_EQ(entries.size(), 2u);
  for (std::uint32_t i = 0; i < 2; ++i) {
    recording::AuditEntry entry;
    ASSERT_TRUE(entry.ParseFromString(entries[i]));
    EXPECT_EQ(entry.n(), 7 + i);
    EXPECT_EQ(entry.who(), "Anna, trainee");
  }
}

TEST_F(Recording, RefusesWhatCannotBe) {
  EXPECT_EQ(ask(wire::Record::STOP).code(), wire::Reply::REFUSED);
  EXPECT_EQ(ask(wire::Record::MARK).code(), wire::Reply::REFUSED);
  EXPECT_EQ(ask(wire::Record::START, "../a").code(), wire::Reply::OUT_OF_RANGE);
  wire::Record record = record_of(wire::Record::START);
  record.add_radars(2);
  EXPECT_EQ(recorder().record(record, "").code(), wire::Reply::UNKNOWN);
  record = record_of(wire::Record::START);
  record.set_inputs_only(true);
  EXPECT_EQ(recorder().record(record, "").code(), wire::Reply::REFUSED);
  record.set_action(static_cast<wire::Record::Action>(7));
  EXPECT_EQ(recorder().record(record, "").code(), wire::Reply::OUT_OF_RANGE);
  record = record_of(wire::Record::START);
  record.GetReflection()->MutableUnknownFields(&record)->AddVarint(99, 1);
  EXPECT_EQ(recorder().record(record, "").code(), wire::Reply::UNKNOWN);
  EXPECT_TRUE(folder_.recordings().empty());
  begin();
  EXPECT_EQ(ask(wire::Record::START, "b").code(), wire::Reply::REFUSED);
  EXPECT_EQ(ask(wire::Record::MARK, "a\nb").code(), wire::Reply::OUT_OF_RANGE);
  end();
  EXPECT_EQ(ask(wire::Record::STOP).code(), wire::Reply::REFUSED);
}

TEST_F(Recording, AFileThatIsThereIsLeftAloneAndTheNextNameWorks) {
  std::ofstream(folder_.path("a.mcap")) << "mine";
  ASSERT_EQ(ask(wire::Record::START, "a").code(), wire::Reply::OK);
  ASSERT_TRUE(reaches(recorder(), State::FAILED));
  EXPECT_NE(recorder().state().problem().find("is there already"), std::string::npos);
  EXPECT_EQ(std::filesystem::file_size(folder_.path("a.mcap")), 4u);
  ASSERT_TRUE(comes_true([&] { return ask(wire::Record::START, "b").code() == wire::Reply::OK; }));
  ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  publish(2);
  end();
  EXPECT_TRUE(recorded(folder_.path("b.mcap")).is_whole);
}

TEST_F(Recording, RollsFilesThatEachStandAlone) {
  config_.roll_bytes = 200'000;
  config_.compression = recording::Compression::none;
  host_.has_exercise = true;
  host_.inputs.add("first");
  begin();
  for (int files = 1; files <= 3; ++files) {
    publish(16);
    ASSERT_TRUE(
        comes_true([&] { return folder_.recordings().size() > static_cast<std::size_t>(files); }));
  }
  host_.inputs.add("second");
  publish(1);
  end();
  std::uint64_t spokes = 0;
  const auto names = folder_.recordings();
  ASSERT_GE(names.size(), 4u);
  for (const std::string name : {"a.mcap", "a-002.mcap", "a-003.mcap", "a-004.mcap"}) {
    const Recorded file = recorded(folder_.path(name));
    EXPECT_TRUE(file.is_whole) << name;
    EXPECT_EQ(file.items.front().topic.kind, Kind::hello) << name;
    EXPECT_FALSE(file.of(Kind::settings, 0).empty()) << name;
    EXPECT_FALSE(file.of(Kind::world).empty()) << name;
    ASSERT_FALSE(file.attachments.empty()) << name;
    EXPECT_EQ(file.attachments[0].name, "scenario.yaml");
    EXPECT_EQ(file.of(Kind::input).at(0), "first") << name;
    for (const std::string& bytes : file.of(Kind::spoke, 0)) {
      ASSERT_EQ(bytes, host_.spoke_bytes(0, spokes++));
    }
  }
  EXPECT_EQ(spokes, given());
}

TEST_F(Recording, GoesOnInAnotherFileWhereItsOwnWasTakenAway) {
  begin();
  publish(8);
  ASSERT_TRUE(comes_true([&] { return recorder().state().file_bytes() > 100'000; }));
  std::filesystem::rename(folder_.path("a.mcap"), folder_.path("away.mcap"));
  // Chunks end by the clock.
  ASSERT_TRUE(comes_true([&] {
    host_.publish();
    return recorder().state().file() == "a-002.mcap";
  }));
  EXPECT_NE(recorder().state().problem().find("a.mcap: was removed"), std::string::npos);
  publish(8);
  end();
  EXPECT_EQ(recorded(folder_.path("away.mcap")).of(Kind::spoke).size() +
                recorded(folder_.path("a-002.mcap")).of(Kind::spoke).size(),
            recorder().state().spokes());
}

TEST_F(Recording, StartedAndStoppedInQuickTurnsMakesAWholeFileEachTime) {
  std::size_t started = 0;
  for (int i = 0; i < 20'000 && started < 20; ++i) {
    const bool begun = ask(wire::Record::START).code() == wire::Reply::OK;
    started += begun;
    EXPECT_EQ(ask(wire::Record::STOP).code(), begun ? wire::Reply::OK : wire::Reply::REFUSED);
    host_.publish();
  }
  ASSERT_TRUE(reaches(recorder(), State::OFF));
  const auto names = folder_.recordings();
  EXPECT_EQ(names.size(), started);
  for (const std::string& name : names) EXPECT_TRUE(recorded(folder_.path(name)).is_whole) << name;
}

TEST(SlowRecording, TellsEverySpokeThatWasOverwritten) {
  const ScratchFolder folder;
  RecordedHost host(1, 4);
  RecorderConfig config;
  config.folder = folder.path();
  config.reserve_bytes = 0;
  Recorder recorder(host, config);
  recorder.start();
  recorder.record(record_of(wire::Record::START, "a"), "test");
  ASSERT_TRUE(reaches(recorder, State::RECORDING));
  // Faster than a ring of four sectors, sixteen for a recorder, can be read.
  ASSERT_TRUE(comes_true([&] {
    host.publish_at_once(100);
    return recorder.state().spokes_lost() > 5000;
  }));
  recorder.record(record_of(wire::Record::STOP), "test");
  ASSERT_TRUE(reaches(recorder, State::OFF));
  const wire::RecorderState state = recorder.state();
  EXPECT_EQ(state.spokes() + state.spokes_lost(), host.published());
  const Recorded file = recorded(folder.path("a.mcap"));
  std::uint64_t told = 0;
  for (const Event& event : file.events(Event::LOST)) told += event.count();
  EXPECT_EQ(told, state.spokes_lost());
  EXPECT_EQ(file.of(Kind::spoke).size(), state.spokes());
}

TEST_F(Recording, OfInputsAloneHasNoVideoButItsDigest) {
  host_.has_exercise = true;
  host_.inputs.add("before");
  wire::Record record = record_of(wire::Record::START, "inputs");
  record.set_inputs_only(true);
  ASSERT_EQ(recorder().record(record, "test").code(), wire::Reply::OK);
  ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  EXPECT_TRUE(recorder().state().inputs_only());
  host_.inputs.add("during");
  publish(20);
  ASSERT_TRUE(comes_true([&] { return taken() == 320; }));
  end();
  const Recorded file = recorded(folder_.path("inputs.mcap"));
  EXPECT_TRUE(file.of(Kind::spoke, 0).empty());
  EXPECT_TRUE(file.of(Kind::settings, 0).empty());
  const auto inputs = file.of(Kind::input);
  ASSERT_GE(inputs.size(), 4u);
  EXPECT_EQ(inputs[0], "before");
  EXPECT_EQ(std::count(inputs.begin(), inputs.end(), "during"), 1);
  EXPECT_EQ(inputs.back(), "reached");
  recording::Input checkpoint;
  bool found = false;
  for (const std::string& bytes : inputs) {
    found = found || (checkpoint.ParseFromString(bytes) && checkpoint.has_checkpoint());
    if (found) break;
  }
  ASSERT_TRUE(found);
  EXPECT_EQ(checkpoint.checkpoint().spokes(), 320u);
  EXPECT_EQ(checkpoint.checkpoint().sha256().size(), 32u);
}

TEST_F(Recording, BeginsWithTheServerIfConfiguredAndEndsWithIt) {
  config_.record_at_start = true;
  ASSERT_TRUE(reaches(recorder(), State::RECORDING));
  publish(5);
  recorder().stop();
  const auto names = folder_.recordings();
  ASSERT_EQ(names.size(), 1u);
  const Recorded file = recorded(folder_.path(names[0]));
  EXPECT_TRUE(file.is_whole);
  EXPECT_EQ(file.of(Kind::spoke, 0).size(), 80u);
  EXPECT_EQ(recorder().state().phase(), State::OFF);
  EXPECT_EQ(ask(wire::Record::START).code(), wire::Reply::REFUSED);
}

TEST_F(Recording, NeverMadeCostsNothing) {
  config_.folder = folder_.path("none");
  recorder().log(2, "line");
  host_.publish();
  EXPECT_EQ(host_.encoded("native"), 0u);
  EXPECT_EQ(recorder().state().phase(), State::OFF);
  EXPECT_EQ(recorder().state().folder(), folder_.path("none"));
  recorder().stop();
  EXPECT_FALSE(std::filesystem::exists(folder_.path("none")));
}

}  // namespace
}  // namespace skerry::server
