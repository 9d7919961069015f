// Real radars beside simulated ones: numbers, views, what is refused.
#include "server/live/live_host.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "protocol/asterix/cat240.hpp"
#include "server/app/joined_host.hpp"

namespace skerry::server {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

LiveSource cat240_source(std::uint32_t radar) {
  LiveSource source;
  source.kind = find_live_kind("cat240");
  source.radar = radar;
  source.at = Ipv4Endpoint{ipv4(239, 192, 43, 78), 4378};
  return source;
}

// The radars of another host, as far as JoinedHost asks for them.
class FakeSimulation final : public RadarHost {
 public:
  explicit FakeSimulation(std::uint32_t radars) : radars_(radars) {}
  wire::Hello hello() const override {
    wire::Hello hello;
    for (std::uint32_t radar = 0; radar < radars_; ++radar) {
      wire::RadarInfo& info = *hello.add_radars();
      info.set_radar(radar);
      info.set_name("simulated");
    }
    return hello;
  }
  std::uint32_t radar_count() const override { return radars_; }
  VideoChannelPtr find_channel(std::uint32_t, std::uint32_t view) override {
    return view == 1 ? opened : nullptr;
  }
  std::optional<std::uint32_t> open_view(
      std::uint32_t, std::uint32_t, bool,
      const std::function<void(VideoChannel&)>& prepare) override {
    opened = std::make_shared<VideoChannel>();
    prepare(*opened);
    return 1;
  }
  std::optional<std::string> drive(std::uint32_t radar, const OwnShipFix&) override {
    driven.push_back(radar);
    return std::nullopt;
  }
  std::optional<wire::ExerciseState> exercise_state() const override {
    wire::ExerciseState state;
    state.set_exercise_s(7.0);
    return state;
  }
  void find_coastline(const wire::GetCoastline&, CoastlineDone done) override {
    done(wire::Coastline());
  }
  bool has_chart() const override { return true; }
  void find_chart_objects(const wire::GetChartObjects&, ChartObjectsDone done) override {
    done(wire::ChartObjects());
  }
  void close_view(std::uint32_t, std::uint32_t) override {}
  std::vector<View> views(std::uint32_t) override { return {}; }
  std::uint64_t views_version() const override { return 1; }
  wire::Reply apply(const wire::Set& set, const std::string&) override {
    sets.push_back(set);
    return reply_of(wire::Reply::OK);
  }
  std::vector<TrafficItem> traffic() const override {
    TrafficItem own, target;
    own.number = 0;
    own.radars = {0};
    target.number = 1;
    return {own, target};
  }
  wire::Settings settings(std::uint32_t, std::uint32_t) const override { return {}; }
  wire::OwnShip own_ship(std::uint32_t) const override { return {}; }
  wire::World world() const override { return {}; }
  wire::Status status() const override {
    wire::Status status;
    for (std::uint32_t radar = 0; radar < radars_; ++radar) status.add_radars()->set_radar(radar);
    return status;
  }
  std::uint64_t settings_version() const override { return 1; }
  std::uint64_t world_version() const override { return 1; }

  std::vector<wire::Set> sets;
  std::vector<std::uint32_t> driven;
  std::shared_ptr<VideoChannel> opened;

 private:
  std::uint32_t radars_;
};

std::vector<std::string> names_of(const wire::Hello& hello) {
  std::vector<std::string> names;
  for (const wire::RadarInfo& info : hello.radars()) {
    names.push_back(std::to_string(info.radar()) + " " + info.name());
  }
  return names;
}

TEST(JoinedHost, ARealRadarTakesThePlaceOfItsNumber) {
  FakeSimulation simulated(3);
  LiveHost live({cat240_source(1)}, "test");
  JoinedHost joined(simulated, live);
  EXPECT_EQ(joined.radar_count(), 3u);
  EXPECT_THAT(names_of(joined.hello()), ElementsAre("0 simulated", "1 cat240", "2 simulated"));
  EXPECT_NE(joined.find_channel(1, 0), nullptr);
  EXPECT_EQ(joined.find_channel(0, 0), nullptr);
  EXPECT_EQ(joined.status().radars_size(), 3);
  EXPECT_EQ(joined.status().outputs(0).name(), "cat240_input");
  // The simulated one is silent.
  ASSERT_EQ(simulated.sets.size(), 1u);
  EXPECT_EQ(simulated.sets[0].radar(), 1u);
  EXPECT_FALSE(simulated.sets[0].transmit());
  EXPECT_TRUE(simulated.sets[0].has_transmit());
}

TEST(JoinedHost, OrHasTheNextNumberAndNoOther) {
  FakeSimulation simulated(2);
  LiveHost next({cat240_source(2)}, "test");
  EXPECT_EQ(JoinedHost(simulated, next).radar_count(), 3u);
  EXPECT_TRUE(simulated.sets.empty());
  LiveHost beyond({cat240_source(4)}, "test");
  try {
    JoinedHost joined(simulated, beyond);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("no radar 2 before it"));
    EXPECT_THAT(error.what(), HasSubstr("0 to 1"));
  }
}

