// A playback's reading of a file: radars, pieces, turns, what is in force, and what is asked of
// it.
#include <gmock/gmock.h>
#include <google/protobuf/descriptor.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

#include "protocol/recording/topics.hpp"
#include "protocol/wire/targets.pb.h"
#include "server/playback/piece_reader.hpp"
#include "server/playback/play_request.hpp"
#include "server/playback/recorded_radars.hpp"
#include "server/playback/turn_finder.hpp"
#include "server/relayed/relayed_state.hpp"
#include "server/relayed/values_in_range.hpp"
#include "tests/unit/playback/recorded_file.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using recording::Kind;
using recording::RecordingReader;
using recording::Topic;
using testing::HasSubstr;

RecordedRadars radars_in(const RecordingReader& reader) {
  auto radars = radars_of(reader);
  EXPECT_TRUE(radars.ok());
  return std::move(radars).value();
}

TEST(RelayedState, TakesTheKindsThatArePlayedButSpokes) {
  for (const recording::KindRow& row : recording::kind_rows()) {
    RelayedState state;
    EXPECT_EQ(state.take({row.kind}, kRecordedAt, {}, {}), row.is_played && row.kind != Kind::spoke)
        << row.topic;
  }
}

TEST(RecordedRadars, AreNumberedFromZeroAndSayWhatHelloSaid) {
  const RecordedFile file(RecordedScene{.radars = {1, 4}, .views = {0, 2}});
  const RecordingReader reader = file.open();
  const RecordedRadars radars = radars_in(reader);
  ASSERT_EQ(radars.radars.size(), 2u);
  EXPECT_EQ(radars.scenario, "recorded scene");
  EXPECT_EQ(radars.radars[0].recorded, 1u);
  EXPECT_EQ(radars.radars[1].recorded, 4u);
  EXPECT_EQ(radars.radars[1].info.radar(), 1u);
  EXPECT_EQ(radars.radars[1].info.name(), "radar of ship 4");
  EXPECT_FALSE(radars.radars[1].info.board()) << "there is no board to talk to";
  EXPECT_EQ(radars.radars[0].views, (std::vector<std::uint32_t>{0, 2}));
}

TEST(RecordedRadars, AreToldByTheFirstSpokesWithoutHello) {
  const RecordedFile file(
      RecordedScene{.spokes_per_turn = 512, .cells = 300, .views = {3}, .hello = false});
  const RecordingReader reader = file.open();
  const RecordedRadars radars = radars_in(reader);
  ASSERT_EQ(radars.radars.size(), 1u);
  const wire::RadarInfo& info = radars.radars[0].info;
  EXPECT_EQ(info.spokes_per_turn(), 512u);
  EXPECT_EQ(info.cells(), 300u);
  EXPECT_NEAR(info.rpm(), 30.0, 0.5);
  EXPECT_EQ(radars.radars[0].shared_view(), 3u);
}

TEST(RecordedRadars, AFileWithoutSpokesIsRefusedInWords) {
  const RecordedFile file([](recording::RecordingWriter& writer) {
    add(writer, {Kind::world, 0, 0}, kRecordedAt, wire::World());
  });
  const RecordingReader reader = file.open();
  const auto radars = radars_of(reader);
  ASSERT_FALSE(radars.ok());
  EXPECT_THAT(radars.error(), HasSubstr("no spokes"));
}

