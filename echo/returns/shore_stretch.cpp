#include "echo/returns/shore_stretch.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kSteepness = 0.03;      // of waves on a beach, height over length
constexpr double kRenewalSeconds = 1.5;  // a texture of the beach is forgotten in
constexpr std::array<NoiseOctave, 1> kBeachOctave = {{{30.0, 1.0f}}};
constexpr double kMostMoved = 0.45;  // of land or water that a shore may move over

std::uint32_t texture_seed(const ShoreWater& water, double step) {
  return static_cast<std::uint32_t>(
      mixed(water.seed, 0x5A2D, static_cast<std::uint64_t>(static_cast<std::int64_t>(step))));
}

ShoreEnd shore_end(const PictureShore& shore, double at, bool in_sight, const ShoreWater& water) {
  return {{shore, water.level_m, 0.0}, at, !in_sight || shore.seam};
}

// To landward of the charted edge in the cell it lies in.
double shift_of(const ShoreEnd& end, const ShoreWater& water, const LatticePath& path,
                double cell_m) {
  float noise = 0.0f;
  if (water.wave_height_m > 0.0)
    beach_noise(water, path, static_cast<std::uint32_t>(end.at_m / cell_m), {&noise, 1});
  return sand_shift(water, static_cast<double>(noise));
}

bool moves(const ShoreEnd& end) { return !end.open && end.state.shore.type == CoastType::sandy; }

// How far the straight edge from vertex `edge` on reaches along the ray within its arc.
void measure_face(const CoastPicture& coast, std::uint32_t edge, const Ray& ray, double ray_radians,
                  ShoreStretch& stretch) {
  const SinCos direction = sin_cos_units(ray.bearing_units);
  const PlanePoint a = coast.vertices[edge] - ray.own_ship;
  const PlanePoint b = coast.vertices[edge + 1] - ray.own_ship;
  const double right =
      std::fabs((b.east_m - a.east_m) * direction.cos - (b.north_m - a.north_m) * direction.sin);
  const double along_a = ahead_of(direction, a);
  const double along_b = ahead_of(direction, b);
  const double arc = ray_radians * stretch.begin_m;
  const double half =
      right > 0.0 ? 0.5 * std::fabs(along_b - along_a) * std::min(1.0, arc / right) : 0.0;
  stretch.face_near_m = std::clamp(stretch.begin_m - std::min(along_a, along_b), 0.0, half);
  stretch.face_far_m = std::clamp(std::max(along_a, along_b) - stretch.begin_m, 0.0, half);
}

}  // namespace

bool is_plain(const PictureShore& shore) {
  return !shore.seam && shore.height_m <= 0.0f &&
         (shore.type == CoastType::rocky || shore.type == CoastType::unknown);
}

bool is_plain(const LandInterval& land, std::span<const PictureShore> shores) {
  return is_plain(shores[land.begin_shore]) && is_plain(shores[land.end_shore]);
}

double swash_m(double wave_height_m) { return 0.5 * wave_height_m / std::sqrt(kSteepness); }

double sand_shift(const ShoreWater& water, double noise) {
  return water.level_m / kBeachSlope + swash_m(water.wave_height_m) * noise;
}

void beach_noise(const ShoreWater& water, const LatticePath& path, std::uint32_t first_cell,
                 std::span<float> out) {
  constexpr std::size_t kMost = 64;
  const double step = water.seconds / kRenewalSeconds, whole = std::floor(step);
  const auto part = static_cast<float>(step - whole);
  const float weight = part * part * (3.0f - 2.0f * part);
  for (std::size_t done = 0; done < out.size(); done += kMost) {
    std::array<float, kMost> before, after;
    const std::size_t n = std::min(kMost, out.size() - done);
    const auto first = first_cell + static_cast<std::uint32_t>(done);
    relief_noise(path, kBeachOctave, texture_seed(water, whole), first, {before.data(), n});
    relief_noise(path, kBeachOctave, texture_seed(water, whole + 1.0), first, {after.data(), n});
    for (std::size_t k = 0; k < n; ++k) out[done + k] = before[k] + weight * (after[k] - before[k]);
  }
}

void lay_shores(const std::vector<LandInterval>& land, const CoastPicture& coast, const Ray& ray,
                double ray_radians, double cell_m, double range_m, const ShoreWater& water,
                const LatticePath& path, std::vector<ShoreStretch>& out) {
  out.clear();
  for (const LandInterval& l : land) {
    const bool plain = is_plain(l, coast.shores);
    const bool begins = plain || l.begin_m > 0.0, ends = plain || l.end_m < range_m;
    out.push_back({l.begin_m, l.end_m,
                   shore_end(coast.shores[l.begin_shore], l.begin_m, begins, water),
                   shore_end(coast.shores[l.end_shore], l.end_m, ends, water)});
    ShoreStretch& stretch = out.back();
    if (begins && face_height(stretch.begin.state) > 0.0 && !stretch.begin.open)
      measure_face(coast, l.begin_edge, ray, ray_radians, stretch);
  }
  for (std::size_t i = 0; i < out.size(); ++i) {
    ShoreStretch& s = out[i];
    const double length = land[i].end_m - land[i].begin_m;
    const double water_before = land[i].begin_m - (i > 0 ? land[i - 1].end_m : 0.0);
    const double water_behind =
        (i + 1 < land.size() ? land[i + 1].begin_m : range_m) - land[i].end_m;
    if (moves(s.begin)) {
      const double shift = std::clamp(shift_of(s.begin, water, path, cell_m),
                                      -kMostMoved * water_before, kMostMoved * length);
      s.begin_m = s.begin.at_m += shift;
      s.begin.state.foreshore_m = -shift;
    }
    if (moves(s.end)) {
      const double shift = std::clamp(shift_of(s.end, water, path, cell_m),
                                      -kMostMoved * water_behind, kMostMoved * length);
      s.end_m = s.end.at_m -= shift;
      s.end.state.foreshore_m = -shift;
    }
  }
  const auto joined = [&](std::size_t i) {
    return land[i].end_m + kSeamGap >= land[i + 1].begin_m &&
           coast.shores[land[i].end_shore].seam && coast.shores[land[i + 1].begin_shore].seam;
  };
  for (std::size_t i = 0; i + 1 < out.size(); ++i) {
    if (joined(i)) out[i + 1].begin = out[i].begin;
  }
  for (std::size_t i = out.size(); i-- > 1;) {
    if (joined(i - 1)) out[i - 1].end = out[i].end;
  }
}

}  // namespace skerry::echo
