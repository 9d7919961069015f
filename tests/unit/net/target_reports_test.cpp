// A plotter's lists as reports of ASTERIX.
#include "server/net/outputs/target_reports.hpp"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <initializer_list>
#include <utility>

#include "tests/unit/net/fake_plotters.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

constexpr std::uint64_t kSecond = 1'000'000'000;
constexpr double kSpeed_mps = 9.0 * 1852.0 / 3600.0;  // of FakePlotters::target(), going west

wire::Target in_state(std::uint32_t number, wire::TargetState state) {
  wire::Target target = FakePlotters::target(number, 1852.0);
  target.set_state(state);
  return target;
}

wire::TargetList list_of(std::initializer_list<wire::Target> targets) {
  wire::TargetList list;
  list.set_utc_ns((3 * 86'400 + 12 * 3'600) * kSecond);  // at noon
  for (const wire::Target& target : targets) *list.add_targets() = target;
  return list;
}

// The list told to somebody who knows none of it.
struct First {
  explicit First(wire::TargetList all) : list(std::move(all)), tracks(ToldTracks(4095).next(list)) {
    news.source = {25, 7};
    news.list = &list;
    news.tracks = tracks;
  }
  First(const First&) = delete;
  First& operator=(const First&) = delete;

  wire::TargetList list;
  std::vector<ReportedTrack> tracks;
  ReportedTargets news;
};