TEST(JoinedHost, TheWorldIsChangedThroughARealRadarsConsoleToo) {
  FakeSimulation simulated(1);
  LiveHost live({cat240_source(0)}, "test");
  JoinedHost joined(simulated, live);
  simulated.sets.clear();
  wire::Set world;
  world.mutable_world()->set_sea_state(4);
  EXPECT_EQ(joined.apply(world, "test").code(), wire::Reply::OK);
  EXPECT_EQ(simulated.sets.size(), 1u);
  world.set_gain(3);
  EXPECT_EQ(joined.apply(world, "test").code(), wire::Reply::REFUSED);
  EXPECT_EQ(simulated.sets.size(), 1u);
}

TEST(JoinedHost, AShipAllOfWhoseRadarsAreRealIsNoSimulatedOne) {
  FakeSimulation simulated(1);
  LiveHost live({cat240_source(0)}, "test");
  const auto items = JoinedHost(simulated, live).traffic();
  ASSERT_EQ(items.size(), 1u);
  EXPECT_EQ(items[0].number, 1u);
}

TEST(JoinedHost, ASimulationIsLaidOverWhereItIsWanted) {
  FakeSimulation simulated(2);
  LiveSource over = cat240_source(1);
  over.simulated = true;
  LiveHost live({over, cat240_source(2)}, "test");
  JoinedHost joined(simulated, live);
  EXPECT_THAT(names_of(joined.hello()),
              ElementsAre("0 simulated", "1 cat240 + simulated", "2 cat240"));
  // It stays on the air, without noise of its own, and is computed.
  ASSERT_EQ(simulated.sets.size(), 1u);
  EXPECT_TRUE(simulated.sets[0].transmit());
  EXPECT_EQ(simulated.sets[0].noise_rejection(), 100.0);
  ASSERT_NE(simulated.opened, nullptr);
  EXPECT_TRUE(simulated.opened->format("laid over").has_readers());
  // Its own ship is where the real one's is.
  EXPECT_EQ(joined.drive(1, {}), std::nullopt);
  EXPECT_EQ(joined.drive(2, {}), std::nullopt);
  EXPECT_THAT(simulated.driven, ElementsAre(1u));
}

TEST(JoinedHost, NothingIsLaidOverARadarThatIsNotSimulated) {
  FakeSimulation simulated(1);
  LiveSource over = cat240_source(1);
  over.simulated = true;
  LiveHost live({over}, "test");
  try {
    JoinedHost joined(simulated, live);
    FAIL() << "accepted";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), HasSubstr("there are 0 to 0"));
  }
}

TEST(LiveHost, IsInStandbyUntilHeard) {
  LiveHost live({cat240_source(0)}, "test");
  EXPECT_TRUE(live.settings(0, 0).standby());
  EXPECT_TRUE(live.own_ship(0).no_position());
  EXPECT_TRUE(RangeScale::find(live.settings(0, 0).range_nm()).has_value());
}

TEST(LiveHost, RefusesControlsAndGrantsWhatIsSo) {
  LiveHost live({cat240_source(0)}, "test");
  wire::Set set;
  set.set_transmit(true);
  const wire::Reply reply = live.apply(set, "test");
  EXPECT_EQ(reply.code(), wire::Reply::REFUSED);
  EXPECT_THAT(reply.text(), HasSubstr("real one"));
  set.set_transmit(false);
  EXPECT_EQ(live.apply(set, "test").code(), wire::Reply::OK);
  set.set_radar(7);
  EXPECT_EQ(live.apply(set, "test").code(), wire::Reply::UNKNOWN);
}

TEST(LiveHost, AnOpenedViewHasItsOwnReach) {
  LiveHost live({cat240_source(0)}, "test");
  const auto view = live.open_view(0, 0, false, [](VideoChannel&) {});
  ASSERT_TRUE(view);
  wire::Set set;
  set.set_view(*view);
  set.set_instrumented_range_m(live.settings(0, *view).range_nm() * 1852.0 * 1.5);
  EXPECT_EQ(live.apply(set, "test").code(), wire::Reply::OK);
  EXPECT_NEAR(live.settings(0, *view).instrumented_range_m(), set.instrumented_range_m(), 1e-6);
  set.set_instrumented_range_m(1e9);
  EXPECT_EQ(live.apply(set, "test").code(), wire::Reply::OUT_OF_RANGE);
  live.close_view(0, *view);
}

TEST(JoinedHost, HasTheExerciseOfTheSimulationWhicheverRadarIsNamed) {
  FakeSimulation simulated(2);
  LiveHost live({cat240_source(0)}, "skerryd");
  JoinedHost joined(simulated, live);
  ASSERT_TRUE(joined.exercise_state());
  EXPECT_EQ(joined.exercise_state()->exercise_s(), 7.0);
  bool came = false;
  joined.find_coastline({}, [&](const auto& coastline) { came = coastline.has_value(); });
  EXPECT_TRUE(came);
  EXPECT_TRUE(joined.has_chart());
  came = false;
  joined.find_chart_objects({}, [&](const auto& objects) { came = objects.has_value(); });
  EXPECT_TRUE(came);
  simulated.sets.clear();  // one that puts the simulated radar to standby
  wire::Set set;
  set.set_instructor(true);
  set.mutable_exercise()->mutable_clock()->set_frozen(true);
  EXPECT_EQ(joined.apply(set, "console").code(), wire::Reply::OK) << "radar 0 is a real one";
  ASSERT_EQ(simulated.sets.size(), 1u);
  EXPECT_TRUE(simulated.sets.back().exercise().clock().frozen());
}

}  // namespace
}  // namespace skerry::server
