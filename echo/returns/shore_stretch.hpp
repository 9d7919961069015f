// The present place of the shores of the land along a ray.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/kernel/relief_noise.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/returns/shore_profile.hpp"

namespace skerry::echo {

// Tide and waves, as Scene has them, at one instant.
struct ShoreWater {
  double level_m = 0.0;
  double wave_height_m = 0.0;
  double seconds = 0.0;  // since the scenario began
  std::uint32_t seed = 0;
};

// One end of a stretch of land.  Open where no shore is in sight: the own ship lies ashore, the
// range ends, or a seam of two charts; then the other end's shore rules.
struct ShoreEnd {
  ShoreState state = {};
  double at_m = 0.0;  // the water's edge, from which distances inland are counted
  bool open = false;
};

struct ShoreStretch {
  double begin_m = 0.0, end_m = 0.0;  // of the land now
  ShoreEnd begin = {}, end = {};
  // How far the face at the near end reaches to either side of begin_m within the ray's arc.
  double face_near_m = 0.0, face_far_m = 0.0;
};

// Whether that land is as add_land() without shores makes it: rocky or unknown with no height
// charted, and no seam.
bool is_plain(const PictureShore& shore);
bool is_plain(const LandInterval& land, std::span<const PictureShore> shores);

// How the water moves an edge of sand along a ray, metres to landward: level over kBeachSlope, and
// the swash: half of sqrt(H L) to either side by `noise` in [-1, 1], with L = H / 0.03.  Along the
// ray and not across the shore: on a shore met at an angle it moves by the sine of that angle less.
// Source: Hunt (1959), run-up = slope sqrt(H L).
double sand_shift(const ShoreWater& water, double noise);
// Half the swash's way, metres.
double swash_m(double wave_height_m);

// Noise in [-1, 1] of beaches at cells first .. of the path: 30 m across, made anew every 1.5 s and
// joined by smoothstep.  A pure function of place, time and seed; nothing else may draw on it.
void beach_noise(const ShoreWater& water, const LatticePath& path, std::uint32_t first_cell,
                 std::span<float> out);

// The stretches of `land`.  Sand moves with the water, but never by more than 0.45 of its land nor
// 0.45 of the water before and behind it: it swallows neither.  Stretches on both sides of a seam,
// no more than kSeamGap apart, count their distance inland as one.
// `ray_radians` is the arc the ray stands for.
inline constexpr double kSeamGap = 30.0;  // metres
void lay_shores(const std::vector<LandInterval>& land, const CoastPicture& coast, const Ray& ray,
                double ray_radians, double cell_m, double range_m, const ShoreWater& water,
                const LatticePath& path, std::vector<ShoreStretch>& out);

}  // namespace skerry::echo
