// A playback as the network sees it, with a reader in place of the network.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <thread>

#include "server/playback/playback_host.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using testing::HasSubstr;

// Keeps what is published in a view; it encodes nothing, so that it always keeps up.
class Watcher {
 public:
  explicit Watcher(VideoChannel& channel, const std::string& name = "watched")
      : ring_(channel.add_format(name, [this](const Sector& sector) { return keep(sector); })) {}
  void join() {
    registration_ = ring_.on_publish([] {});
    ring_.cursor_at_end();
  }
  std::vector<Spoke> spokes() const {
    const std::lock_guard lock(mutex_);
    return spokes_;
  }
  std::size_t count() const {
    const std::lock_guard lock(mutex_);
    return spokes_.size();
  }
  void forget() {
    const std::lock_guard lock(mutex_);
    spokes_.clear();
  }

 private:
  EncodedSectorPtr keep(const Sector& sector) {
    const std::lock_guard lock(mutex_);
    for (const SpokePtr& spoke : sector.spokes) spokes_.push_back(*spoke);
    return std::make_shared<EncodedSector>();
  }
  mutable std::mutex mutex_;
  std::vector<Spoke> spokes_;
  FormatRing& ring_;
  FormatRing::Registration registration_;
};

// Until another thread has brought it about; only what hangs is so late.
void await(const std::function<bool()>& condition) {
  const auto deadline = std::chrono::steady_clock::now() + 30s;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > deadline) throw std::runtime_error("never came");
    std::this_thread::sleep_for(1ms);
  }
}

class Played {
 public:
  explicit Played(const RecordedScene& recorded = {}, const PlayerOptions& options = {})
      : scene(recorded), file(recorded), host(file.open(), options, "test"), watched(channel()) {
    watched.join();
  }
  VideoChannel& channel(std::uint32_t radar = 0, std::uint32_t view = 0) {
    return *host.find_channel(radar, view);
  }
  wire::PlaybackState state() { return host.playback()->state(); }
  wire::Reply ask(const wire::Playback& request) {
    return host.playback()->control(request, "test");
  }
  void seek(double seconds) {
    wire::Playback request;
    request.set_position_s(seconds);
    EXPECT_EQ(ask(request).code(), wire::Reply::OK);
  }
  void step(int turns) {
    wire::Playback request;
    request.set_step_turns(turns);
    EXPECT_EQ(ask(request).code(), wire::Reply::OK);
  }
  // Checks the spokes from the recording's n-th on, as played: cells and place in the turn.
  void expect_spokes(const std::vector<Spoke>& spokes, std::uint64_t from) const {
    for (std::size_t i = 0; i < spokes.size(); ++i) {
      const Spoke wanted =
          recorded_spoke(scene, scene.radars.front(), scene.views.front(), from + i);
      ASSERT_EQ(spokes[i].header.index, wanted.header.index) << i;
      ASSERT_EQ(spokes[i].cells, wanted.cells) << i;
      ASSERT_EQ(spokes[i].header.utc, wanted.header.utc) << i;
    }
  }
  static void expect_growing(const std::vector<Spoke>& spokes) {
    for (std::size_t i = 1; i < spokes.size(); ++i) {
      ASSERT_EQ(spokes[i].header.sequence, spokes[i - 1].header.sequence + 1);
      ASSERT_GE(spokes[i].header.scan, spokes[i - 1].header.scan);
    }
  }

  const RecordedScene scene;
  const RecordedFile file;
  PlaybackHost host;
  Watcher watched;
};

constexpr PlayerOptions kFast{.rate = 100.0};
constexpr PlayerOptions kPaused{.playing = false};

TEST(PlaybackHost, PlaysEverySpokeOnceInOrderAsRecorded) {
  Played played({.turns = 40}, kFast);
  played.host.start();
  await([&] { return !played.state().playing(); });
  const auto spokes = played.watched.spokes();
  ASSERT_EQ(spokes.size(), 40u * 256);
  played.expect_spokes(spokes, 0);
  Played::expect_growing(spokes);
  EXPECT_EQ(played.state().position_s(), played.state().length_s());
  EXPECT_EQ(played.state().problem(), "");
}

