// What a tracker is worth against the truth: per step, per target and of the whole scene.
#pragma once

#include <cstddef>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "server/plotter/judge/track_error.hpp"
#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

struct JudgeRule {
  double cut_m = 200.0;  // of OSPA and GOSPA, and the farthest that a track may be from its target
  double order = 2.0;    // p of both, 1 or more
  double keep_m =
      -1.0;  // by which a pair made before counts as nearer; negative: a quarter of the cut
  double step_s = 2.5;  // 0: at the times when something was told
  // How long a track is shown after it was told last, s: three turns at 24 rpm.
  double hold_s = 7.5;
  // CPA and TCPA are judged only while both ships keep on for so long before and after, s.
  double steady_s = 30.0;
  // From own ship; who is farther neither counts nor is made up.  Infinite: all.
  double within_m = std::numeric_limits<double>::infinity();
};
inline constexpr std::size_t kMostJudgedSteps = 200'000, kMostShown = 2'000;

// Of a target whose looks are known.  Due: it was seen in five of the last ten turns and has had a
// track before, so that a track must be there (IEC 62388; MSC.192(79) 5.25).
struct FiveOfTen {
  std::size_t due = 0, kept = 0;  // steps
};

struct TargetScore {
  std::string id;
  std::size_t steps = 0;  // at which it was there, had been seen, and was within range
  std::size_t tracked = 0;
  std::optional<double> initiation_s = {};  // from when it was seen first to its first track
  double tracked_share = 0.0;               // of its steps
  double continuity = 0.0;  // of its steps from its first track on; 0 if there was none
  std::size_t numbers = 0;  // how many tracks it had
  std::size_t breaks = 0;   // how often it lost its track, being there
  std::size_t swaps = 0;    // how often it got a track that had been another target's
  std::vector<TrackError> errors;
  std::optional<double> place_rms_m = {}, place_95_m = {};
  std::optional<double> course_95_deg = {}, speed_95_kn = {};
  std::optional<double> cpa_95_nm = {}, tcpa_95_min = {};
  std::size_t forecasts = 0;  // steps at which CPA was judged
  Accuracy after_one_minute = {}, after_three_minutes = {};
  std::optional<FiveOfTen> five_of_ten = {};
};

struct ToldScore {
  std::string number;
  std::size_t steps = 0, paired = 0;  // at which it was shown within range, and was a target
  std::size_t targets = 0;            // how many it was
};

struct StepScore {
  double utc_s = 0.0;
  std::size_t truth = 0, told = 0;  // how many
  double ospa_m = 0.0, gospa_m = 0.0;
  // Of GOSPA at the power of its order: errors of pairs, misses, made-up ones; their sum is
  // gospa_m to the power of the order.
  double errors_part = 0.0, missed_part = 0.0, made_up_part = 0.0;
  std::size_t missed = 0, made_up = 0;  // by the pairing that lasts, not GOSPA's
};

struct SceneScore {
  std::string name;
  JudgeRule rule;
  double first_s = 0.0, hours = 0.0;
  std::vector<StepScore> steps;
  std::vector<TargetScore> targets;
  std::vector<ToldScore> tracks;
  double mean_ospa_m = 0.0, mean_gospa_m = 0.0;  // over steps
  double mean_missed = 0.0, mean_made_up = 0.0;  // targets at a time
  std::size_t never_tracked = 0;                 // targets
  // Tracks that were no target at any step: how many, for each hour, and how much of all that was
  // shown was paired with nothing (0 to 1).
  std::size_t false_tracks = 0;
  std::optional<double> false_per_hour = {};
  double false_share = 0.0;
  std::size_t swaps = 0, breaks = 0;
  double tracked_share = 0.0;  // of all targets' steps
  std::optional<FiveOfTen> five_of_ten = {};
};

// Steps go from the first point of the truth to its last.  Pure.
// Errors: std::invalid_argument if a value of the rule is out of its range, there is no truth,
// there would be more than kMostJudgedSteps steps, or more than kMostShown tracks are shown at one
// of them.
SceneScore track_score(const Truth& truth, const Told& told, const JudgeRule& rule);

}  // namespace skerry::server