TEST(RecordedRadars, AFileWhoseOnlyVideoCannotBePlayedIsRefusedInWords) {
  const RecordedFile high_view(RecordedScene{.views = {70'000}});
  const RecordingReader one = high_view.open();
  ASSERT_FALSE(one.summary().items.empty());
  const auto of_one = radars_of(one);
  ASSERT_FALSE(of_one.ok());
  EXPECT_THAT(of_one.error(), HasSubstr("no spokes"));
  EXPECT_THAT(of_one.error(), HasSubstr("1 radars or views more"));

  // Only a radar beyond those that are played has a view that could be.
  const RecordedFile many([](recording::RecordingWriter& writer) {
    const RecordedScene scene;
    for (std::uint32_t radar = 0; radar < RecordedRadars::kMaxRadars; ++radar) {
      writer.add(recorded_spoke(scene, radar, 70'000, 0));
    }
    writer.add(recorded_spoke(scene, RecordedRadars::kMaxRadars, 0, 0));
  });
  const RecordingReader reader = many.open();
  const auto of_many = radars_of(reader);
  ASSERT_FALSE(of_many.ok());
  EXPECT_THAT(of_many.error(), HasSubstr("65 radars or views more"));
}

TEST(PieceReader, GivesEverySpokeOnceInItsOrderInSectors) {
  const RecordedScene scene{.turns = 3, .radars = {0, 1}};
  const RecordedFile file(scene);
  const RecordingReader reader = file.open();
  const RecordedRadars radars = radars_in(reader);
  PieceReader pieces(reader, radars);
  pieces.set_span(1s);
  std::uint64_t next[2] = {0, 0};
  std::size_t own_ships = 0;
  UtcTime last{};
  while (const auto piece = pieces.next()) {
    EXPECT_GE(piece->time, last - 1s);
    last = piece->time;
    own_ships += piece->topic.kind == Kind::own_ship;
    EXPECT_LE(piece->spokes.size(), PieceReader::kMostSpokes);
    for (const OwnSpokePtr& spoke : piece->spokes) {
      const Spoke wanted = recorded_spoke(scene, piece->topic.radar, 0, next[piece->topic.radar]++);
      EXPECT_EQ(spoke->cells, wanted.cells);
      EXPECT_EQ(spoke->header.utc, wanted.header.utc);
      EXPECT_EQ(spoke->header.sequence, wanted.header.sequence);
    }
  }
  EXPECT_EQ(next[0], 3u * 256);
  EXPECT_EQ(next[1], 3u * 256);
  EXPECT_EQ(own_ships, 12u);
  EXPECT_EQ(pieces.faults(), 0u);
}

TEST(PieceReader, StopsBeforeAMomentAndGoesOnFromThere) {
  const RecordedScene scene;
  const RecordedFile file(scene);
  const RecordingReader reader = file.open();
  const RecordedRadars radars = radars_in(reader);
  PieceReader pieces(reader, radars);
  pieces.seek(kRecordedAt + 1s);
  std::vector<std::uint64_t> sequences;
  const auto take = [&](std::optional<UtcTime> until) {
    while (const auto piece = pieces.next(until)) {
      EXPECT_TRUE(!until || piece->time < *until);
      for (const OwnSpokePtr& spoke : piece->spokes) sequences.push_back(spoke->header.sequence);
    }
  };
  take(kRecordedAt + 3s);
  ASSERT_EQ(sequences.size(), 256u);
  EXPECT_EQ(sequences.front(), scene.first_sequence + 128);
  take(std::nullopt);
  ASSERT_EQ(sequences.size(), 256u * 4 - 128);
  for (std::size_t i = 1; i < sequences.size(); ++i) {
    EXPECT_EQ(sequences[i], sequences[i - 1] + 1);
  }
}

TEST(PieceReader, LeavesOutWhatIsNoSpokeAndSaysSo) {
  const RecordedFile file([](recording::RecordingWriter& writer) {
    const RecordedScene scene;
    for (std::uint64_t n = 0; n < 4; ++n) writer.add(recorded_spoke(scene, 0, 0, n));
    wire::Spoke bad;
    bad.set_cell_count(5);
    add(writer, {Kind::spoke, 0, 0}, kRecordedAt + 1s, bad);
    const std::uint8_t junk[] = {0xFF, 0xFF, 0xFF};
    writer.add(recording::Item{{Kind::spoke, 0, 0}, kRecordedAt + 2s, junk});
  });
  const RecordingReader reader = file.open();
  const RecordedRadars radars = radars_in(reader);
  PieceReader pieces(reader, radars);
  std::size_t spokes = 0;
  while (const auto piece = pieces.next()) spokes += piece->spokes.size();
  EXPECT_EQ(spokes, 4u);
  EXPECT_EQ(pieces.faults(), 2u);
  EXPECT_THAT(pieces.problem(), HasSubstr("2 spokes cannot be read"));
}

TEST(PieceReader, LeavesOutRadarsThatAreNotPlayed) {
  const RecordedFile file(RecordedScene{.turns = 1});
  const RecordingReader reader = file.open();
  PieceReader pieces(reader, RecordedRadars{});
  while (const auto piece = pieces.next()) EXPECT_FALSE(is_of_a_radar(piece->topic.kind));
}

class Turns : public testing::Test {
 protected:
  TurnFinder finder(double rpm = 30.0) { return {reader_, {Kind::spoke, 0, 0}, rpm}; }
  UtcTime begin_of(int turn) const { return kRecordedAt + 2s * turn; }

  const RecordedScene scene_{.spokes_per_turn = 128, .turns = 200};
  const RecordedFile file_{scene_};
  const RecordingReader reader_ = file_.open();
};

TEST_F(Turns, ATurnBeforeAPlaceIsWhole) {
  TurnFinder turns = finder();
  for (const auto& [place, from] :
       {std::pair{begin_of(10), begin_of(9)}, std::pair{begin_of(10) + 1s, begin_of(9) + 1s},
        std::pair{begin_of(0) + 1s, begin_of(0)}, std::pair{begin_of(0), begin_of(0)}}) {
    EXPECT_NEAR(in_seconds(turns.turn_before(place) - from), 0.0, 0.02);
  }
}

TEST_F(Turns, AreFoundOnAndBackFromWithinAndFromTheBeginOfOne) {
  // However wrong the first guess of the rate.
  for (const double rpm : {30.0, 24.0, 45.0}) {
    TurnFinder turns = finder(rpm);
    for (const int steps : {1, 2, 3, 7, 50, 150}) {
      EXPECT_EQ(turns.turn_from(begin_of(20), steps), begin_of(20 + steps)) << steps;
      EXPECT_EQ(turns.turn_from(begin_of(20) + 700ms, steps), begin_of(20 + steps)) << steps;
      EXPECT_EQ(turns.turn_from(begin_of(180), -steps), begin_of(180 - steps)) << steps;
      EXPECT_EQ(turns.turn_from(begin_of(180) + 700ms, -steps), begin_of(181 - steps)) << steps;
    }
  }
}

TEST_F(Turns, BeyondTheRecordingThereIsNone) {
  TurnFinder turns = finder();
  EXPECT_EQ(turns.turn_from(begin_of(190), 20), std::nullopt);
  EXPECT_EQ(turns.turn_from(begin_of(190), 1000), std::nullopt);
  EXPECT_EQ(turns.turn_from(begin_of(5), -20), std::nullopt);
  EXPECT_EQ(turns.turn_from(reader_.summary().end, -1), begin_of(199));
}

TEST(TurnFinder, ATurnThatBeganInStandbyBeginsWithTheFirstVideo) {
  RecordedScene scene{.spokes_per_turn = 128, .turns = 40};
  scene.change = [&](Spoke& spoke) {
    const auto turn = spoke.header.scan - 1000;
    return turn < 10 || turn >= 30;
  };
  const RecordedFile file(scene);
  const RecordingReader reader = file.open();
  TurnFinder turns(reader, {Kind::spoke, 0, 0}, 30.0);
  EXPECT_EQ(turns.turn_from(kRecordedAt + 62s, -5), kRecordedAt + 60s);
  EXPECT_EQ(turns.turn_from(kRecordedAt + 18s, 1), kRecordedAt + 60s);
  EXPECT_EQ(turns.turn_before(kRecordedAt + 50s), kRecordedAt + 50s) << "an empty screen";
}

// A file may hold any time; the build with UBSan looks on.
TEST(TurnFinder, TimesBeyondAllBoundsDoNotOverflow) {
  RecordedScene scene{.spokes_per_turn = 128, .turns = 4};
  scene.change = [](Spoke& spoke) {
    const std::int64_t after = (spoke.header.utc - kRecordedAt).count();
    const auto most = std::numeric_limits<std::int64_t>::max();
    spoke.header.utc = UtcTime(Duration(most - 8'000'000'000 + after));
    return true;
  };
  const RecordedFile file(scene);
  const RecordingReader reader = file.open();
  EXPECT_EQ(reader.summary().end, recording::kLatestTime);
  EXPECT_TRUE(reader.last_before({Kind::spoke, 0, 0}, recording::kLatestTime));
  TurnFinder turns(reader, {Kind::spoke, 0, 0}, 5.0);
  EXPECT_TRUE(turns.turns_at(reader.summary().end));
  for (const int steps : {-1000, -1, 1, 1000}) {
    const auto found = turns.turn_from(reader.summary().end, steps);
    EXPECT_LE(found.value_or(UtcTime()), recording::kLatestTime);
  }
  PieceReader pieces(reader, radars_in(reader));
  pieces.set_span(4s);
  std::size_t spokes = 0;
  while (const auto piece = pieces.next()) spokes += piece->spokes.size();
  EXPECT_EQ(spokes, 4u * 128);
}

TEST(TurnFinder, ScansBeyondAllBoundsDoNotOverflow) {
  for (const std::uint32_t leap : {0x20000000U, 0x40000000U, 0x80000000U, 0xE0000000U}) {
    RecordedScene scene{.spokes_per_turn = 128, .turns = 4};
    scene.change = [leap](Spoke& spoke) {
      spoke.header.scan = (spoke.header.scan - 1000) * leap;
      return true;
    };
    const RecordedFile file(scene);
    const RecordingReader reader = file.open();
    TurnFinder turns(reader, {Kind::spoke, 0, 0}, 5.0);
    for (const int steps : {-1000, -1, 1, 1000}) {
      for (const Duration place : {1s, 3s, 5s, 7s}) {
        const auto found = turns.turn_from(kRecordedAt + place, steps);
        EXPECT_LE(found.value_or(kRecordedAt), reader.summary().end);
      }
    }
  }
}

TEST(RelayedState, ShipsSailOnBetweenItems) {
  RelayedState state;
  wire::OwnShip ship;
  ship.set_latitude_deg(60.0);
  ship.set_speed_over_ground_kn(60.0);
  ship.set_rate_of_turn_deg_min(60.0);
  ship.set_heading_deg(359.5);
  const std::string bytes = ship.SerializeAsString();
  ASSERT_TRUE(state.take({Kind::own_ship, 0, 0}, kRecordedAt,
                         {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, {}));
  const wire::OwnShip later = state.own_ship(0, kRecordedAt + 2s, {});
  EXPECT_NEAR(later.latitude_deg(), 60.0 + 2.0 / 3600.0, 1e-9);  // a mile a minute
  EXPECT_NEAR(later.heading_deg(), 1.5, 1e-9);
  EXPECT_EQ(later.utc_ns(),
            static_cast<std::uint64_t>((kRecordedAt + 2s).time_since_epoch().count()));
  const wire::OwnShip much_later = state.own_ship(0, kRecordedAt + 1h, UtcTime(5s));
  EXPECT_NEAR(much_later.latitude_deg(), 60.0 + 3.0 / 3600.0, 1e-9) << "no item any more";
  EXPECT_EQ(much_later.utc_ns(), 5'000'000'000u);
}

TEST(RelayedState, WithoutItemsTheSpokesTellWhatTheyCan) {
  RelayedState state;
  Spoke spoke = recorded_spoke({}, 0, 0, 0);
  const std::uint64_t before = state.settings_version();
  state.take(spoke.header);
  EXPECT_GT(state.settings_version(), before);
  EXPECT_EQ(state.settings(0, 0).range_nm(), 6.0);
  EXPECT_EQ(state.own_ship(0, kRecordedAt, {}).latitude_deg(), 60.25);
  EXPECT_EQ(state.own_ship(0, kRecordedAt, {}).heading_deg(), 90.0);
  EXPECT_FALSE(state.own_ship(0, kRecordedAt, {}).no_position());
  EXPECT_FALSE(state.own_ship(0, kRecordedAt, {}).no_heading());
  EXPECT_TRUE(state.own_ship(0, kRecordedAt, {}).no_motion());
}

TEST(RelayedState, WhatNobodyToldIsNotKnown) {
  RelayedState state;
  EXPECT_TRUE(state.own_ship(0, kRecordedAt, {}).no_position());
  EXPECT_TRUE(state.own_ship(0, kRecordedAt, {}).no_heading());
  Spoke spoke = recorded_spoke({}, 0, 0, 0);
  spoke.header.own_ship = {};
  state.take(spoke.header);
  EXPECT_TRUE(state.own_ship(0, kRecordedAt, {}).no_position());
  wire::OwnShip ship;
  ship.set_no_position(true);
  ship.set_speed_over_ground_kn(60.0);
  const std::string bytes = ship.SerializeAsString();
  ASSERT_TRUE(state.take({Kind::own_ship, 0, 0}, kRecordedAt,
                         {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()}, {}));
  const wire::OwnShip later = state.own_ship(0, kRecordedAt + 2s, {});
  EXPECT_TRUE(later.no_position());
  EXPECT_EQ(later.latitude_deg(), 0.0);
  EXPECT_FALSE(later.no_motion() || later.no_heading());
}

TEST(RecordedValues, EveryNumberHasARange) {
  for (const google::protobuf::Descriptor* message : {wire::Settings::descriptor(),
                                                      wire::OwnShip::descriptor(),
                                                      wire::ConState::descriptor(),
                                                      wire::World::descriptor(),
                                                      wire::RainCell::descriptor(),
                                                      wire::RadarInfo::descriptor(),
                                                      wire::BlankedSectors::Sector::descriptor(),
                                                      recording::Traffic::Item::descriptor(),
                                                      wire::ExerciseState::descriptor(),
                                                      wire::ExerciseShip::descriptor(),
                                                      wire::ExerciseMark::descriptor(),
                                                      wire::PlayedMark::descriptor(),
                                                      wire::Waypoint::descriptor(),
                                                      wire::Faults::descriptor(),
                                                      wire::TargetList::descriptor(),
                                                      wire::Target::descriptor(),
                                                      wire::PastPlace::descriptor(),
                                                      wire::AisTarget::descriptor(),
                                                      wire::TargetZone::descriptor(),
                                                      wire::TargetRules::descriptor(),
                                                      wire::Trial::descriptor(),
                                                      wire::Trial::Outcome::descriptor(),
                                                      wire::TrialOrder::descriptor(),
                                                      wire::TargetPlots::descriptor(),
                                                      wire::TargetPlot::descriptor()}) {
    for (int i = 0; i < message->field_count(); ++i) {
      const auto& field = *message->field(i);
      if (field.cpp_type() != google::protobuf::FieldDescriptor::CPPTYPE_DOUBLE) continue;
      EXPECT_TRUE(has_range(field)) << message->name() << "." << field.name();
    }
  }
}

TEST(RecordedValues, HostileOnesAreBroughtIntoRange) {
  wire::Settings settings;
  settings.set_gain(1e300);
  settings.set_sea(std::numeric_limits<double>::quiet_NaN());
  settings.set_rain(-5.0);
  settings.set_mode(static_cast<wire::PictureMode>(99));
  for (int i = 0; i < 5000; ++i) settings.add_locked(std::string(1000, 'x'));
  settings.mutable_blanked_sectors()->add_sectors()->set_from_deg(
      -std::numeric_limits<double>::infinity());
  bring_into_range(settings);
  EXPECT_EQ(settings.gain(), 100.0);
  EXPECT_EQ(settings.sea(), 0.0);
  EXPECT_EQ(settings.rain(), 0.0);
  EXPECT_EQ(settings.mode(), wire::CUSTOM);
  EXPECT_EQ(settings.locked_size(), kLongestList);
  EXPECT_EQ(settings.locked(0).size(), kLongestText);
  EXPECT_EQ(settings.blanked_sectors().sectors(0).from_deg(), 0.0);
}

class Request : public testing::Test {
 protected:
  Request() {
    summary_.begin = kRecordedAt;
    summary_.end = kRecordedAt + 100s;
    summary_.marks = {{kRecordedAt + 10s, "departure", ""}, {kRecordedAt + 90s, "departure", ""}};
  }
  PlayOrder order() const {
    auto order = play_order(request_, summary_);
    EXPECT_TRUE(order.ok());
    return order.ok() ? *order : PlayOrder{};
  }
  wire::Reply refusal() const {
    const auto order = play_order(request_, summary_);
    EXPECT_FALSE(order.ok());
    return order.ok() ? wire::Reply{} : order.error();
  }
  wire::Playback request_;
  recording::Summary summary_;
};

TEST_F(Request, BecomesAnOrder) {
  request_.set_playing(true);
  request_.set_rate(100.0);
  request_.set_loop(true);
  request_.set_position_s(100.0);
  EXPECT_EQ(order().playing, true);
  EXPECT_EQ(order().rate, 100.0);
  EXPECT_EQ(order().loop, true);
  EXPECT_EQ(order().seek, kRecordedAt + 100s);
}

TEST_F(Request, AMarkIsTheFirstOfItsName) {
  request_.set_mark("departure");
  EXPECT_EQ(order().seek, kRecordedAt + 10s);
  request_.set_mark("arrival");
  EXPECT_EQ(refusal().code(), wire::Reply::UNKNOWN);
  EXPECT_THAT(refusal().text(), HasSubstr("its marks: \"departure\""));
}

TEST_F(Request, NumbersOutOfRangeAreRefusedByName) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double rate : {0.0, 0.09, 100.1, -1.0, nan}) {
    request_.Clear();
    request_.set_rate(rate);
    EXPECT_THAT(refusal().text(), HasSubstr("rate")) << rate;
  }
  for (const double position : {-0.1, 100.1, 1e300, nan}) {
    request_.Clear();
    request_.set_position_s(position);
    EXPECT_THAT(refusal().text(), HasSubstr("100 s long")) << position;
  }
  request_.Clear();
  request_.set_step_turns(1001);
  EXPECT_EQ(refusal().code(), wire::Reply::OUT_OF_RANGE);
}

TEST_F(Request, AStepEndsInAPauseSoItDoesNotPlay) {
  request_.set_step_turns(-3);
  EXPECT_EQ(order().steps, -3);
  request_.set_playing(true);
  EXPECT_THAT(refusal().text(), HasSubstr("ends in a pause"));
}

}  // namespace
}  // namespace skerry::server