TEST(PlaybackHost, KeepsTheRecordedPace) {
  Played played({.turns = 1, .turn = 400ms});
  const auto begun = std::chrono::steady_clock::now();
  played.host.start();
  await([&] { return !played.state().playing(); });
  EXPECT_GE(std::chrono::steady_clock::now() - begun, 390ms);
  EXPECT_EQ(played.watched.count(), 256u);
}

TEST(PlaybackHost, SeeksWithTheTurnBeforeAndWhatIsInForceThere) {
  Played played({.turns = 20}, kPaused);
  played.host.start();
  played.seek(11.0);  // the middle of a turn of 2 s
  EXPECT_EQ(played.state().position_s(), 11.0) << "at once";
  await([&] { return played.watched.count() == 256; });
  played.expect_spokes(played.watched.spokes(), 9 * 128);
  await([&] { return played.host.settings(0, 0).gain() == 10.0; });
  EXPECT_EQ(played.state().position_s(), 11.0);
  EXPECT_FALSE(played.state().playing());
  // Back: numbers go on.
  played.seek(3.0);
  await([&] { return played.watched.count() == 512; });
  Played::expect_growing(played.watched.spokes());
  EXPECT_EQ(played.host.settings(0, 0).gain(), 2.0);
  EXPECT_NEAR(played.host.own_ship(0).latitude_deg(), 60.0 + 3.0 / 3600.0, 1e-6);
  EXPECT_EQ(played.host.world().sea_state(), 2.0);
  ASSERT_EQ(played.host.traffic().size(), 1u);
  // Ships as they really were: of the place itself.
  EXPECT_NEAR(played.host.traffic()[0].position.longitude_deg, 5.03, 1e-6);
}

TEST(PlaybackHost, SeeksToAMark) {
  Played played({.turns = 20, .marks = {{5s, "first"}, {30s, "second"}}}, kPaused);
  ASSERT_EQ(played.state().marks_size(), 2);
  EXPECT_EQ(played.state().marks(1).position_s(), 30.0);
  played.host.start();
  wire::Playback request;
  request.set_mark("second");
  EXPECT_EQ(played.ask(request).code(), wire::Reply::OK);
  EXPECT_EQ(played.state().position_s(), 30.0);
  await([&] { return played.watched.count() == 256; });
}

TEST(PlaybackHost, StepsByTurnsAndStandsStill) {
  Played played({.turns = 20});
  played.host.start();
  played.seek(9.0);
  played.step(1);
  await([&] { return played.state().position_s() == 10.0; });
  EXPECT_FALSE(played.state().playing());
  played.watched.forget();
  played.step(1);
  await([&] { return played.state().position_s() == 12.0 && played.watched.count() == 256; });
  played.expect_spokes(played.watched.spokes(), 5 * 256);
  played.watched.forget();
  played.step(-2);
  await([&] { return played.state().position_s() == 8.0 && played.watched.count() == 256; });
  played.expect_spokes(played.watched.spokes(), 3 * 256);
  played.step(-100);
  await([&] { return played.state().position_s() == 0.0; });
  played.step(100);
  await([&] { return played.state().position_s() == played.state().length_s(); });
}

TEST(PlaybackHost, StepsByARadarThatTurnsWhereTheFirstIsSilent) {
  RecordedScene scene{.turns = 40, .radars = {0, 1}};
  scene.change = [](Spoke& spoke) { return spoke.header.radar == 1 || spoke.header.scan < 1004; };
  Played played(scene, kPaused);
  played.host.start();
  played.seek(60.0);
  played.step(1);
  await([&] { return played.state().position_s() == 62.0; });
}

