// Echo pictures of a thinned coast as each contestant draws it.
#pragma once

#include <optional>

#include "echo/coast_tool/judge_coast.hpp"
#include "echo/measure/picture_score.hpp"
#include "echo/scene/coast_picture.hpp"
#include "protocol/video/range_scale.hpp"
#include "protocol/video/scan_geometry.hpp"

namespace skerry::echo {

// A radar that looks at the coast, with the spokes and cells of a recorded one (SOURCES.md
// "Pictures").
struct JudgeRadar {
  RangeScale scale;
  double beam_deg = 1.2;
  ScanGeometry geometry = {.spokes_per_turn = 2048, .cells = 1024, .bits = 8};
};

// A place afloat in the area whose nearest shore is at a fifth to a third of the range, as in
// SOURCES.md "Pictures": the first of a spiral of 2000 from the middle of the area.  Nothing if
// there is none.
std::optional<GeoPoint> place_afloat(const ThinnedCoast& coast, const CoastArea& area,
                                     RangeScale scale);

// One turn, default gain and sea control, no traffic, of the fine coast (as it is in the chart), or
// of the coarse one as the contestant refines it.  Scored is the mean over an echo being what
// reaches a quarter and a half of full scale.
PictureScore score_of_fine(const ThinnedCoast& coast, GeoPoint place, const JudgeRadar& radar);
PictureScore score_of_drawn(const ThinnedCoast& coast, const Contestant& contestant,
                            std::uint64_t seed, GeoPoint place, const JudgeRadar& radar);

}  // namespace skerry::echo
