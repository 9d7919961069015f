// Whatever a file holds, it is read or refused, and what was read can be judged and shown.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "server/plotter/judge/baselines/mayara.hpp"
#include "server/plotter/judge/baselines/radar_pi.hpp"
#include "server/plotter/judge/score_page.hpp"
#include "server/plotter/judge/score_text.hpp"
#include "server/plotter/judge/target_log.hpp"
#include "server/plotter/judge/tracks_csv.hpp"
#include "server/plotter/judge/truth_csv.hpp"

namespace skerry::server {
namespace {

constexpr int kRounds = 1500;

// Flips, cuts, repeats, and puts in what parsers stumble over.
class Spoiler {
 public:
  std::string spoiled(std::string text) {
    const int changes = 1 + pick(4);
    for (int i = 0; i < changes; ++i) {
      const std::size_t at = place(text);
      switch (pick(6)) {
        case 0:
          if (at < text.size()) text[at] = static_cast<char>(pick(256));
          break;
        case 1:
          text.erase(at, static_cast<std::size_t>(pick(20)));
          break;
        case 2:
          text.insert(at, text.substr(place(text), 40));
          break;
        case 3:
          text.insert(at, kNasty[static_cast<std::size_t>(pick(std::size(kNasty)))]);
          break;
        case 4:
          text.resize(at);
          break;
        default:
          if (at < text.size()) text[at] = static_cast<char>('0' + pick(10));
      }
    }
    return text;
  }

 private:
  static constexpr const char* kNasty[] = {
      "1e308", "-1e308", "NaN",  "inf", ",",    "\n",   "\"", "-",  "\r\n", "99999999999", "{",
      "[",     "]",      "null", "\\s", "$--*", "0x10", "e",  "\t", "\xff", "1e-320",      "*00"};
  int pick(std::size_t below) {
    return static_cast<int>(std::uniform_int_distribution<std::size_t>(0, below - 1)(random_));
  }
  std::size_t place(const std::string& text) {
    return static_cast<std::size_t>(pick(text.size() + 1));
  }
  std::mt19937_64 random_{20261126};
};

std::string truth_text() {
  std::string text = "utc_s,id,lat_deg,lon_deg,course_deg,speed_kn,seen\n";
  for (int t = 0; t < 12; ++t) {
    const std::string utc = std::to_string(1'700'000'000 + 3 * t);
    text += utc + ",own,60.0,5.0,0,0,\n";
    text += utc + ",a,60.01,5.0" + std::to_string(t) + ",90,10,1\n";
    text += utc + ",b,59.99,5.0" + std::to_string(t) + ",,,0\n";
  }
  return text;
}

std::string tracks_text() {
  std::string text = "utc_s,track,status,lat_deg,lon_deg,course_deg,speed_kn,cpa_nm,tcpa_min\n";
  for (int t = 0; t < 12; ++t) {
    const std::string utc = std::to_string(1'700'000'000 + 3 * t);
    text += utc + ",1,tracked,60.01,5.0" + std::to_string(t) + ",90,10,0.1,2\n";
    text += utc + ",2,tentative,59.99,5.0" + std::to_string(t) + ",,,,\n";
  }
  return text;
}

std::string log_text() {
  std::string text;
  for (int t = 0; t < 12; ++t) {
    nmea::Rmc rmc;
    rmc.utc = UtcTime(std::chrono::seconds(1'700'000'000 + 3 * t));
    rmc.position = GeoPoint{60.0, 5.0};
    nmea::Ttm ttm;
    ttm.number = 4;
    ttm.range_nm = 0.6;
    ttm.bearing_deg = 3.0 * t;
    text += nmea::encode(rmc) + nmea::encode(ttm);
  }
  return text;
}

std::string scans_text() {
  std::string text;
  for (int t = 0; t < 12; ++t)
    text += "{\"time\": " + std::to_string(1'700'000'000 + 2 * t) +
            ", \"own_north_east\": [0, 0], \"plots\": [[100, " + std::to_string(5 * t) +
            "], [-60, 3]], \"targets\": [{\"id\": 1, \"time\": " +
            std::to_string(1'700'000'000 + 2 * t) + ", \"north_east\": [101, " +
            std::to_string(5 * t) + "]}]}\n";
  return text;
}

void judge_and_show(const Truth& truth, const std::vector<Told>& told) {
  JudgeRule rule;
  rule.step_s = 60.0;
  std::vector<SceneScore> scores;
  for (const Told& each : told) {
    scores.push_back(track_score(truth, each, rule));
    ASSERT_TRUE(std::isfinite(scores.back().mean_ospa_m));
    ASSERT_LE(scores.back().mean_ospa_m, rule.cut_m + 1e-9);
    ASSERT_TRUE(std::isfinite(scores.back().mean_gospa_m));
    if (scores.back().steps.size() > 5000) return;  // a page of them takes its time
  }
  ASSERT_FALSE(score_table(scores).empty());
  ASSERT_EQ(score_csv_files(scores).size(), 5u);
  const std::string page = score_page({"", {}}, truth, told, scores);
  ASSERT_EQ(page.find("nan"), std::string::npos);
  ASSERT_LT(page.size(), 4'000'000u);
}

// Runs `read` on spoiled texts; counts how many were read all the same.
template <typename Read>
int rounds(const std::string& text, const Read& read) {
  Spoiler spoiler;
  int done = 0;
  for (int i = 0; i < kRounds; ++i) {
    const std::string spoiled = spoiler.spoiled(text);
    try {
      read(spoiled);
      ++done;
    } catch (const std::runtime_error&) {
    } catch (const std::invalid_argument&) {
    }
  }
  return done;
}

TEST(HostileFiles, OfTruthAreReadOrRefused) {
  const Told told = read_tracks_csv(tracks_text(), "t").told.at(0);
  EXPECT_GT(rounds(truth_text(),
                   [&](const std::string& text) {
                     judge_and_show(read_truth_csv(text, "f").truth, {told});
                   }),
            kRounds / 2);
}

TEST(HostileFiles, OfTracksAreReadOrRefused) {
  const Truth truth = read_truth_csv(truth_text(), "t").truth;
  EXPECT_GT(rounds(tracks_text(),
                   [&](const std::string& text) {
                     judge_and_show(truth, read_tracks_csv(text, "f").told);
                   }),
            kRounds / 2);
}

TEST(HostileFiles, OfSentencesAreReadOrRefused) {
  const Truth truth = read_truth_csv(truth_text(), "t").truth;
  EXPECT_GT(rounds(log_text(),
                   [&](const std::string& text) {
                     judge_and_show(truth, {read_target_log(text, "f", truth).told});
                   }),
            kRounds / 2);
}

TEST(HostileFiles, OfScansAreReadOrRefused) {
  EXPECT_GT(rounds(scans_text(),
                   [&](const std::string& text) {
                     const ReadScans read = read_scans_jsonl(text, "f");
                     judge_and_show(read.truth,
                                    {baseline_radar_pi(read.scans), baseline_mayara(read.scans)});
                   }),
            kRounds / 2);
}

}  // namespace
}  // namespace skerry::server
