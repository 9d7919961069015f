// A recording played by the running server: to consoles, in datagrams, to a display of another
// maker, and by `skerry play`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <string>
#include <vector>

#include "clients/common/datagram_socket.hpp"
#include "protocol/asterix/cat240.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "tests/system/display_kit.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::system_test {
namespace {

using namespace std::chrono_literals;
using server::recorded_spoke;
using server::RecordedFile;
using server::RecordedScene;
using testing::HasSubstr;

wire::PlaybackState await_state(client::SpokeClient& client,
                                const std::function<bool(const wire::PlaybackState&)>& condition) {
  return await<wire::PlaybackState>(client, condition);
}

wire::Playback seek_to(double seconds) {
  wire::Playback request;
  request.set_position_s(seconds);
  return request;
}

class Playback : public testing::Test {
 protected:
  // Checks the spoke that a console must have got, if it has all from the n-th on.
  static void expect_spoke(const RecordedScene& scene, const Spoke& spoke, std::uint64_t n) {
    const Spoke wanted = recorded_spoke(scene, 0, 0, n);
    ASSERT_EQ(spoke.header.index, wanted.header.index) << n;
    ASSERT_EQ(spoke.cells, wanted.cells) << n;
    ASSERT_EQ(spoke.header.utc, wanted.header.utc) << n;
    ASSERT_EQ(spoke.header.scenario_time, wanted.header.scenario_time) << n;
    ASSERT_EQ(spoke.header.heading, wanted.header.heading) << n;
  }
};

TEST_F(Playback, AConsoleSeesThatItIsOneAndGetsEverySpokeInOrder) {
  const RecordedScene scene{.turns = 20, .marks = {{9s, "buoy"}}};
  const RecordedFile file(scene);
  RunningServer server({"--play", file.path(), "--play-paused"});
  client::SpokeClient console = subscribed(server, 0);
  EXPECT_TRUE(console.hello().playback());
  EXPECT_EQ(console.hello().scenario(), "recorded scene");
  const auto standing = await_state(console, [](const auto&) { return true; });
  EXPECT_EQ(standing.file(), "scene.mcap");
  EXPECT_FALSE(standing.playing());
  EXPECT_NEAR(standing.length_s(), 40.0, 0.1);
  ASSERT_EQ(standing.marks_size(), 1);
  EXPECT_EQ(standing.marks(0).name(), "buoy");

  wire::Playback fast;
  fast.set_playing(true);
  fast.set_rate(100.0);
  ASSERT_TRUE(console.playback(fast, kAnswerTime));
  for (std::uint64_t n = 0; n < 20u * scene.spokes_per_turn; ++n) {
    expect_spoke(scene, next_spoke(console), n);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_EQ(console.losses().lost(), 0u);
  await_state(console, [](const wire::PlaybackState& state) {
    return !state.playing() && state.position_s() == state.length_s();
  });
}

TEST_F(Playback, OneWhoJoinsLaterSeesTheLastTurnOfAPausedOne) {
  const RecordedScene scene{.turns = 20};
  const RecordedFile file(scene);
  RunningServer server({"--play", file.path(), "--play-paused", "--play-from", "0:20"});
  for (int joins = 0; joins < 3; ++joins) {
    client::SpokeClient console = subscribed(server, 0);
    // One who comes while the turn is being shown to others gets the rest of that first.
    Spoke spoke = next_spoke(console);
    while (spoke.header.index != 0) spoke = next_spoke(console);
    for (std::uint64_t n = 0; n < scene.spokes_per_turn; ++n) {
      if (n > 0) spoke = next_spoke(console);
      expect_spoke(scene, spoke, 9 * scene.spokes_per_turn + n);
      if (testing::Test::HasFatalFailure()) return;
    }
  }
}

TEST_F(Playback, SeeksAndStepsComeWithSettingsShipAndWorldOfThere) {
  const RecordedScene scene{.turns = 30};
  const RecordedFile file(scene);
  RunningServer server({"--play", file.path(), "--play-paused"});
  client::SpokeClient console = subscribed(server, 0);
  ASSERT_TRUE(console.playback(seek_to(33.0), kAnswerTime));
  await<wire::Settings>(console, [](const auto& settings) { return settings.gain() == 32.0; });
  const auto ship = await<wire::OwnShip>(
      console, [](const auto& own) { return own.latitude_deg() > 60.0 + 32.5 / 3600.0; });
  EXPECT_NEAR(ship.latitude_deg(), 60.0 + 33.0 / 3600.0, 1e-5);
  wire::Playback step;
  step.set_step_turns(1);
  ASSERT_TRUE(console.playback(step, kAnswerTime));
  await_state(console, [](const auto& state) { return state.position_s() == 34.0; });
  step.set_step_turns(-2);
  ASSERT_TRUE(console.playback(step, kAnswerTime));
  await_state(console, [](const auto& state) { return state.position_s() == 30.0; });
  await<Spoke>(console, [&](const Spoke& spoke) {
    return spoke.header.utc ==
           recorded_spoke(scene, 0, 0, 15 * scene.spokes_per_turn - 1).header.utc;
  });
  EXPECT_EQ(console.losses().lost(), 0u);
}

TEST_F(Playback, WhatWasRecordedCannotBeSetAndWhatIsNonsenseIsRefused) {
  const RecordedFile file(RecordedScene{});
  RunningServer server({"--play", file.path(), "--play-paused"});
  client::SpokeClient console = connected(server);
  wire::Set set;
  set.set_gain(70.0);
  const auto refused = console.set(set, kAnswerTime);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().text, HasSubstr("a recording is played"));
  const auto beyond = console.playback(seek_to(1e6), kAnswerTime);
  ASSERT_FALSE(beyond);
  EXPECT_THAT(beyond.error().text, HasSubstr("s long"));
}

TEST_F(Playback, GoesOutAsCat240AndAsNativeDatagrams) {
  const RecordedScene scene{.turns = 3};
  const RecordedFile file(scene);
  auto cat240 = client::DatagramSocket::open({client::kDefaultHost, 0});
  ASSERT_TRUE(cat240);
  RunningServer server({"--play", file.path(), "--play-loop", "--cat240",
                        "127.0.0.1:" + std::to_string(cat240->port())});
  std::size_t videos = 0;
  while (videos < scene.spokes_per_turn) {
    const auto datagram = cat240->receive(kAnswerTime);
    ASSERT_TRUE(datagram && *datagram);
    const auto records = decode_cat240(Bytes((*datagram)->begin(), (*datagram)->end()));
    ASSERT_TRUE(records) << records.error().text;
    for (const Cat240Record& record : *records) {
      if (record.kind != Cat240Kind::video) continue;
      ++videos;
      EXPECT_EQ(record.video->cells.size(), scene.cells);
    }
  }
}

TEST_F(Playback, IsSeenByADisplayOfAnotherMaker) {
  RecordedScene scene{.spokes_per_turn = 512, .cells = 512, .turns = 5};
  // An echo all round at half the range scale.
  scene.change = [](Spoke& spoke) {
    std::fill(spoke.cells.begin(), spoke.cells.end(), 0);
    std::fill(spoke.cells.begin() + 250, spoke.cells.begin() + 262, 255);
    return true;
  };
  const RecordedFile file(scene);
  const std::uint32_t at = ipv4(127, 0, 0, 21);
  RunningServer server({"--play", file.path(), "--play-loop", "--output",
                        "garmin_xhd:interface_address=127.0.0.21"});
  DisplaySocket data({ipv4(239, 254, 2, 0), 50102}, at);
  for (int spokes = 0; spokes < 200; ++spokes) {
    const Bytes packet = await_datagram(data, at, "a spoke", [](const Bytes& bytes) {
      return bytes.size() > 36 && u32(bytes, 0) == 0x998;
    });
    const double span_m = u32(packet, 20), cells = u16(packet, 26);
    const auto strongest = std::max_element(packet.begin() + 36, packet.end());
    ASSERT_EQ(*strongest, 255);
    const double range_m = static_cast<double>(strongest - packet.begin() - 36) / cells * span_m;
    EXPECT_NEAR(range_m, 250.0 / 512.0 * 6.0 * 1852.0, 2.0 * span_m / cells);
  }
}

TEST_F(Playback, BadFilesAreNamedWithTheByteAndEndTheServer) {
  const TempFolder folder;
  for (const auto& [name, text, why] :
       {std::tuple{"empty.mcap", "", "empty.mcap"},
        std::tuple{"text.mcap", "this is no recording, whatever its name says", "text.mcap"}}) {
    const Ending ending = run({skerryd_program(), "--play", folder.write(name, text)});
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, HasSubstr(why));
    EXPECT_THAT(ending.err, HasSubstr("byte"));
  }
  const Ending missing = run({skerryd_program(), "--play", folder.path("none.mcap")});
  EXPECT_EQ(missing.code, 2);
  EXPECT_THAT(missing.err, HasSubstr("none.mcap"));
  const RecordedFile file(RecordedScene{});
  const Ending mark = run({skerryd_program(), "--play", file.path(), "--play-from", "nowhere"});
  EXPECT_EQ(mark.code, 2);
  EXPECT_THAT(mark.err, HasSubstr("no marks"));
  const Ending beyond = run({skerryd_program(), "--play", file.path(), "--play-from", "1:00:00"});
  EXPECT_THAT(beyond.err, HasSubstr("s long"));
}

