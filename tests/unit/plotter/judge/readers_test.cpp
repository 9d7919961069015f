// Tables and scans from outside: what is read, what is left out, what is refused.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>

#include "echo/chart/local_plane.hpp"
#include "protocol/nmea/sentence.hpp"
#include "server/plotter/judge/judging.hpp"
#include "server/plotter/judge/scans_jsonl.hpp"
#include "server/plotter/judge/tracks_csv.hpp"
#include "server/plotter/judge/truth_csv.hpp"

namespace skerry::server {
namespace {

using testing::HasSubstr;

template <typename Read>
std::string refusal(const Read& read) {
  try {
    read();
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

TEST(TruthCsv, HasTargetsAndOwnShipByTime) {
  const ReadTruth read = read_truth_csv(
      "utc_s,id,lat_deg,lon_deg,course_deg,speed_kn\r\n"
      "1700000001.5,\"a, the first\",60.1,5.2,90,12.5\r\n"
      "1700000000,\"a, the first\",60.0,5.0,,\r\n"
      "2023-11-14T22:13:20Z,own,59.9,4.9,0,0\r\n"
      "\r\n"
      "1700000000,b,60.3,185.0,,\r\n",
      "truth.csv");
  ASSERT_EQ(read.truth.targets.size(), 2u);
  const TruthTarget& a = read.truth.targets[0];
  EXPECT_EQ(a.id, "a, the first");
  ASSERT_EQ(a.points.size(), 2u);
  EXPECT_EQ(a.points[0].utc_s, 1700000000.0);
  EXPECT_FALSE(a.points[0].course_deg);
  EXPECT_EQ(a.points[1].speed_kn, 12.5);
  EXPECT_EQ(read.truth.targets[1].points[0].place.longitude_deg, -175.0);
  ASSERT_EQ(read.truth.own_ship.size(), 1u);
  EXPECT_EQ(read.truth.own_ship[0].utc_s, 1700000000.0);
  EXPECT_EQ(read.notes.used(), 4u);
  EXPECT_EQ(read.notes.left_out(), 0u);
  EXPECT_TRUE(a.looks.empty());
}

TEST(TruthCsv, TakesLooksWhereThereAreSome) {
  const ReadTruth read =
      read_truth_csv("seen,lon_deg,lat_deg,id,utc_s,more\n1,5,60,a,2,x\n0,5,60,a,1,y\n", "t.csv");
  ASSERT_EQ(read.truth.targets.at(0).looks.size(), 2u);
  EXPECT_FALSE(read.truth.targets[0].looks[0].seen);
  EXPECT_TRUE(read.truth.targets[0].looks[1].seen);
}

TEST(TruthCsv, LeavesOutWrongRowsAndSaysWhich) {
  const ReadTruth read = read_truth_csv(
      "utc_s,id,lat_deg,lon_deg\n1,a,60,5\n2,a,91,5\n3,,60,5\n4,a,60\nnever,a,60,5\n5,a,60,5\n",
      "t.csv");
  EXPECT_EQ(read.notes.used(), 2u);
  EXPECT_EQ(read.notes.left_out(), 4u);
  EXPECT_THAT(read.notes.text(), HasSubstr("first in line 3: lat_deg: expected a number from -90 "
                                           "to 90, found 91"));
}

TEST(TruthCsv, RefusesATableWithoutItsColumnsOrTargets) {
  EXPECT_THAT(refusal([] { (void)read_truth_csv("\nutc_s,id,lat,lon_deg\n", "dir/t.csv"); }),
              HasSubstr("dir/t.csv:2: no column lat_deg; expected a first line that names the "
                        "columns utc_s,id,lat_deg,lon_deg, found \"utc_s,id,lat,lon_deg\""));
  EXPECT_THAT(refusal([] { (void)read_truth_csv("", "t.csv"); }), HasSubstr("an empty file"));
  EXPECT_THAT(
      refusal([] { (void)read_truth_csv("utc_s,id,lat_deg,lon_deg\n1,own,60,5\n", "t.csv"); }),
      HasSubstr("t.csv:2: no target"));
}

constexpr std::string_view kTracks =
    "utc_s,radar,track,status,lat_deg,lon_deg,course_deg,speed_kn,range_nm,bearing_deg,cpa_nm,"
    "tcpa_min,place_sigma_m,hits,looks,by_hand,own_lat_deg,own_lon_deg\n"
    "1700000002.5,1,7,tracked,60.01,5.02,271.5,9.25,1.5,45,0.25,-3.5,12,9,10,0,60,5\n"
    "1700000000.0,1,7,tentative,60.00,5.02,,,1.5,45,,,12,9,10,0,60,5\n"
    "1700000005.0,1,7,lost,60.02,5.02,271.5,9.25,1.5,45,,,12,9,10,0,60,5\n";

TEST(TracksCsv, HasWhatSkerryTrackWrites) {
  const ReadTracks read = read_tracks_csv(kTracks, "tracks.csv");
  ASSERT_EQ(read.told.size(), 1u);
  EXPECT_EQ(read.told[0].name, "tracks.csv");
  ASSERT_EQ(read.told[0].tracks.size(), 1u);
  const ToldTrack& track = read.told[0].tracks[0];
  EXPECT_EQ(track.number, "7");
  ASSERT_EQ(track.points.size(), 3u);
  EXPECT_EQ(track.points[0].status, ToldStatus::tentative);
  EXPECT_FALSE(track.points[0].course_deg);
  EXPECT_EQ(track.points[1].course_deg, 271.5);
  EXPECT_EQ(track.points[1].speed_kn, 9.25);
  EXPECT_EQ(track.points[1].cpa_nm, 0.25);
  EXPECT_EQ(track.points[1].tcpa_min, -3.5);
  EXPECT_EQ(track.points[2].status, ToldStatus::lost);
}

TEST(TracksCsv, EachRadarIsATracker) {
  const ReadTracks read = read_tracks_csv(
      "utc_s,radar,track,status,lat_deg,lon_deg\n1,1,1,tracked,60,5\n1,2,1,tracked,60,5\n",
      "t.csv");
  ASSERT_EQ(read.told.size(), 2u);
  EXPECT_EQ(read.told[1].name, "t.csv (2)");
  EXPECT_EQ(read.told[1].tracks.size(), 1u);
}

TEST(TracksCsv, NothingToldIsATrackerToo) {
  const ReadTracks read = read_tracks_csv("utc_s,track,status,lat_deg,lon_deg\n", "t.csv");
  ASSERT_EQ(read.told.size(), 1u);
  EXPECT_TRUE(read.told[0].tracks.empty());
}

TEST(TracksCsv, SaysWhichStatusItDoesNotKnow) {
  const ReadTracks read = read_tracks_csv(
      "utc_s,track,status,lat_deg,lon_deg\n1,1,coasted,60,5\n2,1,tracked,60,5\n", "t.csv");
  EXPECT_EQ(read.notes.used(), 1u);
  EXPECT_THAT(read.notes.text(), HasSubstr("first in line 2: coasted"));
  EXPECT_THAT(refusal([] { (void)read_tracks_csv("utc_s,track,lat_deg,lon_deg\n", "t.csv"); }),
              HasSubstr("t.csv:1: no column status"));
}

TEST(ScansJsonl, HasPlotsAndTruthAndWhoWasSeen) {
  ScansRule rule;
  rule.origin = {60.0, 5.0};
  const ReadScans read = read_scans_jsonl(
      "{\"time\": 10.0, \"own_north_east\": [100, 50], \"plots\": [[200, -20], [5, 6]], "
      "\"targets\": [{\"id\": 1, \"time\": 10.0, \"north_east\": [310, 30]}]}\n"
      "{\"time\": 12.0, \"own_north_east\": [100, 50], \"plots\": [[200, -20]], "
      "\"targets\": [{\"id\": 1, \"time\": 12.0, \"north_east\": [320, 30]}]}\n",
      "scans.jsonl", rule);
  ASSERT_EQ(read.scans.size(), 2u);
  EXPECT_EQ(read.scans[0].plots[0], (PlanePoint{-20.0, 200.0}));
  const echo::LocalPlane plane(rule.origin);
  EXPECT_NEAR(plane.to_plane(read.scans[0].own_ship).north_m, 100.0, 0.01);
  ASSERT_EQ(read.truth.targets.size(), 1u);
  const TruthTarget& target = read.truth.targets[0];
  EXPECT_EQ(target.id, "1");
  ASSERT_EQ(target.looks.size(), 2u);
  EXPECT_TRUE(target.looks[0].seen);   // 10 m off
  EXPECT_FALSE(target.looks[1].seen);  // 20 m
  EXPECT_EQ(read.truth.own_ship.size(), 2u);
}

TEST(ScansJsonl, LeavesOutWhatIsNoScan) {
  const ReadScans read = read_scans_jsonl(
      "{\"time\": 1, \"own_north_east\": [0, 0], \"plots\": [[1, 2], [3], \"x\"]}\n"
      "not JSON\n{\"time\": \"late\"}\n{\"time\": 2, \"own_north_east\": [0, 1e9], \"plots\": "
      "[]}\n",
      "s.jsonl");
  EXPECT_EQ(read.scans.size(), 1u);
  EXPECT_EQ(read.scans[0].plots.size(), 1u);
  EXPECT_EQ(read.notes.left_out(), 5u);
  EXPECT_THAT(refusal([] { (void)read_scans_jsonl("[]\n", "s.jsonl"); }),
              HasSubstr("s.jsonl:1: no scan; expected lines like"));
}

TEST(ReadNotes, CountsKindsWithinBounds) {
  ReadNotes notes;
  for (std::size_t i = 0; i < 500; ++i) notes.leave_out("kind " + std::to_string(i), i + 1);
  EXPECT_EQ(notes.left_out(), 500u);
  EXPECT_LT(notes.text().size(), 4000u);
  EXPECT_THAT(notes.text(), HasSubstr("of other kinds"));
}

TEST(Judging, SaysWhatIsMissing) {
  const auto why = [](const JudgeRequest& request) {
    try {
      (void)judge_trackers(request);
    } catch (const std::exception& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  JudgeRequest request;
  EXPECT_THAT(why(request), HasSubstr("no truth; expected a file of truth"));
  request.truth = "nowhere/truth.csv";
  EXPECT_THAT(why(request), HasSubstr("nothing to judge"));
  request.told = {"nowhere/tracks.csv"};
  EXPECT_THAT(why(request), HasSubstr("cannot read nowhere/truth.csv: No such file"));
  request.baselines = {"radar_pi"};
  EXPECT_THAT(why(request), HasSubstr("baselines need scans"));
  request.baselines = {"best"};
  EXPECT_THAT(why(request), HasSubstr("no baseline \"best\"; expected skerry, radar_pi, mayara"));
}

TEST(Judging, GoesFromFilesToScores) {
  const std::filesystem::path folder =
      std::filesystem::path(testing::TempDir()) / "skerry_judge_files";
  std::filesystem::create_directories(folder);
  const auto write = [&](const char* name, std::string_view text) {
    std::ofstream(folder / name, std::ios::binary) << text;
    return (folder / name).string();
  };
  std::string truth = "utc_s,id,lat_deg,lon_deg\n", scans;
  for (int t = 0; t <= 20; ++t) {
    const std::string utc = std::to_string(1'700'000'000 + t);
    truth += utc + ",own,60,5\n" + utc + ",a,60.01,5.02\n";
    scans += "{\"time\": " + utc + ", \"own_north_east\": [0, 0], \"plots\": [[50, 80]], " +
             "\"targets\": [{\"id\": 1, \"time\": " + utc + ", \"north_east\": [50, 80]}]}\n";
  }
  JudgeRequest request;
  request.truth = write("truth.csv", truth);
  request.told = {
      write("tracks.csv", "utc_s,track,status,lat_deg,lon_deg\n1700000010,1,tracked,60.01,5.02\n"),
      write("log.nmea", "1700000005 $RATLL,07,6000.600,N,00501.200,E,x,,T,*" +
                            nmea::checksum_text("RATLL,07,6000.600,N,00501.200,E,x,,T,") + "\n")};
  request.rule.hold_s = 2.0;
  Judged judged = judge_trackers(request);
  ASSERT_EQ(judged.scores.size(), 2u);
  EXPECT_EQ(judged.notes.size(), 3u);
  EXPECT_EQ(judged.scores[0].name, request.told[0]);
  EXPECT_EQ(judged.scores[0].targets[0].initiation_s, 10.0);
  EXPECT_EQ(judged.scores[1].targets[0].initiation_s, 5.0);
  ASSERT_TRUE(judged.scores[1].targets[0].place_rms_m);
  EXPECT_LT(*judged.scores[1].targets[0].place_rms_m, 1.0);

  JudgeRequest with_scans;
  with_scans.scans = write("scans.jsonl", scans);
  with_scans.baselines = {"mayara", "radar_pi"};
  judged = judge_trackers(with_scans);
  ASSERT_EQ(judged.scores.size(), 2u);
  EXPECT_EQ(judged.scores[0].name, "mayara 2026's rules");
  EXPECT_EQ(judged.scores[0].targets[0].initiation_s, 5.0);  // tracked after 3 s: the next step
  EXPECT_EQ(judged.scores[1].targets[0].initiation_s, 5.0);
  std::filesystem::remove_all(folder);
}

TEST(Judging, KnowsATableFromALog) {
  EXPECT_TRUE(is_tracks_csv("", "a.csv"));
  EXPECT_TRUE(is_tracks_csv("utc_s,track,status\n", "tracks"));
  EXPECT_FALSE(is_tracks_csv("$RATTM,1,2,3\n", "a.nmea"));
}

}  // namespace
}  // namespace skerry::server
