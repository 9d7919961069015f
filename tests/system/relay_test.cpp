// Relays: a server that serves another's radars, and one that serves those again.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <cstdio>
#include <future>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "protocol/wire/frame.hpp"
#include "tests/system/one_client_port.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

std::string place_of(std::uint16_t port) { return "127.0.0.1:" + std::to_string(port); }

// Their bytes by their numbers, from the next that comes on.
std::map<std::uint64_t, Bytes> spokes_from(client::SpokeClient& client, std::size_t count) {
  std::map<std::uint64_t, Bytes> spokes;
  while (spokes.size() < count) {
    const Spoke spoke = next_spoke(client);
    append_spoke_frame(spokes[spoke.header.sequence], spoke);
  }
  return spokes;
}

class Relay : public testing::Test {
 protected:
  TempFolder folder_;
  RunningServer origin_{{"--scenario", folder_.write("small.yaml", coaster_scenario())}};
  RunningServer near_{{"--relay", place_of(origin_.tcp_port())}};
  RunningServer far_{{"--relay", place_of(near_.tcp_port())}};

 private:
  static std::string coaster_scenario() {
    std::string text = small_scenario();
    const std::size_t begin = text.find("    speed_time_constant_s"),
                      end = text.find("    radars:");
    return text.replace(begin, end - begin, "    ship_class: coaster\n");
  }
};

// By turn and index, from the next that comes on.
std::map<std::pair<std::uint32_t, std::uint32_t>, Spoke> cells_from(client::SpokeClient& client,
                                                                    std::size_t count) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, Spoke> spokes;
  while (spokes.size() < count) {
    Spoke spoke = next_spoke(client);
    spokes[{spoke.header.scan, spoke.header.index}] = std::move(spoke);
  }
  return spokes;
}

TEST_F(Relay, ThinSpokesHaveThePeaksOfTheWholeOnes) {
  const RunningServer thin({"--relay", place_of(origin_.tcp_port()), "--relay-thin", "4"});
  const RunningServer behind({"--relay", place_of(thin.tcp_port())});
  client::SpokeClient at_origin = subscribed(origin_, 0), at_thin = subscribed(thin, 0),
                      at_behind = subscribed(behind, 0);
  const auto begin = [](client::SpokeClient& client) {
    return std::async(std::launch::async, [&] { return cells_from(client, 3 * kSmallSpokes); });
  };
  auto of_origin = begin(at_origin), of_thin = begin(at_thin), of_behind = begin(at_behind);
  const auto whole = of_origin.get();
  for (auto* relayed : {&of_thin, &of_behind}) {
    std::size_t compared = 0, echoes = 0;
    std::uint64_t next = 0;
    for (const auto& [place, spoke] : relayed->get()) {
      EXPECT_TRUE(next == 0 || spoke.header.sequence == next) << spoke.header.sequence;
      next = spoke.header.sequence + 1;
      ASSERT_EQ(spoke.header.geometry, (ScanGeometry{512, 256, 4}));
      const auto there = whole.find(place);
      if (there == whole.end()) continue;
      for (std::size_t c = 0; c < 256; ++c) {
        const auto& cells = there->second.cells;
        const int peak = std::max(cells[2 * c], cells[2 * c + 1]) >> 4;
        ASSERT_EQ(spoke.cells[c], peak < 3 ? 0 : peak) << place.second << " " << c;
        echoes += peak >= 3;
      }
      ++compared;
    }
    EXPECT_GT(compared, kSmallSpokes);
    EXPECT_GT(echoes, 1000u);
  }
  EXPECT_THAT(thin.skerry("status").out, HasSubstr("thin spokes of level 4"));
}

TEST_F(Relay, SpokesAreTheOriginsWhicheverServerTheyComeFrom) {
  for (const std::uint32_t radar : {0u, 1u, 2u}) {
    client::SpokeClient at_origin = subscribed(origin_, radar), at_near = subscribed(near_, radar),
                        at_far = subscribed(far_, radar);
    constexpr std::size_t kSpokes = 2 * kSmallSpokes;
    const auto begin = [](client::SpokeClient& client) {
      return std::async(std::launch::async, [&] { return spokes_from(client, kSpokes); });
    };
    auto of_origin = begin(at_origin), of_near = begin(at_near), of_far = begin(at_far);
    const auto origin = of_origin.get();
    for (auto* relayed : {&of_near, &of_far}) {
      std::size_t compared = 0;
      for (const auto& [sequence, bytes] : relayed->get()) {
        const auto there = origin.find(sequence);
        if (there == origin.end()) continue;
        ASSERT_EQ(bytes, there->second) << "radar " << radar << ", spoke " << sequence;
        ++compared;
      }
      EXPECT_GT(compared, kSpokes / 2);
    }
    EXPECT_EQ(at_near.losses().lost(), 0u);
    EXPECT_EQ(at_far.losses().lost(), 0u);
  }
}

