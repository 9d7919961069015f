// The debrief as tables for other programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "server/debrief/debrief.hpp"

namespace skerry::server {

// Names and contents: own_ships.csv, targets.csv, passings.csv, ranges.csv, mishaps.csv,
// timeline.csv, reactions.csv, checks.csv,
// known_targets.csv and known_alerts.csv.  RFC 4180, UTF-8, a line of names first; times in
// seconds, `at_s` since the server began, `exercise_s` on the exercise's clock; what is not known
// is empty.
std::vector<std::pair<std::string, std::string>> csv_files(const Debrief& debrief);

}  // namespace skerry::server
