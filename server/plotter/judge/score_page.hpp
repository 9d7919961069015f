// Scores as a page: one HTML file that needs no other.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "server/plotter/judge/track_score.hpp"

namespace skerry::server {

struct ScorePage {
  std::string title;
  std::vector<std::string> notes;  // what was read, and what was left out
};

// `told`: as many as scores, in the same order.  All text is escaped.
std::string score_page(const ScorePage& page, const Truth& truth, std::span<const Told> told,
                       std::span<const SceneScore> scores);

}  // namespace skerry::server