TEST_F(Relay, AViewOfOnesOwnIsOneOfTheOrigin) {
  std::uint32_t view = 0;
  {
    client::SpokeClient own = connected(far_);
    const auto opened = own.subscribe_new_view(0, 0, kAnswerTime);
    ASSERT_TRUE(opened.ok()) << opened.error().text;
    view = *opened;
    EXPECT_GT(view, 0u);
    EXPECT_EQ(next_spoke(own).header.view, view);
    const Ending set = far_.skerry("set", {"--view", std::to_string(view), "--gain", "77"});
    EXPECT_EQ(set.code, 0) << set.err;
    await<wire::Settings>(own, [](const wire::Settings& s) { return s.gain() == 77; });
    client::SpokeClient observer = connected(origin_);
    const wire::Status status =
        await_status(observer, [](const wire::Status& s) { return s.radars(0).views_size() == 1; });
    EXPECT_EQ(status.radars(0).views(0).gain(), 77);
    EXPECT_EQ(status.radars(0).views(0).view(), view);
    EXPECT_NE(status.radars(0).settings().gain(), 77);
  }
  client::SpokeClient observer = connected(origin_);
  await_status(observer, [](const wire::Status& s) { return s.radars(0).views_size() == 0; });
}

TEST_F(Relay, AChangeIsTheOriginsAndSoIsTheAnswer) {
  client::SpokeClient at_origin = subscribed(origin_, 0), at_far = subscribed(far_, 0);
  wire::Set set;
  set.set_gain(71);
  const auto done = at_far.set(set, kAnswerTime);
  ASSERT_TRUE(done.ok()) << done.error().text;
  await<wire::Settings>(at_origin, [](const wire::Settings& s) { return s.gain() == 71; });
  await<wire::Settings>(at_far, [](const wire::Settings& s) { return s.gain() == 71; });
  set.set_gain(710);
  const auto refused = at_far.set(set, kAnswerTime), as_at_origin = at_origin.set(set, kAnswerTime);
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().code, wire::Reply::OUT_OF_RANGE);
  const auto reason = [](const std::string& text) { return text.substr(text.find("request: ")); };
  EXPECT_EQ(reason(refused.error().text), reason(as_at_origin.error().text));
  // The instructor's part.
  const Ending world = far_.skerry("set", {"--sea-state", "4.5"});
  EXPECT_EQ(world.code, 0) << world.err;
  await<wire::World>(at_origin, [](const wire::World& w) { return w.sea_state() == 4.5; });
  const Ending lock = far_.skerry("set", {"--lock", "sea", "--instructor"});
  EXPECT_EQ(lock.code, 0) << lock.err;
  wire::Set sea;
  sea.set_sea(5);
  EXPECT_EQ(at_far.set(sea, kAnswerTime).error().code, wire::Reply::REFUSED);
}

TEST_F(Relay, OneOfItsConsolesHasTheCon) {
  client::SpokeClient first = subscribed(far_, 0), second = subscribed(far_, 0);
  wire::Set take;
  take.mutable_con()->set_take(true);
  const auto taken = first.set(take, kAnswerTime);
  ASSERT_TRUE(taken.ok()) << taken.error().text;
  await<wire::OwnShip>(
      second, [&](const wire::OwnShip& ship) { return ship.con().con() == first.hello().you(); });
  wire::Set rudder;
  rudder.mutable_con()->set_rudder_deg(20);
  EXPECT_EQ(second.set(rudder, kAnswerTime).error().code, wire::Reply::REFUSED);
  EXPECT_TRUE(first.set(rudder, kAnswerTime).ok());
  client::SpokeClient at_origin = subscribed(origin_, 0);
  await<wire::OwnShip>(at_origin, [](const wire::OwnShip& ship) {
    return ship.con().rudder_order_deg() == 20 && !ship.con().con().empty();
  });
  EXPECT_EQ(at_origin.set(rudder, kAnswerTime).error().code, wire::Reply::REFUSED);
  { const client::SpokeClient ends = std::move(first); }
  await<wire::OwnShip>(at_origin,
                       [](const wire::OwnShip& ship) { return ship.con().con().empty(); });
}

TEST_F(Relay, AnInstructorSeesTheExerciseThroughIt) {
  client::SpokeClient instructor = connected(far_);
  const auto watched = instructor.watch_exercise(2, kAnswerTime);
  ASSERT_TRUE(watched.ok()) << watched.error().text;
  const auto state = await<wire::ExerciseState>(
      instructor, [](const wire::ExerciseState& s) { return s.ships_size() > 0; });
  EXPECT_EQ(state.ships_size(), 5);
}