TEST_F(Playback, IsControlledFromTheCommandLine) {
  const RecordedScene scene{.turns = 30, .marks = {{9s, "buoy"}}};
  const RecordedFile file(scene);
  RunningServer server({"--play", file.path(), "--play-paused"});
  const std::string port = std::to_string(server.tcp_port());
  const auto say = [&](std::vector<std::string> words) {
    words.insert(words.begin(), {skerry_program(), "play", "--server", "--port", port});
    return run(std::move(words));
  };
  EXPECT_THAT(say({"state"}).out, HasSubstr("0:00:00.0 of 0:01:00.0  stands  1x"));
  EXPECT_THAT(say({"seek", "0:40"}).out, HasSubstr("0:00:40.0 of"));
  EXPECT_THAT(say({"seek", "buoy"}).out, HasSubstr("0:00:09.0 of"));
  EXPECT_THAT(say({"rate", "0.5"}).out, HasSubstr("0.5x"));
  EXPECT_THAT(say({"marks"}).out, HasSubstr("buoy"));
  EXPECT_THAT(say({"play"}).out, HasSubstr("plays"));
  EXPECT_EQ(say({"rate", "1000"}).code, 1);
  EXPECT_THAT(say({"rate", "1000"}).err, HasSubstr("0.1 to 100"));
  EXPECT_EQ(say({"fly"}).code, 2);
}

