// Doppler colours: which cells of a view's video come nearer or go away.
#pragma once

#include <cstdint>
#include <span>

#include "echo/receiver/controls.hpp"
#include "echo/receiver/row_resampler.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry::echo {

// A view cell is as fast as the strongest of the radar's cells that it holds a part of, and has a
// colour if that is as fast as the threshold or faster, echoes at least as strongly as the noise,
// and shows anything.  `stretch`: cells to either side that the video was stretched by; those
// shown beside a coloured one are of its colour.
struct ColourRule {
  DopplerMode mode = DopplerMode::off;
  double threshold_mps = 2.0;
  unsigned stretch = 0;
};
// `power`, `closing`: the radar's row, PowerRows has them.  Requires video.size() ==
// colours.size(), the view's cells of `resampler`.
void lay_colours(const RowResampler& resampler, const ColourRule& rule,
                 std::span<const float> power, std::span<const float> closing,
                 std::span<const std::uint8_t> video, std::span<DopplerClass> colours);

}  // namespace skerry::echo
