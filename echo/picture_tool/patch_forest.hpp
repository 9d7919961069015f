// PatchForest: how surely a classifier tells two sets of patches apart.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "echo/measure/picture_patches.hpp"

namespace skerry::echo {

enum class PatchView : std::uint8_t { mask, all };  // which features

struct TellingApart {
  double auc = 0.0;  // area under the curve of right against wrong calls: 0.5 cannot, 1 always can
  std::size_t patches = 0;             // of each set, after matching
  std::vector<std::string> strongest;  // the five features that one by one tell most, best first
};

// A random forest of 200 trees learns on patches of three quarters of the places' bearings and is
// asked about the others; each patch is asked about once.  A place and quadrant is wholly on one
// side.  As many patches of each set in each fifth of occupancy are drawn, at most `most` of each
// set; a pure function of both sets and the seed.
// `shuffled`: labels are dealt anew, one for all turns of a patch: what comes out is then 0.5, or
// the folds leak.
// Error: TooFewPatches where fewer than kLeastPatches of each are left.
inline constexpr std::size_t kLeastPatches = 40;
struct TooFewPatches {
  std::size_t first = 0, second = 0, matched = 0;
};
TellingApart tell_apart(std::span<const PicturePatch> first, std::span<const PicturePatch> second,
                        PatchView view, std::uint64_t seed, bool shuffled = false,
                        std::size_t most = 1500);

}  // namespace skerry::echo
