// PictureScore: how far a made picture is from a real one, and how its rows correlate.
#pragma once

#include <array>
#include <string_view>

#include "echo/measure/picture_edge.hpp"
#include "echo/measure/picture_outline.hpp"
#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

inline constexpr std::array<std::uint32_t, 6> kCorrelationLags = {1, 2, 4, 8, 16, 32};

// Correlation of the values of two cells so many spokes, or cells, apart, over the pairs of which
// both echo (value at least 1).  NaN where there are none.  Source of the measure: SOURCES.md
// "Pictures" (f).
struct PictureCorrelation {
  std::array<double, 6> spoke{};  // by kCorrelationLags
  std::array<double, 6> range{};
};

// Error: std::invalid_argument as require_valid().  window.threshold is not looked at.
PictureCorrelation picture_correlation(const PictureTurn& turn, const PictureWindow& window);

// The same of the mean of several turns of one size, over cells whose mean is at least `least`.
// Speckle that is new every turn averages out, so it is higher.
PictureCorrelation mean_picture_correlation(std::span<const PictureTurn> turns,
                                            const PictureWindow& window, double least);

struct PictureScore {
  // Dimensions of the outline: split at the beam, and as SOURCES.md "Pictures" split it (by the
  // range).
  double below_beam = 0.0, above_beam = 0.0;
  double below_recorded = 0.0, above_recorded = 0.0;
  Quantiles thickness_m{};
  double within_a_cell = 0.0;
  double change_p99_m = 0.0;
  std::array<double, 6> spoke_correlation{}, range_correlation{};  // by kCorrelationLags
};

// `range_m`: the range scale, which recorded_scales() go by.  Takes about half a second for 1024
// cells.  Error: std::invalid_argument as require_valid().
PictureScore picture_score(const PictureTurn& turn, const PictureWindow& window, double range_m);

// Values that these estimators find in single turns of real recordings with 2048 spokes of 1024
// cells, the mean of all turns; held by PictureOfARecording.HasTheScoreThatIsComparedWith.
struct RecordedPicture {
  std::string_view name;
  double range_m, beam_deg;
  PictureScore score;
};
inline constexpr std::array<RecordedPicture, 2> kRecordedPictures = {{
    {"HALO20, natural shore",
     3183.0,
     4.9,
     {1.192,
      1.513,
      1.018,
      1.417,
      {97, 123, 164, 240, 392},
      0.841,
      71,
      {0.980, 0.924, 0.756, 0.494, 0.246, 0.055},
      {0.969, 0.880, 0.611, 0.337, 0.190, 0.101}}},
    {"3G, lake shore",
     1633.4,
     5.2,
     {1.210,
      1.437,
      1.056,
      1.376,
      {87, 103, 150, 193, 250},
      0.926,
      8,
      {0.951, 0.848, 0.634, 0.384, 0.195, 0.083},
      {0.838, 0.658, 0.420, 0.276, 0.182, 0.105}}},
}};

}  // namespace skerry::echo
