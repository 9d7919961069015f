// Tracks over the truth, as SVG.
#pragma once

#include <string>

#include "server/plotter/judge/truth_and_told.hpp"

namespace skerry::server {

// North is up.  Shows all of the truth and own ship with a margin; of tracks as much as falls into
// it: at most 400 of them, of 400 points each.  Targets have the colours of the page's style and
// their names; own ship is grey, tracks are dashed, a ring is where one was lost.
std::string scene_figure(const Truth& truth, const Told& told);

}  // namespace skerry::server
