// A coast refined as Ji et al. 2016 print it, as a picture that the echo can be made of.
#pragma once

#include "echo/fractal/as_printed/display.hpp"
#include "echo/fractal/as_printed/printed_coast.hpp"
#include "echo/scene/coast_picture.hpp"

namespace skerry::echo {

// Each run of `straight`, the chart's edges as they are, refined on a display of `diameter_px`
// pixels that shows `straight.range_m` about its centre; run k by a seed of its own.
// Error: as as_printed::refine().
CoastPicturePtr printed_picture(const CoastPicture& straight,
                                const as_printed::Parameters& parameters, double diameter_px);

}  // namespace skerry::echo
