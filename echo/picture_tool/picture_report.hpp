// What the tool says of two radars' pictures: tables for people, lines for programs.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "echo/picture_tool/picture_comparison.hpp"

namespace skerry::echo {

// Two sides beside each other.
struct PictureReport {
  std::string real_name, ours_name;
  double beam_deg = 0.0;
  SpreadStatistics real, ours;
  Calls calls;
  std::vector<std::string> notes;  // why something is missing or not as it seems
};

// A line of each statistic and of each call.  What cannot be measured is "-", with the reason as a
// note.  Then the features that tell real from ours, at most as many as asked for.
std::string report_text(const PictureReport& report, std::size_t features);

// A line for each side and one for each call: for many captures under each other.
std::string short_report_head();
std::string short_report_text(const PictureReport& report, std::size_t features);

// The features of either view that tell most.
inline constexpr std::size_t kFeaturesShown = 5;

// The report's notes, and why each "-" is one.
std::vector<std::string> notes_of(const PictureReport& report);

std::array<const Call*, 5> all_calls(const Calls& calls);

}  // namespace skerry::echo
