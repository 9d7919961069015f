// Targets of others' trackers out of sentences.
#include "server/plotter/judge/target_log.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <stdexcept>
#include <string>

#include "echo/chart/local_plane.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/nmea/tracked_target_data.hpp"

namespace skerry::server {
namespace {

constexpr GeoPoint kOwn{60.0, 5.0};
constexpr double kNoon_s = 1'700'049'600.0;  // 2023-11-15 12:00:00 UTC

UtcTime utc(double s) { return UtcTime(seconds_as_duration(s)); }

std::string rmc(double s) {
  nmea::Rmc rmc;
  rmc.utc = utc(s);
  rmc.position = kOwn;
  return nmea::encode(rmc);
}

nmea::Ttm ttm(unsigned number, double of_day_s) {
  nmea::Ttm out;
  out.number = number;
  out.range_nm = 1.0;
  out.bearing_deg = 90.0;
  out.speed_kn = 12.0;
  out.course_deg = 180.0;
  out.cpa_nm = 0.5;
  out.tcpa_min = 4.0;
  out.time_of_day = seconds_as_duration(of_day_s);
  return out;
}

std::string with_checksum(const std::string& between) {
  return "$" + between + "*" + nmea::checksum_text(between) + "\r\n";
}

TEST(TargetLog, PlacesRangesAndBearingsFromOwnShip) {
  const ReadTargets read = read_target_log(
      rmc(kNoon_s) + nmea::encode(ttm(3, 43'201.0)) + rmc(kNoon_s + 2.0), "log", {});
  ASSERT_EQ(read.told.tracks.size(), 1u);
  EXPECT_EQ(read.told.tracks[0].number, "3");
  const ToldPoint& point = read.told.tracks[0].points.at(0);
  EXPECT_NEAR(point.utc_s, kNoon_s + 1.0, 1e-3);
  const PlanePoint place = echo::LocalPlane(kOwn).to_plane(point.place);
  EXPECT_NEAR(place.east_m, 1852.0, 0.1);
  EXPECT_NEAR(place.north_m, 0.0, 0.1);
  EXPECT_EQ(point.speed_kn, 12.0);
  EXPECT_EQ(point.course_deg, 180.0);
  EXPECT_EQ(point.cpa_nm, 0.5);
  EXPECT_EQ(point.tcpa_min, 4.0);
  EXPECT_EQ(point.status, ToldStatus::tracked);
  EXPECT_EQ(read.own_ship.size(), 2u);
}

TEST(TargetLog, TakesOwnShipAndTheDayFromTheTruthIfTheLogHasNone) {
  Truth truth;
  truth.own_ship = {{kNoon_s - 10.0, kOwn, {}, {}}, {kNoon_s + 10.0, kOwn, {}, {}}};
  const ReadTargets read = read_target_log(nmea::encode(ttm(3, 43'200.0)), "log", truth);
  EXPECT_NEAR(read.told.tracks.at(0).points.at(0).utc_s, kNoon_s, 1e-3);
  EXPECT_THROW((void)read_target_log(nmea::encode(ttm(3, 43'200.0)), "log", {}),
               std::runtime_error);
}

TEST(TargetLog, GoesOverMidnight) {
  const double midnight_s = kNoon_s + 43'200.0;
  const ReadTargets read = read_target_log(rmc(midnight_s - 2.0) + nmea::encode(ttm(3, 86'399.0)) +
                                               nmea::encode(ttm(3, 1.0)) + rmc(midnight_s + 2.0),
                                           "log", {});
  const auto& points = read.told.tracks.at(0).points;
  ASSERT_EQ(points.size(), 2u);
  EXPECT_NEAR(points[1].utc_s - points[0].utc_s, 2.0, 1e-3);
}

TEST(TargetLog, GoesBackOverMidnight) {
  const double midnight_s = kNoon_s + 43'200.0;
  const ReadTargets read =
      read_target_log(rmc(midnight_s + 0.5) + nmea::encode(ttm(3, 86'399.5)), "log", {});
  EXPECT_NEAR(read.told.tracks.at(0).points.at(0).utc_s, midnight_s - 0.5, 0.011);
}

TEST(TargetLog, TakesTheTimeOfTheLineIfTheSentenceHasNone) {
  nmea::Tll tll;
  tll.number = 9;
  tll.position = {60.1, 5.1};
  tll.status = nmea::TargetStatus::acquiring;
  const ReadTargets read =
      read_target_log("2023-11-15T12:00:07.5Z " + nmea::encode(tll), "log", {});
  const ToldPoint& point = read.told.tracks.at(0).points.at(0);
  EXPECT_NEAR(point.utc_s, kNoon_s + 7.5, 1e-3);
  EXPECT_NEAR(point.place.latitude_deg, 60.1, 1e-6);
  EXPECT_EQ(point.status, ToldStatus::tentative);
}

TEST(TargetLog, EmptyFieldsAreNotKnown) {
  const ReadTargets read = read_target_log(
      rmc(kNoon_s) + with_checksum("RATTM,04,1.000,90.0,T,,,T,,,N,,T,,120000.00,A"), "log", {});
  const ToldPoint& point = read.told.tracks.at(0).points.at(0);
  EXPECT_FALSE(point.speed_kn || point.course_deg || point.cpa_nm || point.tcpa_min);
}

TEST(TargetLog, TtmAndTllOfOneStateAreOnePoint) {
  nmea::Tll tll;
  tll.number = 3;
  tll.position = {60.0, 5.0333};
  tll.time_of_day = seconds_as_duration(43'201.0);
  const ReadTargets read =
      read_target_log(rmc(kNoon_s) + nmea::encode(ttm(3, 43'201.0)) + nmea::encode(tll), "log", {});
  const auto& points = read.told.tracks.at(0).points;
  ASSERT_EQ(points.size(), 1u);
  EXPECT_NEAR(points[0].place.longitude_deg, 5.0333, 1e-6);
  EXPECT_EQ(points[0].speed_kn, 12.0);
}

TEST(TargetLog, ANumberThatIsUsedAgainIsAnotherTrack) {
  nmea::Ttm lost = ttm(3, 43'205.0);
  lost.status = nmea::TargetStatus::lost;
  std::string log = rmc(kNoon_s) + nmea::encode(ttm(3, 43'201.0)) + nmea::encode(lost) +
                    nmea::encode(ttm(3, 43'210.0)) + rmc(kNoon_s + 10.0);
  for (int s = 10; s <= 80; s += 10) log += rmc(kNoon_s + s);
  log += nmea::encode(ttm(3, 43'275.0));
  const ReadTargets read = read_target_log(log, "log", {});
  ASSERT_EQ(read.told.tracks.size(), 3u);
  EXPECT_EQ(read.told.tracks[1].number, "3/2");
  EXPECT_EQ(read.told.tracks[0].points.back().status, ToldStatus::lost);
}

TEST(TargetLog, ReadsManyTargetsOfOneSentence) {
  std::array<nmea::TtdTarget, 2> targets;
  targets[0].number = 1;
  targets[0].bearing_deg = 0.0;
  targets[0].range_nm = 2.0;
  targets[1].number = 2;
  targets[1].status = nmea::TtdStatus::acquiring;
  std::string log = rmc(kNoon_s);
  for (const std::string& line : nmea::encode_ttd(targets, 0)) log += line;
  const ReadTargets read = read_target_log(log, "log", {});
  ASSERT_EQ(read.told.tracks.size(), 1u);
  const PlanePoint place = echo::LocalPlane(kOwn).to_plane(read.told.tracks[0].points.at(0).place);
  EXPECT_NEAR(place.north_m, 3704.0, 1.0);
  EXPECT_EQ(read.notes.left_out("TTD targets without a place"), 1u);
}

TEST(TargetLog, CountsWhatItCannotUse) {
  std::string broken = nmea::encode(ttm(3, 43'201.0));
  broken[10] = broken[10] == '9' ? '8' : '9';
  const ReadTargets read =
      read_target_log(rmc(kNoon_s) + broken + "no sentence\n" +
                          with_checksum("RATTM,04,1.000,90.0,R,,,T,,,N,,T,,120000.00,A") +
                          with_checksum("GPGSV,1,1,00") + nmea::encode(ttm(5, 43'201.0)),
                      "log", {});
  EXPECT_EQ(read.told.tracks.size(), 1u);
  EXPECT_EQ(read.notes.left_out(), 4u);
  EXPECT_EQ(read.notes.left_out("sentences of other kinds"), 1u);
  EXPECT_EQ(read.notes.left_out("TTM malformed") + read.notes.left_out("TTM out of range"), 1u)
      << read.notes.text();
}

TEST(TargetLog, RefusesALogWithoutTargets) {
  try {
    (void)read_target_log(rmc(kNoon_s), "quiet.nmea", {});
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("quiet.nmea:1: no target; expected TTM"));
  }
}

}  // namespace
}  // namespace skerry::server
