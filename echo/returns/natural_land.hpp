// Natural land along one ray: where its relief is worked out, and where it need not be.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "echo/kernel/land_chunk.hpp"
#include "echo/returns/land_ray.hpp"
#include "echo/returns/land_returns.hpp"

namespace skerry::echo {

class CoverRow;
struct GroundProfile;

// Goes from chunk to chunk of a stretch.  Chunks none of which can show are skipped: first by the
// most such land can stand, then by the most it can with its broad noises known.  Neither changes a
// cell.  Wavelengths of 330 m and more are worked out every 2^n-th cell only, at least
// kPointsPerWave of them to a wave, and joined straight.
// Error: heights by 2 % of those wavelengths' part, 1 m at most, against the same noises at every
// cell.  Held by NaturalLand.CoarseNoiseStaysInItsBound.
class NaturalLand {
 public:
  NaturalLand(const LandModel& model, const LatticePath& path);

  // Land from begin_m to end_m, whose distances inland count from `shore`'s two ends.
  // `profile`: null, or filled for the stretch's cells (shadow before each cell, height).
  // `cover`: null, or what covers the stretch's cells; those without cover keep their bits.
  void add(double begin_m, double end_m, const LandInterval& shore, LandRay& ray,
           GroundProfile* profile, std::span<float> power, CoverRow* cover = nullptr);

  static constexpr double kPointsPerWave = 7.0;

 private:
  static constexpr std::size_t kBlock =
      8 * kLandChunk;  // cells whose coarse noises are made at once, at most
  static constexpr std::size_t kVector = 16;

  // The coarse noises of cells first .. end of the block, whole chunks.
  void make_coarse(std::size_t block, std::size_t first, std::size_t end);
  double highest_in(const LandChunk& chunk) const;

  const LandModel& model_;
  LatticePath path_, coarse_path_;
  int shift_ = 0;
  float gain_;
  float finest_sum_ = 0.0f;  // amplitudes of the octaves at every cell
  OctavePath octaves_[4];
  std::size_t octave_count_ = 0;
  std::span<const NoiseOctave> coarse_fine_;
  std::size_t block_ = ~std::size_t{0};  // first cell of the block made
  std::size_t made_first_ = 0, made_end_ = 0;
  float broad_[kBlock + kVector], fine_[kBlock + kVector];
};

}  // namespace skerry::echo
