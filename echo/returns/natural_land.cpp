#include "echo/returns/natural_land.hpp"

#include <algorithm>
#include <cmath>

#include "echo/returns/cover_echo.hpp"
#include "echo/returns/cover_row.hpp"
#include "echo/returns/shore_profile.hpp"
#include "echo/returns/shore_returns.hpp"

namespace skerry::echo {
namespace {

constexpr double kCoarseWave = 330.0;  // metres: the shortest joined between points
constexpr int kMostShift = 5;

int shift_for(double cell_m) {
  int shift = 0;
  while (shift < kMostShift && cell_m * (2 << shift) * NaturalLand::kPointsPerWave <= kCoarseWave)
    ++shift;
  return shift;
}

}  // namespace

NaturalLand::NaturalLand(const LandModel& model, const LatticePath& path)
    : model_(model), path_(path), coarse_path_(path), shift_(shift_for(model.cell_m)) {
  const double step = 1 << shift_;
  coarse_path_.north1 *= step;
  coarse_path_.north2 *= step * step;
  coarse_path_.east1 *= step;
  coarse_path_.east2 *= step * step;
  gain_ = static_cast<float>(model.unit_signal_to_noise * kLandGamma * model.ray_radians);
  const auto fine = fine_octaves(model.cell_m);
  std::size_t coarse = 0;
  while (coarse < fine.size() && fine[coarse].wavelength_m >= kCoarseWave) ++coarse;
  coarse_fine_ = fine.first(coarse);
  for (std::size_t o = coarse; o < fine.size(); ++o) {
    octaves_[octave_count_++] =
        octave_path(path, fine[o], model.seed ^ kFineSeed, static_cast<std::uint32_t>(o));
    finest_sum_ += fine[o].amplitude;
  }
}

void NaturalLand::make_coarse(std::size_t block, std::size_t first, std::size_t end) {
  if (block_ == block && first >= made_first_ && end <= made_end_) return;
  block_ = block;
  made_first_ = first;
  made_end_ = end;
  const auto from = static_cast<std::uint32_t>(first >> shift_);
  // Whole vectors of points: what is left over costs more than a few too many.
  const std::size_t points = (((end - first) >> shift_) + 1 + kVector - 1) / kVector * kVector;
  const std::size_t at = (first - block) >> shift_;
  relief_noise(coarse_path_, broad_octaves(model_.cell_m), model_.seed, from,
               {broad_ + at, points});
  relief_noise(coarse_path_, coarse_fine_, model_.seed ^ kFineSeed, from, {fine_ + at, points});
}

// A bound from the chunk's coarse noises: no cell of the chunk is higher.
double NaturalLand::highest_in(const LandChunk& chunk) const {
  const std::size_t points = (kLandChunk >> shift_) + 1;
  float broad = chunk.broad[0], fine = chunk.fine[0];
  for (std::size_t i = 1; i < points; ++i) {
    broad = std::max(broad, chunk.broad[i]);
    fine = std::max(fine, chunk.fine[i]);
  }
  const float last = chunk.from_begin + chunk.cell * static_cast<float>(chunk.end - 1);
  const float first = chunk.from_end - chunk.cell * static_cast<float>(chunk.begin);
  return land_height(static_cast<double>(std::max(0.0f, std::min(last, first))),
                     static_cast<double>(broad),
                     static_cast<double>(std::max(0.0f, fine + finest_sum_))) +
         1e-3;
}

void NaturalLand::add(double begin_m, double end_m, const LandInterval& shore, LandRay& ray,
                      GroundProfile* profile, std::span<float> power, CoverRow* cover) {
  const auto first = static_cast<std::size_t>(begin_m / model_.cell_m);
  if (first >= power.size()) return;
  const std::size_t last =
      std::min(power.size() - 1, static_cast<std::size_t>(end_m / model_.cell_m));
  LandChunk chunk;
  chunk.cell = static_cast<float>(model_.cell_m);
  chunk.antenna = static_cast<float>(model_.antenna_height_m);
  chunk.half_curvature = static_cast<float>(0.5 / kEffectiveEarth);
  chunk.horizon = static_cast<float>(std::sqrt(2.0 * kEffectiveEarth * model_.antenna_height_m));
  chunk.gain = gain_;
  chunk.coarse_shift = shift_;
  chunk.octaves = octaves_;
  chunk.octave_count = octave_count_;
  const auto most_between = [&](std::size_t from, std::size_t to) {
    const double inland =
        std::min(ray.middle_of(to) - shore.begin_m, shore.end_m - ray.middle_of(from)) +
        model_.cell_m;
    return land_height(std::max(0.0, inland), 1.0, 1.0);
  };
  LandChunkOut out;
  for (std::size_t block = first / kBlock * kBlock; block <= last; block += kBlock) {
    const std::size_t block_first = std::max(block, first);
    const std::size_t block_last = std::min(last, block + kBlock - 1);
    const double tallest = cover ? static_cast<double>(kTallestObject) : 0.0;
    if (ray.hides(most_between(block_first, block_last) + tallest, ray.middle_of(block_first),
                  ray.middle_of(block_last)))
      continue;
    make_coarse(block, block_first / kLandChunk * kLandChunk,
                (block_last / kLandChunk + 1) * kLandChunk);
    for (std::size_t at = block_first / kLandChunk * kLandChunk; at <= block_last;
         at += kLandChunk) {
      chunk.first = static_cast<std::int32_t>(at);
      chunk.begin = static_cast<std::int32_t>(std::max(at, first) - at);
      chunk.end = static_cast<std::int32_t>(std::min(last + 1, at + kLandChunk) - at);
      const double middle = ray.middle_of(at);
      chunk.from_begin = static_cast<float>(middle - shore.begin_m);
      chunk.from_end = static_cast<float>(shore.end_m - middle);
      chunk.range = static_cast<float>(middle);
      chunk.broad = broad_ + ((at - block) >> shift_);
      chunk.fine = fine_ + ((at - block) >> shift_);
      const std::size_t from = at + static_cast<std::size_t>(chunk.begin);
      const std::size_t to = at + static_cast<std::size_t>(chunk.end);
      const double highest = highest_in(chunk);
      const auto hidden = [&](double objects) {
        return ray.hides(highest + objects, ray.middle_of(from), ray.middle_of(to - 1));
      };
      if (hidden(tallest)) continue;
      const bool covered = cover && cover->read(from, to - from);
      if (cover && hidden(covered ? cover->most_objects(from, to - from) : 0.0)) continue;
      float objects[kLandChunk], gains[kLandChunk];
      chunk.objects = chunk.gains = nullptr;
      if (covered) {
        std::fill_n(objects, kLandChunk, 0.0f);
        std::fill_n(gains, kLandChunk, 1.0f);
        cover->objects(from, {objects + chunk.begin, to - from});
        for (std::size_t cell = from; cell < to; ++cell) {
          if (cover->at(cell) != LandCover::none)
            gains[cell - at] = echo_of(cover->at(cell)).gamma / static_cast<float>(kLandGamma);
        }
        chunk.objects = objects;
        chunk.gains = gains;
      }
      auto shadow = static_cast<float>(ray.shadow());
      make_land_chunk(chunk, shadow, out);
      for (std::size_t cell = from; cell < to; ++cell) power[cell] += out.power[cell - at];
      if (profile) {
        profile->fill(from, static_cast<float>(ray.shadow()));
        profile->take(to, out.shadow + chunk.begin, out.height + chunk.begin);
      }
      ray.raise_shadow(static_cast<double>(shadow));
    }
  }
}

}  // namespace skerry::echo
