// Several turns of one place: how alike they are, and whether a turn's ends meet.
#pragma once

#include <span>

#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

// Correlation of the values of a cell in one turn and `lag` turns later, over cells that echo in
// either; the mean over all pairs of turns so far apart.  NaN where there are none.
// Source: SOURCES.md "Pictures (g)".
// Error: std::invalid_argument as require_valid(), and where turns differ in size.
double turn_correlation(std::span<const PictureTurn> turns, const PictureWindow& window,
                        std::size_t lag);

// How much more the last spoke of a turn and the first of the next differ than two neighbours of
// the same turn near them: the mean difference over cells that echo in either, over that of the
// eight pairs before and the eight after.  1: there is no seam.  Turns must follow each other.
// NaN for fewer than two turns and where nothing echoes.
double bow_seam(std::span<const PictureTurn> turns, const PictureWindow& window);

}  // namespace skerry::echo
