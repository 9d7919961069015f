// Scores as text: for a terminal and for other programs.
#pragma once

#include <span>
#include <string>
#include <utility>
#include <vector>

#include "server/plotter/judge/track_score.hpp"

namespace skerry::server {

// Tables of fixed columns: a line for each tracker; for each target of each tracker; and for each
// target that was tracked steadily for one and for three minutes.  What is not known is "-".
std::string score_table(std::span<const SceneScore> scores);

// Names and contents: scenes.csv (a row for each tracker), targets.csv, tracks.csv, steps.csv (each
// time) and errors.csv (each pair at each time).  RFC 4180, UTF-8, a line of names first; what is
// not known is empty.
std::vector<std::pair<std::string, std::string>> score_csv_files(
    std::span<const SceneScore> scores);

}  // namespace skerry::server