TEST(PlaybackHost, OfVideoThatCannotBePlayedIsNotMade) {
  const RecordedFile file(RecordedScene{.views = {70'000}});
  EXPECT_THROW(PlaybackHost(file.open(), {}, "test"), std::runtime_error);
}

TEST(Player, WithoutVideoAStepGoesToTheEnd) {
  const RecordedFile file(RecordedScene{});
  const recording::RecordingReader reader = file.open();
  RecordedRadars radars;
  radars.radars.emplace_back().info.set_rpm(24.0);
  radars.played[0] = 0;
  Player::RadarViews views;
  views.push_back(std::make_unique<RelayedViewList>(std::vector<std::uint32_t>{}, 0, 16));
  RelayedState state;
  Player player(reader, radars, views, state, kPaused);
  player.start();
  player.order({.steps = 1});
  await([&] { return player.standing().place == reader.summary().end; });
  player.order({.steps = -1});
  await([&] { return player.standing().place == reader.summary().begin; });
}

TEST(PlaybackHost, SeeksWhileItSeeks) {
  Played played({.turns = 40}, kPaused);
  played.host.start();
  for (int i = 0; i < 50; ++i) {
    played.seek(i % 2 == 0 ? 70.0 : 4.0 + i * 0.5);
    EXPECT_EQ(played.state().position_s(), i % 2 == 0 ? 70.0 : 4.0 + i * 0.5) << "the goal";
    if (i % 7 == 0) std::this_thread::sleep_for(10ms);
  }
  played.seek(50.0);
  await([&] {
    const auto spokes = played.watched.spokes();
    return !spokes.empty() &&
           spokes.back().header.utc == recorded_spoke(played.scene, 0, 0, 25 * 256 - 1).header.utc;
  });
  EXPECT_EQ(played.state().position_s(), 50.0);
  Played::expect_growing(played.watched.spokes());
}

TEST(PlaybackHost, PausesAndGoesOnWithoutALoss) {
  Played played({.turns = 4, .turn = 500ms});
  played.host.start();
  for (const std::size_t some : {100, 300, 700}) {
    await([&] { return played.watched.count() >= some; });
    wire::Playback request;
    request.set_playing(false);
    EXPECT_EQ(played.ask(request).code(), wire::Reply::OK);
    const double stands = played.state().position_s();
    std::this_thread::sleep_for(5ms);
    EXPECT_EQ(played.state().position_s(), stands);
    request.set_playing(true);
    played.ask(request);
  }
  await([&] { return !played.state().playing(); });
  const auto spokes = played.watched.spokes();
  ASSERT_GE(spokes.size(), 4u * 256);
  Played::expect_growing(spokes);
}

TEST(PlaybackHost, AtTheEndItLoopsIfAskedAndPlaysFromTheBeginIfNot) {
  Played played({.turns = 2}, {.rate = 100.0, .loop = true});
  played.host.start();
  await([&] { return played.watched.count() > 5 * 512; });
  EXPECT_TRUE(played.state().playing());
  wire::Playback request;
  request.set_loop(false);
  played.ask(request);
  await([&] { return !played.state().playing(); });
  Played::expect_growing(played.watched.spokes());
  played.watched.forget();
  request.Clear();
  request.set_playing(true);
  played.ask(request);
  await([&] { return played.watched.count() >= 512; });
  played.expect_spokes(played.watched.spokes(), 0);
}

TEST(PlaybackHost, OneWhoJoinsAPausedPlaybackSeesTheLastTurn) {
  Played played({.turns = 20}, kPaused);
  Watcher late(played.channel(), "late");  // formats are there before it starts
  played.host.start();
  played.seek(10.0);
  await([&] { return played.watched.count() == 256; });
  played.watched.forget();
  late.join();
  await([&] { return late.count() == 256; });
  played.expect_spokes(late.spokes(), 4 * 256);
  EXPECT_EQ(played.state().position_s(), 10.0);
  EXPECT_FALSE(played.state().playing());
}

TEST(PlaybackHost, RecordedViewsArePlayedAndOpenedOnesShowTheSame) {
  Played played({.turns = 2, .radars = {2, 7}, .views = {0, 5}}, kFast);
  ASSERT_EQ(played.host.radar_count(), 2u);
  Watcher fifth(played.channel(1, 5));
  fifth.join();
  std::optional<Watcher> copy;
  const auto view =
      played.host.open_view(1, 5, false, [&](VideoChannel& channel) { copy.emplace(channel); });
  ASSERT_TRUE(view);
  EXPECT_EQ(*view, 6u);
  copy->join();
  played.host.start();
  await([&] { return !played.state().playing(); });
  ASSERT_EQ(fifth.count(), 512u);
  ASSERT_EQ(copy->count(), 512u);
  for (std::uint64_t n = 0; n < 512; ++n) {
    const Spoke wanted = recorded_spoke(played.scene, 7, 5, n);
    ASSERT_EQ(fifth.spokes()[n].cells, wanted.cells);
    ASSERT_EQ(fifth.spokes()[n].header.radar, 1u);
    ASSERT_EQ(copy->spokes()[n].cells, wanted.cells);
    if (n > 40) n += 30;
  }
  EXPECT_EQ(copy->spokes()[0].header.view, 6u);
  EXPECT_EQ(played.host.settings(1, 6).view(), 6u);
  copy.reset();
  played.host.close_view(1, 6);
  EXPECT_EQ(played.host.find_channel(1, 6), nullptr);
  played.host.close_view(1, 5);
  EXPECT_NE(played.host.find_channel(1, 5), nullptr) << "it was recorded";
}

TEST(PlaybackHost, AnOutputsViewReachesAsFarAsItAsksFor) {
  Played played({.turns = 1}, kFast);
  std::optional<Watcher> output;
  const auto view =
      played.host.open_view(0, 0, true, [&](VideoChannel& channel) { output.emplace(channel); });
  output->join();
  wire::Set set;
  set.set_view(*view);
  set.set_instrumented_range_m(6.0 * 1852.0 * 1.5);
  const std::uint64_t version = played.host.settings_version();
  EXPECT_EQ(played.host.apply(set, "output").code(), wire::Reply::OK);
  EXPECT_GT(played.host.settings_version(), version);
  EXPECT_EQ(played.host.settings(0, *view).instrumented_range_m(), 6.0 * 1852.0 * 1.5);
  played.host.start();
  await([&] { return !played.state().playing(); });
  ASSERT_EQ(output->count(), 256u);
  EXPECT_DOUBLE_EQ(output->spokes()[9].header.reach().in_metres(), 6.0 * 1852.0 * 1.5);
  EXPECT_DOUBLE_EQ(played.watched.spokes()[9].header.reach().in_metres(), 6.0 * 1852.0);
  set.set_instrumented_range_m(1e9);
  EXPECT_EQ(played.host.apply(set, "output").code(), wire::Reply::OUT_OF_RANGE);
}

TEST(PlaybackHost, WhatWasRecordedCannotBeChanged) {
  Played played;
  wire::Set set;
  set.set_gain(50.0);
  EXPECT_EQ(played.host.apply(set, "console").code(), wire::Reply::REFUSED);
  EXPECT_THAT(played.host.apply(set, "console").text(), HasSubstr("a recording is played"));
  set.set_gain(played.host.settings(0, 0).gain());
  set.set_transmit(true);
  EXPECT_EQ(played.host.apply(set, "display").code(), wire::Reply::OK) << "so it is already";
  set.set_course_deg(0.0);
  EXPECT_EQ(played.host.apply(set, "display").code(), wire::Reply::REFUSED);
  set.Clear();
  set.set_transmit(false);
  EXPECT_EQ(played.host.apply(set, "display").code(), wire::Reply::REFUSED);
  set.Clear();
  set.set_instrumented_range_m(10'000.0);
  EXPECT_EQ(played.host.apply(set, "console").code(), wire::Reply::REFUSED) << "of the shared view";
  set.set_radar(9);
  EXPECT_EQ(played.host.apply(set, "console").code(), wire::Reply::UNKNOWN);
  EXPECT_TRUE(played.host.drive(0, {}));
}

TEST(PlaybackHost, ALossInTheRecordingIsOneForTheConsole) {
  RecordedScene scene{.turns = 2};
  scene.change = [](Spoke& spoke) { return spoke.header.index < 100 || spoke.header.index >= 110; };
  Played played(scene, kFast);
  played.host.start();
  await([&] { return !played.state().playing(); });
  const auto spokes = played.watched.spokes();
  ASSERT_EQ(spokes.size(), 2u * 246);
  EXPECT_EQ(spokes[100].header.sequence, spokes[99].header.sequence + 11);
}

TEST(PlaybackHost, GeometryAndRangeMayChangeWithinARecording) {
  RecordedScene scene{.turns = 4, .settings = false};
  scene.change = [](Spoke& spoke) {
    if (spoke.header.scan < 1002) return true;
    spoke.header.range_scale = *RangeScale::find(3.0);
    spoke.header.geometry.cells = 200;
    spoke.cells.resize(200, 1);
    return true;
  };
  Played played(scene, kFast);
  EXPECT_EQ(played.host.settings(0, 0).range_nm(), 12.0) << "nothing known before the first spoke";
  played.host.start();
  await([&] { return !played.state().playing(); });
  EXPECT_EQ(played.watched.count(), 4u * 256);
  EXPECT_EQ(played.watched.spokes().back().cells.size(), 200u);
  EXPECT_EQ(played.host.settings(0, 0).range_nm(), 3.0);
}

TEST(PlaybackHost, WithCurrentTimestampsSpokesBearTheTimeOfTheirPlaying) {
  Played played({.turns = 2}, {.rate = 50.0, .current_timestamps = true});
  const auto before = std::chrono::system_clock::now();
  played.host.start();
  await([&] { return !played.state().playing(); });
  const auto spokes = played.watched.spokes();
  ASSERT_EQ(spokes.size(), 512u);
  EXPECT_GE(spokes.front().header.utc, before - 1s);
  EXPECT_LE(spokes.back().header.utc, std::chrono::system_clock::now() + 1s);
  for (std::size_t i = 1; i < spokes.size(); ++i) {
    ASSERT_GE(spokes[i].header.utc, spokes[i - 1].header.utc);
    ASSERT_GE(spokes[i].header.scenario_time, spokes[i - 1].header.scenario_time);
  }
  EXPECT_TRUE(played.state().current_timestamps());
}

TEST(PlaybackHost, ACutFileIsPlayedAsFarAsItGoesAndSaysSo) {
  const RecordedScene scene{.turns = 60};
  const RecordedFile file(scene);
  file.cut(file.size() * 2 / 3);
  PlaybackHost host(file.open(), kFast, "test");
  Watcher watched(*host.find_channel(0, 0));
  watched.join();
  EXPECT_THAT(host.playback()->state().problem(), HasSubstr("scene.mcap"));
  host.start();
  await([&] { return !host.playback()->state().playing(); });
  const auto spokes = watched.spokes();
  EXPECT_GT(spokes.size(), 20u * 256);
  EXPECT_LT(spokes.size(), 60u * 256);
  for (std::size_t i = 0; i < spokes.size(); ++i) {
    ASSERT_EQ(spokes[i].cells, recorded_spoke(scene, 0, 0, i).cells);
  }
}

TEST(PlaybackHost, HelloAndStatusSayThatItIsAPlayback) {
  Played played({}, kPaused);
  const wire::Hello hello = played.host.hello();
  EXPECT_TRUE(hello.playback());
  EXPECT_FALSE(hello.can_record());
  EXPECT_EQ(hello.radars(0).name(), "radar of ship 0");
  EXPECT_EQ(played.host.status().playback().file(), "scene.mcap");
  EXPECT_EQ(played.state().begin_utc_ns(),
            static_cast<std::uint64_t>(kRecordedAt.time_since_epoch().count()));
  EXPECT_NEAR(played.state().length_s(), 8.0, 0.01);
  EXPECT_EQ(played.host.find_channel(1, 0), nullptr);
  EXPECT_EQ(played.host.find_channel(0, 1), nullptr);
}

TEST(PlaybackHost, OrdersFromManyThreadsAtOnceEndInTheLastState) {
  Played played({.turns = 20});
  played.host.start();
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t) {
    threads.emplace_back([&played, t] {
      for (int i = 0; i < 25; ++i) {
        wire::Playback request;
        if (i % 5 == 0) request.set_position_s(t * 7.0 + i * 0.1);
        if (i % 7 == 0) request.set_step_turns(i % 3 - 1);
        request.set_rate(1.0 + i);
        played.ask(request);
        played.host.own_ship(0);
        played.host.settings(0, 0);
        played.host.traffic();
        played.state();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  wire::Playback request;
  request.set_playing(false);
  request.set_position_s(20.0);
  played.ask(request);
  await([&] { return played.watched.count() > 0; });
  EXPECT_EQ(played.state().position_s(), 20.0);
  Played::expect_growing(played.watched.spokes());
}

}  // namespace
}  // namespace skerry::server