// The recorder is a reader that keeps up: at the fastest rate it has every spoke, in order.
TEST_F(Playback, AtAHundredTimesItsPaceNothingIsLostToAFile) {
  const RecordedScene scene{.spokes_per_turn = 2048, .cells = 512, .turns = 40, .turn = 2500ms};
  const RecordedFile file(scene);
  const TempFolder folder;
  RunningServer server({"--play", file.path(), "--play-paused", "--record-folder",
                        folder.path("rec"), "--record-reserve-mib", "0"});
  client::SpokeClient console = connected(server);
  wire::Record record;
  record.set_name("again");
  ASSERT_TRUE(console.record(record, kAnswerTime));
  await_status(console, [](const wire::Status& status) {
    return status.recorder().phase() == wire::RecorderState::RECORDING &&
           !status.recorder().file().empty();
  });
  wire::Playback fast;
  fast.set_playing(true);
  fast.set_rate(100.0);
  ASSERT_TRUE(console.playback(fast, kAnswerTime));
  const std::uint64_t spokes = std::uint64_t{scene.turns} * scene.spokes_per_turn;
  const wire::Status done = await_status(console, [&](const wire::Status& status) {
    return !status.playback().playing() &&
           status.recorder().spokes() + status.recorder().spokes_lost() >= spokes;
  });
  EXPECT_EQ(done.recorder().spokes_lost(), 0u);
  record.set_action(wire::Record::STOP);
  ASSERT_TRUE(console.record(record, kAnswerTime));
  await_status(console, [](const wire::Status& status) {
    return status.recorder().phase() == wire::RecorderState::OFF;
  });
  const auto again = recording::RecordingReader::open(folder.path("rec/again.mcap"));
  ASSERT_TRUE(again) << again.error().to_string();
  auto items = again->items({{recording::Kind::spoke, 0, 0}});
  wire::Spoke message;
  for (std::uint64_t n = 0; n < spokes; ++n) {
    const auto item = items.next();
    ASSERT_TRUE(item) << n;
    ASSERT_TRUE(message.ParseFromArray(item->bytes.data(), static_cast<int>(item->bytes.size())));
    const auto spoke = from_message(message);
    ASSERT_TRUE(spoke);
    expect_spoke(scene, *spoke, n);
    if (testing::Test::HasFatalFailure()) return;
  }
  EXPECT_FALSE(items.next());
}

TEST_F(Playback, SkerryPlayStartsAServerOnAFile) {
  const RecordedFile file(RecordedScene{});
  ChildProcess play({skerry_program(), "play", file.path(), "--port", "0", "--http-port", "0",
                     "--no-udp", "--no-cat240", "--loop"});
  // Standard input is at its end: it plays until Ctrl-C.
  play.await_error_text("stop with Ctrl-C");
  play.signal(SIGINT);
  const Ending ending = play.wait();
  EXPECT_EQ(ending.code, 0) << ending.err;
  EXPECT_THAT(ending.err, HasSubstr("web console"));
  EXPECT_THAT(ending.err, HasSubstr("playback of"));
  const Ending bad = run({skerry_program(), "play", "/nowhere/none.mcap", "--port", "0"});
  EXPECT_EQ(bad.code, 1);
  EXPECT_THAT(bad.err, HasSubstr("none.mcap"));
}

TEST_F(Playback, AServerOfRadarsHasNothingToPlay) {
  const TempFolder folder;
  RunningServer server({"--scenario", folder.write("small.yaml", small_scenario())});
  client::SpokeClient console = connected(server);
  EXPECT_FALSE(console.hello().playback());
  const auto refused = console.playback(seek_to(0.0), kAnswerTime);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().text, HasSubstr("plays no recording"));
}

}  // namespace
}  // namespace skerry::system_test