TEST_F(Relay, EveryHopIsToldOf) {
  client::SpokeClient client = subscribed(far_, 0);
  next_spoke(client);
  const wire::Status status = await_status(client, [](const wire::Status& s) {
    return s.hops_size() == 2 && s.hops(0).has_round_trip_ms() && s.hops(1).has_round_trip_ms() &&
           s.hops(0).spokes() > 0 && s.hops(0).bytes_per_second() > 0;
  });
  EXPECT_EQ(status.hops(0).upstream(), place_of(near_.tcp_port()));
  EXPECT_EQ(status.hops(1).upstream(), place_of(origin_.tcp_port()));
  EXPECT_TRUE(status.hops(1).connected());
  EXPECT_EQ(status.hops(0).spokes_lost(), 0u);
  EXPECT_THAT(far_.skerry("status").out, HasSubstr("RELAY OF"));
}

TEST_F(Relay, ALoopIsRefused) {
  // `near_` is to be the upstream of the server at the origin's port.
  const std::uint16_t port = origin_.tcp_port();
  origin_.signal(SIGKILL);
  client::SpokeClient client = connected(near_);
  await_status(client, [](const wire::Status& s) { return !s.hops(0).connected(); });
  ChildProcess closing({skerryd_program(), "--relay", place_of(far_.tcp_port()), "--tcp-port",
                        std::to_string(port), "--http-port", "0", "--no-udp", "--no-cat240"});
  const wire::Status status = await_status(client, [](const wire::Status& s) {
    return s.hops(0).problem().find("a loop") != std::string::npos;
  });
  EXPECT_FALSE(status.hops(0).connected());
  closing.signal(SIGTERM);
  EXPECT_EQ(closing.wait().code, 0);
  origin_.stop();
}

TEST(RelayAlone, ConsolesStayWhenTheOriginDiesAndHaveSpokesWhenItIsBack) {
  TempFolder folder;
  const std::string scenario = folder.write("small.yaml", small_scenario());
  ServerProcess origin({"--scenario", scenario});
  const RunningServer relay({"--relay", place_of(origin.tcp_port())});
  client::SpokeClient shared = subscribed(relay, 0), own = connected(relay);
  const auto view = own.subscribe_new_view(0, 0, kAnswerTime);
  ASSERT_TRUE(view.ok()) << view.error().text;
  wire::Set gain;
  gain.set_view(*view);
  gain.set_gain(12);
  ASSERT_TRUE(own.set(gain, kAnswerTime).ok());
  await<wire::Settings>(own, [](const wire::Settings& s) { return s.gain() == 12; });
  next_spoke(shared);
  origin.signal(SIGKILL);
  await<wire::OwnShip>(shared, [](const wire::OwnShip& ship) {
    return ship.no_position() && ship.text().starts_with("No picture");
  });
  EXPECT_EQ(shared.set(gain, kAnswerTime).error().code, wire::Reply::REFUSED);
  const auto begun = std::chrono::steady_clock::now();
  ChildProcess again({skerryd_program(), "--scenario", scenario, "--tcp-port",
                      std::to_string(origin.tcp_port()), "--http-port", "0", "--print-ports",
                      "--no-udp", "--no-cat240"});
  ASSERT_TRUE(again.read_line());
  const auto ready = std::chrono::steady_clock::now();
  next_spoke(shared);
  const auto seconds = [](auto time) { return std::chrono::duration<double>(time).count(); };
  std::printf("origin started %.2f s, first spoke at the console %.2f s after that\n",
              seconds(ready - begun), seconds(std::chrono::steady_clock::now() - ready));
  // The view has its number and its settings again, whatever number it has there.
  const Spoke spoke = next_spoke(own);
  EXPECT_EQ(spoke.header.view, *view);
  client::SpokeClient observer = [&] {
    auto client = client::SpokeClient::connect("127.0.0.1", origin.tcp_port(), kAnswerTime);
    if (!client.ok()) throw std::runtime_error(client.error().text);
    return std::move(client).value();
  }();
  await_status(observer, [](const wire::Status& s) {
    return s.radars(0).views_size() == 1 && s.radars(0).views(0).gain() == 12;
  });
  again.signal(SIGTERM);
  EXPECT_EQ(again.wait().code, 0);
}

