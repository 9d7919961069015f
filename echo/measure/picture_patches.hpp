// Patches of a picture, and the numbers by which a classifier tells pictures apart.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "echo/measure/picture_turn.hpp"

namespace skerry::echo {

// What a patch is described by.  The first kMaskFeatures know only which cells echo; the others the
// levels too.  None knows where the patch lies, how much of it echoes, or how many levels there are
// beyond 16: these tell places and formats apart, not pictures.
inline constexpr std::size_t kMaskFeatures = 28, kPatchFeatures = 50;
using PatchFeatures = std::array<float, kPatchFeatures>;
std::string_view patch_feature_name(std::size_t feature);

struct PicturePatch {
  static constexpr std::uint32_t kSide = 64;  // spokes and cells

  std::uint32_t place = 0;     // of which own ship's place; given by the caller
  std::uint32_t quadrant = 0;  // of the bearing from the picture's zero, 0 to 3
  std::uint32_t spoke = 0, cell = 0;
  float occupancy = 0.0f;  // share of its cells that echo
  PatchFeatures features{};
};

// Patches that do not overlap, of those cells from `from_m` on; a patch counts if 5 to 98 % of its
// cells echo.  A cell echoes from the first of 16 levels on.  `turn` needs 64 spokes and cells at
// least; what is left over at the ends is not looked at.
// Error: std::invalid_argument as require_valid().
std::vector<PicturePatch> patches_of(const PictureTurn& turn, std::uint32_t place, double from_m);

}  // namespace skerry::echo
