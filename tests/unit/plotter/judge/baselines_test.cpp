// Trackers after others' rules: that they do what their rules say, and what they make of a harbour.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "server/plotter/judge/baselines/mayara.hpp"
#include "server/plotter/judge/baselines/radar_pi.hpp"
#include "server/plotter/judge/own_tracker.hpp"
#include "server/plotter/judge/track_score.hpp"
#include "tests/unit/plotter/judge/made_scene.hpp"

namespace skerry::server {
namespace {

constexpr double kTurn_s = 2.5;

// Own ship lies still; `plots(i)` of the scan i.
template <typename Plots>
std::vector<DetectionScan> scans(int count, const Plots& plots, double turn_s = kTurn_s) {
  std::vector<DetectionScan> out;
  for (int i = 0; i < count; ++i)
    out.push_back({made::kBegin_s + i * turn_s, made::plane().anchor(), plots(i)});
  return out;
}

std::vector<ToldStatus> statuses(const ToldTrack& track) {
  std::vector<ToldStatus> out;
  for (const ToldPoint& point : track.points) out.push_back(point.status);
  return out;
}

std::size_t scan_of_first(const ToldTrack& track, ToldStatus status) {
  const auto all = statuses(track);
  return static_cast<std::size_t>(std::find(all.begin(), all.end(), status) - all.begin());
}

// North at 4 m/s, 200 m to the east.
std::vector<PlanePoint> mover(int i) { return {{200.0, 4.0 * kTurn_s * i}}; }
// The same until the tenth scan.
std::vector<PlanePoint> vanishing(int i) { return i < 10 ? mover(i) : std::vector<PlanePoint>{}; }
std::vector<PlanePoint> vanishing_buoy(int i) {
  return i < 10 ? std::vector<PlanePoint>{{200.0, 0.0}} : std::vector<PlanePoint>{};
}

TEST(RadarPiRules, TrackAfterSixScansAndLoseAfterFourMisses) {
  const Told told = baseline_radar_pi(scans(20, vanishing));
  ASSERT_EQ(told.tracks.size(), 1u);
  EXPECT_EQ(scan_of_first(told.tracks[0], ToldStatus::tracked), 5u);
  EXPECT_EQ(scan_of_first(told.tracks[0], ToldStatus::lost), 13u);
  EXPECT_EQ(told.tracks[0].points.size(), 14u);
  // At slower turns 8 s come first.
  const Told slow = baseline_radar_pi(scans(20, vanishing_buoy, 4.5));
  EXPECT_EQ(scan_of_first(slow.tracks[0], ToldStatus::lost), 11u);
}

TEST(RadarPiRules, FindTheMotionAndShowNoneThatIsNotSure) {
  const Told told = baseline_radar_pi(scans(30, mover));
  const ToldPoint& last = told.tracks[0].points.back();
  EXPECT_NEAR(*last.speed_kn, 4.0 / kKnot, 0.5);
  EXPECT_NEAR(*last.course_deg > 180.0 ? *last.course_deg - 360.0 : *last.course_deg, 0.0, 5.0);
  const Told still = baseline_radar_pi(scans(30, [](int i) {
    return std::vector<PlanePoint>{{200.0, i % 3 == 0 ? 1.5 : 0.0}};
  }));
  EXPECT_EQ(*still.tracks[0].points.back().speed_kn, 0.0);
}

TEST(RadarPiRules, AnEchoIsTakenOnceAndAHundredTargetsAreTheMost) {
  const Told crowd = baseline_radar_pi(scans(10, [](int) {
    std::vector<PlanePoint> plots;
    for (int i = 0; i < 120; ++i) plots.push_back({100.0 + 40.0 * i, 0.0});
    return plots;
  }));
  EXPECT_EQ(crowd.tracks.size(), 100u);
}

TEST(MayaraRules, TrackAfterFourEchoesAndLoseAfterThreeMisses) {
  const Told told = baseline_mayara(scans(20, vanishing));
  ASSERT_EQ(told.tracks.size(), 1u);
  EXPECT_EQ(scan_of_first(told.tracks[0], ToldStatus::tracked), 3u);
  EXPECT_EQ(scan_of_first(told.tracks[0], ToldStatus::lost), 12u);
}

// A turn after twenty straight scans: the filters that expect more noise take over.
TEST(MayaraRules, FindTheMotionAlsoAfterATurn) {
  const auto turning = [](int i) {
    const double north = 10.0 * std::min(i, 20), east = 200.0 + 10.0 * std::max(0, i - 20);
    return std::vector<PlanePoint>{{east, north}};
  };
  const Told told = baseline_mayara(scans(34, turning));
  ASSERT_EQ(told.tracks.size(), 1u);
  const ToldPoint &straight = told.tracks[0].points[20], &turned = told.tracks[0].points.back();
  EXPECT_NEAR(*straight.speed_kn, 4.0 / kKnot, 0.2);
  EXPECT_NEAR(*turned.course_deg, 90.0, 10.0);
}

TEST(MayaraRules, KeepWhoLiesStillForTenMisses) {
  const Told told = baseline_mayara(scans(30, vanishing_buoy));
  EXPECT_EQ(scan_of_first(told.tracks[0], ToldStatus::lost), 19u);
}

// 60 m apart with one course they become one; with opposite courses they stay two.
TEST(MayaraRules, MergeWhoGoTogether) {
  const auto together = [](int i) {
    return std::vector<PlanePoint>{{200.0, 10.0 * i}, {260.0, 10.0 * i}};
  };
  const auto apart = [](int i) {
    return std::vector<PlanePoint>{{200.0, 10.0 * i}, {260.0, 200.0 - 10.0 * i}};
  };
  const auto lost = [](const Told& told) {
    std::size_t count = 0;
    for (const ToldTrack& track : told.tracks)
      count += track.points.back().status == ToldStatus::lost ? 1 : 0;
    return count;
  };
  EXPECT_GE(lost(baseline_mayara(scans(20, together))), 1u);
  const Told two = baseline_mayara(scans(20, apart));
  EXPECT_EQ(lost(two), 0u);
  EXPECT_EQ(two.tracks.size(), 2u);
}

TEST(MayaraRules, AnEchoBehindAFastTrackIsAnother) {
  const auto jumping = [](int i) {
    return std::vector<PlanePoint>{{200.0, i < 10 ? 20.0 * i : 150.0}};
  };
  const Told told = baseline_mayara(scans(12, jumping));
  EXPECT_EQ(told.tracks.size(), 2u);
}

TEST(Baselines, AreTheSameEachTime) {
  const auto some = scans(15, vanishing);
  EXPECT_EQ(baseline_mayara(some).tracks[0].points.back().place,
            baseline_mayara(some).tracks[0].points.back().place);
  EXPECT_TRUE(baseline_radar_pi({}).tracks.empty());
  EXPECT_TRUE(baseline_mayara({}).tracks.empty());
}

// Worst values that were seen, with a margin: another tracker is compared with the figures that
// this prints.
TEST(Baselines, FollowTheBoatsOfARealHarbour) {
  const std::filesystem::path folder =
      std::filesystem::path(SKERRY_SOURCE_DIR) / "../shared/data/tracking";
  if (!std::filesystem::exists(folder / "scenario2.jsonl"))
    GTEST_SKIP() << "no scans of a real harbour beside the repository";
  std::printf(
      "scenario  tracker                   OSPA 50 m  OSPA 200 m  tracked %%  swaps  false/h\n");
  double ours = 0.0, best_of_others = 0.0;
  for (int scenario = 2; scenario <= 6; ++scenario) {
    double best = 1e9;
    const std::string name = "scenario" + std::to_string(scenario) + ".jsonl";
    std::ifstream in(folder / name, std::ios::binary);
    const std::string text((std::istreambuf_iterator<char>(in)), {});
    const ReadScans read = read_scans_jsonl(text, name);
    EXPECT_EQ(read.notes.left_out(), 0u) << name;
    EXPECT_EQ(read.truth.targets.size(), 2u);
    for (const Told& told :
         {skerry_tracks(read.scans), baseline_radar_pi(read.scans), baseline_mayara(read.scans)}) {
      JudgeRule narrow, wide;
      narrow.cut_m = 50.0;
      const SceneScore score = track_score(read.truth, told, narrow);
      std::printf("%8d  %-24s %10.1f %11.1f %10.1f %6zu %8.0f\n", scenario, told.name.c_str(),
                  score.mean_ospa_m, track_score(read.truth, told, wide).mean_ospa_m,
                  100.0 * score.tracked_share, score.swaps, score.false_per_hour.value_or(-1.0));
      EXPECT_LT(score.mean_ospa_m, 40.0) << name;
      EXPECT_GT(score.tracked_share, 0.55) << name;
      for (const TargetScore& target : score.targets) EXPECT_GT(target.tracked, 0u) << name;
      if (told.name == "skerry") {
        ours += score.mean_ospa_m / 5.0;
      } else {
        best = std::min(best, score.mean_ospa_m);
      }
    }
    best_of_others += best / 5.0;
  }
  EXPECT_LT(ours, 0.95 * best_of_others) << "m of OSPA with a cut of 50 m, the mean of the scenes";
}

}  // namespace
}  // namespace skerry::server