TEST(RelayAlone, WaitsForTheOrigin) {
  TempFolder folder;
  std::uint16_t port = 0;
  {
    const OneClientPort free;  // and free again
    port = free.port();
  }
  ChildProcess relay({skerryd_program(), "--relay", place_of(port), "--tcp-port", "0",
                      "--http-port", "0", "--print-ports", "--no-udp", "--no-cat240"});
  relay.await_error_text("waiting for " + place_of(port));
  ChildProcess origin({skerryd_program(), "--scenario",
                       folder.write("small.yaml", small_scenario()), "--tcp-port",
                       std::to_string(port), "--http-port", "0", "--no-udp", "--no-cat240"});
  EXPECT_THAT(relay.read_line().value_or(""), HasSubstr("tcp "));
  for (ChildProcess* each : {&relay, &origin}) {
    each->signal(SIGTERM);
    EXPECT_EQ(each->wait().code, 0);
  }
}

TEST(RelayAlone, EndsAtASignalWhileItWaits) {
  ChildProcess relay({skerryd_program(), "--relay", "127.0.0.1:1", "--tcp-port", "0", "--http-port",
                      "0", "--no-udp", "--no-cat240"});
  relay.await_error_text("waiting for 127.0.0.1:1");
  relay.signal(SIGTERM);
  EXPECT_EQ(relay.wait().code, 0);
}

TEST(RelayAlone, TwoThatWaitForEachOtherEndWithTheReason) {
  std::uint16_t ports[2];
  {
    const OneClientPort first, second;  // and free again
    ports[0] = first.port();
    ports[1] = second.port();
  }
  const auto arguments = [&ports](int own, int other) {
    return std::vector<std::string>{skerryd_program(),
                                    "--relay",
                                    place_of(ports[other]),
                                    "--tcp-port",
                                    std::to_string(ports[own]),
                                    "--http-port",
                                    "0",
                                    "--no-udp",
                                    "--no-cat240"};
  };
  ChildProcess first(arguments(0, 1));
  first.await_error_text("waiting for " + place_of(ports[1]));
  ChildProcess second(arguments(1, 0));
  for (ChildProcess* each : {&first, &second}) {
    const Ending ending = each->wait();
    EXPECT_EQ(ending.code, 2);
    EXPECT_THAT(ending.err, HasSubstr("a loop: 127.0.0.1"));
  }
  // Whoever only looks is not kept.
  auto checks = arguments(0, 1);
  checks.push_back("--check");
  const Ending checked = run(std::move(checks));
  EXPECT_EQ(checked.code, 2);
  EXPECT_THAT(checked.err, HasSubstr("refused the connection"));
}

TEST(RelayAlone, GarbageFromTheOtherServerIsToldAndBornWith) {
  OneClientPort other;
  TempFolder folder;
  const RunningServer origin({"--scenario", folder.write("small.yaml", small_scenario())});
  client::SpokeClient at_origin = connected(origin);
  wire::ServerMessage hello;
  *hello.mutable_hello() = at_origin.hello();
  Bytes bytes;
  append_frame(bytes, hello);
  for (int i = 0; i < 1000; ++i) bytes.push_back(static_cast<std::uint8_t>(0x80 | i * 37));
  other.answer_all_with(bytes);
  const RunningServer relay({"--relay", place_of(other.port())});
  client::SpokeClient console = subscribed(relay, 0);
  const wire::Status status = await_status(console, [](const wire::Status& s) {
    return s.hops(0).problem().find("not the native protocol") != std::string::npos;
  });
  EXPECT_EQ(status.hops(0).spokes(), 0u);
}

TEST(RelayAlone, WhatARelayCannotDoIsRefusedWithTheReason) {
  const auto refusal = [](std::vector<std::string> more) {
    std::vector<std::string> all = {skerryd_program(), "--relay", "127.0.0.1:1"};
    all.insert(all.end(), more.begin(), more.end());
    const Ending ending = run(std::move(all));
    EXPECT_EQ(ending.code, 2);
    return ending.err;
  };
  EXPECT_THAT(refusal({"--scenario", "x.yaml"}), HasSubstr("--scenario and --relay"));
  EXPECT_THAT(refusal({"--play", "x.mcap"}), HasSubstr("--play and --relay"));
  EXPECT_THAT(refusal({"--sweeps", "127.0.0.1:7413"}), HasSubstr("boards are not relayed"));
  EXPECT_THAT(refusal({"--input", "nmea0183:port=10111"}), HasSubstr("--input and --relay"));
  EXPECT_THAT(refusal({"--chart", "x.000"}), HasSubstr("the chart is the other server's"));
  EXPECT_THAT(refusal({"--tcp-port", "1"}), HasSubstr("this server's own port"));
  EXPECT_THAT(refusal({"--relay-token-file", "/nowhere"}), HasSubstr("/nowhere: cannot be read"));
  const Ending no_server = run({skerryd_program(), "--relay", "nowhere"});
  EXPECT_EQ(no_server.code, 2);
  EXPECT_THAT(no_server.err, HasSubstr("expected HOST:PORT"));
}

}  // namespace
}  // namespace skerry::system_test