TEST(TargetReports, HaveATrackInTheWordsOfEachCategory) {
  wire::Target target = FakePlotters::target(7, 1852.0);
  target.set_age_s(1.5);
  target.set_tracked_s(20.0);
  target.set_place_sigma_m(8.0);
  target.set_speed_sigma_kn(1.0);
  target.set_length_m(60.0);
  const First first(list_of({target}));

  const auto polar = cat048_reports(first.news);
  ASSERT_EQ(polar.size(), 1u);
  EXPECT_EQ(polar[0].source, (AsterixSource{25, 7}));
  EXPECT_EQ(polar[0].time_of_day, Duration(12h));
  EXPECT_EQ(polar[0].detection, Cat048Detection::primary);
  EXPECT_EQ(polar[0].measured, (AsterixPolar{1852.0, 90.0}));
  EXPECT_EQ(polar[0].track_number, 7u);
  EXPECT_NEAR(polar[0].position->east_m, 1852.0, 1e-6);
  EXPECT_NEAR(polar[0].position->north_m, 0.0, 1e-6);
  EXPECT_NEAR(polar[0].velocity->speed_mps, kSpeed_mps, 1e-9);
  EXPECT_EQ(polar[0].velocity->course_deg, 270.0);
  EXPECT_EQ(polar[0].status, Cat048TrackStatus{});
  EXPECT_NEAR(polar[0].quality->course_deg, std::atan(1.0 / 9.0) * 180.0 / M_PI, 1e-9);

  const auto system = cat062_reports(first.news);
  ASSERT_EQ(system.size(), 1u);
  EXPECT_EQ(system[0].place, (GeoPoint{0.0, 1852.0 / 111'319.5}));
  EXPECT_NEAR(system[0].velocity->east, -kSpeed_mps, 1e-9);
  EXPECT_NEAR(system[0].velocity->north, 0.0, 1e-9);
  EXPECT_EQ(system[0].track_number, 7);
  EXPECT_EQ(system[0].status, Cat062TrackStatus{.is_new = true});
  EXPECT_EQ(system[0].track_age_s, 20.0);
  EXPECT_EQ(system[0].primary_age_s, 1.5);
  EXPECT_EQ(system[0].size, AsterixSize{.length_m = 60.0});
  EXPECT_EQ(system[0].position_deviation, (AsterixVector{8.0, 8.0}));

  const auto shore = cat010_reports(first.news);
  ASSERT_EQ(shore.size(), 3u) << "an update cycle, the system's state, a track";
  EXPECT_EQ(shore[0].kind, Cat010Kind::turn);
  EXPECT_EQ(shore[0].time_of_day, Duration(12h));
  EXPECT_EQ(shore[1].kind, Cat010Kind::periodic_status);
  EXPECT_EQ(shore[1].system_status, Cat010SystemStatus{});
  EXPECT_EQ(shore[2].kind, Cat010Kind::target);
  EXPECT_EQ(shore[2].place, system[0].place);
  EXPECT_EQ(shore[2].measured, polar[0].measured);
  EXPECT_EQ(shore[2].velocity, polar[0].velocity);
  EXPECT_EQ(shore[2].track_number, 7u);
  EXPECT_EQ(shore[2].status, Cat010TrackStatus{});
  EXPECT_EQ(shore[2].deviation, (Cat010Deviation{8.0, 8.0, 0.0}));
}

TEST(TargetReports, HaveNothingWhereTheListHasNothing) {
  wire::Target target = in_state(1, wire::TARGET_ACQUIRING);
  target.clear_course_deg();
  target.clear_speed_kn();
  wire::TargetList list = list_of({target});
  list.set_utc_ns(0);
  const First first(list);
  const Cat048Report polar = cat048_reports(first.news).at(0);
  EXPECT_FALSE(polar.time_of_day || polar.velocity || polar.quality);
  EXPECT_TRUE(polar.status->is_tentative);
  const Cat062Report system = cat062_reports(first.news).at(0);
  EXPECT_FALSE(system.velocity || system.size || system.position_deviation ||
               system.velocity_deviation);
  EXPECT_TRUE(system.status.is_tentative);
  const Cat010Report shore = cat010_reports(first.news).at(2);
  EXPECT_FALSE(shore.velocity || shore.plane_velocity || shore.size || shore.deviation);
  EXPECT_TRUE(shore.status->is_tentative);
  EXPECT_TRUE(cat048_reports({}).empty() && cat062_reports({}).empty() &&
              cat010_reports({}).empty());
}

TEST(TargetReports, HaveVelocitiesOverGroundAlone) {
  wire::TargetList list = list_of({FakePlotters::target(1, 1852.0)});
  list.set_stabilisation(wire::STABILISATION_WATER);
  const First first(list);
  EXPECT_FALSE(cat048_reports(first.news).at(0).velocity);
  EXPECT_FALSE(cat062_reports(first.news).at(0).velocity);
  EXPECT_FALSE(cat010_reports(first.news).at(2).velocity);
  EXPECT_FALSE(cat010_reports(first.news).at(2).plane_velocity);
}

TEST(TargetReports, AreExtrapolatedWhereATargetIsFrozenOrNotSeen) {
  wire::Target unseen = FakePlotters::target(2, 1852.0);
  unseen.set_age_s(5.5);
  wire::TargetList list = list_of({in_state(1, wire::TARGET_FROZEN), unseen});
  list.set_problem("no heading");
  const First first(list);
  for (const std::size_t i : {0u, 1u}) {
    EXPECT_EQ(cat048_reports(first.news).at(i).detection, Cat048Detection::none);
    EXPECT_TRUE(cat062_reports(first.news).at(i).status.is_coasting);
    EXPECT_EQ(cat010_reports(first.news).at(2 + i).status->extrapolation,
              Cat010Extrapolation::missed);
  }
  EXPECT_EQ(cat010_reports(first.news).at(1).system_status->release, 1) << "degraded";
}

TEST(TargetReports, MarkTestTargetsOrLeaveThemOut) {
  wire::Target test = FakePlotters::target(1'000'001, 1852.0);
  test.set_is_test(true);
  const First first(list_of({FakePlotters::target(1, 1852.0), test}));
  EXPECT_FALSE(cat048_reports(first.news).at(0).is_test);
  EXPECT_TRUE(cat048_reports(first.news).at(1).is_test);
  EXPECT_FALSE(cat010_reports(first.news).at(2).is_test);
  EXPECT_TRUE(cat010_reports(first.news).at(3).is_test);
  EXPECT_EQ(cat062_reports(first.news).size(), 1u);
}

TEST(TargetReports, HavePlotsBeforeTracksWithTimesOfTheirOwn) {
  wire::TargetPlots plots;
  wire::TargetPlot& plot = *plots.add_plots();
  plot.set_range_m(1000.0);
  plot.set_bearing_deg(359.5);
  plot.set_latitude_deg(60.0);
  plot.set_longitude_deg(5.0);
  plot.set_length_m(20.0);
  plot.set_width_m(30.0);
  plot.set_level(200);
  plot.set_utc_ns(86'400 * kSecond + kSecond / 2);
  First first(list_of({FakePlotters::target(1, 1852.0)}));
  first.news.plots = &plots;

  const auto polar = cat048_reports(first.news);
  ASSERT_EQ(polar.size(), 2u);
  EXPECT_EQ(polar[0].time_of_day, Duration(500ms));
  EXPECT_EQ(polar[0].measured, (AsterixPolar{1000.0, 359.5}));
  EXPECT_NEAR(polar[0].run_length_deg.value_or(0.0), 20.0 / 1000.0 * 180.0 / M_PI, 1e-3);
  EXPECT_FALSE(polar[0].track_number || polar[0].status || polar[0].velocity);
  EXPECT_TRUE(polar[1].track_number);

  const auto shore = cat010_reports(first.news);
  ASSERT_EQ(shore.size(), 4u);
  EXPECT_EQ(shore[2].place, (GeoPoint{60.0, 5.0}));
  EXPECT_EQ(shore[2].amplitude, 200);
  EXPECT_EQ(shore[2].size, AsterixSize{.length_m = 30.0});
  EXPECT_FALSE(shore[2].track_number);
  EXPECT_EQ(cat062_reports(first.news).size(), 1u) << "it has no plots";

  first.news.list = nullptr;
  EXPECT_EQ(cat048_reports(first.news).size(), 1u) << "plots may come without a list";
  EXPECT_EQ(cat010_reports(first.news).size(), 1u);
}

TEST(ToldTracks, EndALostTargetOnce) {
  ToldTracks told(4095);
  EXPECT_TRUE(told.next(list_of({in_state(3, wire::TARGET_LOST)})).empty()) << "nobody knows of it";
  auto tracks = told.next(list_of({in_state(7, wire::TARGET_TRACKED)}));
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_TRUE(tracks[0].is_new);
  tracks = told.next(list_of({in_state(7, wire::TARGET_TRACKED)}));
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_FALSE(tracks[0].is_new || tracks[0].is_ended);

  const wire::TargetList lost = list_of({in_state(7, wire::TARGET_LOST)});
  tracks = told.next(lost);
  ASSERT_EQ(tracks.size(), 1u);
  EXPECT_TRUE(tracks[0].is_ended);
  ReportedTargets news;
  news.list = &lost;
  news.tracks = tracks;
  EXPECT_TRUE(cat048_reports(news).at(0).status->is_ended);
  EXPECT_EQ(cat048_reports(news).at(0).detection, Cat048Detection::none);
  EXPECT_TRUE(cat062_reports(news).at(0).status.is_ended);
  EXPECT_TRUE(cat010_reports(news).at(2).status->is_ended);

  EXPECT_TRUE(told.next(lost).empty()) << "until its warning is acknowledged";
  EXPECT_TRUE(told.next(list_of({})).empty());
}

TEST(ToldTracks, EndATargetThatTheListHasNotAnyMore) {
  ToldTracks told(4095);
  told.next(list_of({FakePlotters::target(7, 900.0), FakePlotters::target(8, 1000.0)}));
  const auto tracks = told.next(list_of({FakePlotters::target(8, 1000.0)}));
  ASSERT_EQ(tracks.size(), 2u);
  EXPECT_EQ(tracks[1].number, 7u);
  EXPECT_TRUE(tracks[1].is_ended);
  EXPECT_EQ(tracks[1].target.range_m(), 900.0) << "where it was";
  EXPECT_EQ(told.next(list_of({FakePlotters::target(8, 1000.0)})).size(), 1u);
}

TEST(ToldTracks, WrapNumbersAndDoNotGiveOneTwice) {
  const auto number_of = [](ToldTracks& told, std::initializer_list<wire::Target> targets) {
    return told.next(list_of(targets)).back().number;
  };
  const auto target = [](std::uint32_t number) { return FakePlotters::target(number, 900.0); };
  ToldTracks twelve_bits(kMostCat048Track), sixteen_bits(kMostCat062Track);
  EXPECT_EQ(number_of(twelve_bits, {target(4095)}), 4095u);
  EXPECT_EQ(number_of(twelve_bits, {target(4095), target(4096)}), 1u);
  EXPECT_EQ(number_of(twelve_bits, {target(4095), target(4096), target(8190)}), 2u)
      << "4095 and 1 are told for others";
  twelve_bits.next(list_of({target(8190)}));
  EXPECT_EQ(number_of(twelve_bits, {target(8190)}), 2u) << "it keeps its number";
  EXPECT_EQ(number_of(sixteen_bits, {target(65'535)}), 65'535u);
  EXPECT_EQ(number_of(sixteen_bits, {target(65'535), target(65'536)}), 1u);
}

}  // namespace
}  // namespace skerry::server
