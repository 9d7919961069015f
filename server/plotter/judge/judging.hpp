// From files to scores.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "server/plotter/judge/track_score.hpp"

namespace skerry::server {

struct JudgeRequest {
  std::string truth;                   // truth_csv.hpp; empty: that of the scans
  std::vector<std::string> told;       // tracks_csv.hpp or target_log.hpp
  std::string scans;                   // scans_jsonl.hpp; may be empty
  std::vector<std::string> baselines;  // of kBaselines; they need scans
  JudgeRule rule;
};
inline constexpr std::string_view kBaselines[] = {"skerry", "radar_pi", "mayara"};
inline constexpr std::size_t kMostFileOctets = std::size_t{512} << 20;

struct Judged {
  Truth truth;
  std::vector<Told> told;
  std::vector<SceneScore> scores;  // of each told, in their order
  std::vector<std::string> notes;  // of each file: what was used, and what was left out
};

// Errors: std::runtime_error or std::invalid_argument that say what is wrong, where, and what was
// expected.
Judged judge_trackers(const JudgeRequest& request);

// A table rather than a log of sentences?
bool is_tracks_csv(std::string_view text, std::string_view file);

}  // namespace skerry::server
