// The ground behind a shore, by the types of Ji et al. 2016.
#pragma once

#include <algorithm>

#include "echo/kernel/land_chunk.hpp"
#include "echo/scene/picture_shore.hpp"

namespace skerry::echo {

// The ground at one place: height over the water, and gamma of what covers it (SOURCES.md "Land": a
// piece of land returns gamma times the area it shows across the line of sight).
struct Ground {
  double height_m = 0.0;
  double gamma = 0.0;
};

inline constexpr double kLandGamma = 0.158;  // -8 dB: wooded hill
inline constexpr double kFaceGamma = 0.708;  // -1.5 dB: quay wall, of -5 to 0 (SOURCES.md "Land")
inline constexpr double kFaceHeight = 3.0;   // of a quay where no height is charted, metres
inline constexpr double kWetEdge = 30.0;     // metres over which wet sand fades in
inline constexpr double kBeachSlope = 1.0 / 50.0;  // of sand and mud, up to 150 m above the water

// The height of natural land (land_chunk.hpp), in double.
inline double land_height(double inland_m, double broad_noise, double fine_noise) {
  return natural_height(inland_m, broad_noise, fine_noise);
}

// How a shore stands over the water of the moment.
struct ShoreState {
  PictureShore shore = {};
  double water_level_m = 0.0;  // over high water, as Scene has it
  double foreshore_m = 0.0;    // of sand: how far the water stands off the charted edge; may be < 0
  friend bool operator==(const ShoreState&, const ShoreState&) = default;
};

// The ground `inland_m` metres behind the water's edge.
//   II rocky, and unknown: land_height(), gamma -8 dB; the bank as high as charted.
//   I artificial: an apron as high as the quay for 40 m (-15 dB), then low buildings to 300 m
//     (-5 dB, up to 8 m), the natural rise behind.
//   III sand and mud: 1:50 to 150 m above high water, a gentle rise of 12 m behind; -20 dB, -15 dB
//     beyond half a kilometre; the wet edge fades in over 30 m.
// Continuous in `inland_m` for all three.
// `roofs`: whether the low buildings of type I stand there; without, what is under them.
Ground ground_behind(const ShoreState& state, double inland_m, double broad_noise,
                     double fine_noise, bool roofs = true);

// How far a charted cover rules that far inland, 0 to 1: the apron of a quay and the wet edge of
// sand stay what they are.
double cover_share(const ShoreState& state, double inland_m);

// The most ground_behind().height_m can be up to that far inland.
double greatest_height(const ShoreState& state, double inland_m);

// The vertical face at the water's edge, metres; 0 where there is none but the ground itself.
double face_height(const ShoreState& state);

// On charted ground: the least height right at the edge, and how rough it may be below
// the raster's step, metres.
double bank_height(const ShoreState& state);
double roughness(const ShoreState& state, double inland_m);

}  // namespace skerry::echo
