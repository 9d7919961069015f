// PatchForest: how surely a classifier tells two sets of patches apart.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "echo/measure/picture_patches.hpp"

namespace skerry::echo {

enum class PatchView : std::uint8_t { mask, all };  // which features

// One feature, and how surely it alone tells the sets apart.
struct TellingFeature {
  std::string_view name;
  double auc = 0.5;                  // 0.5 to 1, whichever set has more of it
  double first = 0.0, second = 0.0;  // medians
};

struct TellingApart {
  // Area under the curve of right against wrong calls, of pairs of one fold: 0.5 cannot, 1 always
  // can.
  double auc = 0.0;
  double least = 0.0, most = 0.0;        // of the folds
  std::size_t patches = 0;               // of each set, after matching
  std::size_t folds = 0;                 // that had any
  std::vector<TellingFeature> features;  // all that were looked at, what tells most first
};

struct TellingRules {
  std::uint64_t seed = 1;
  bool shuffled = false;    // labels are dealt anew, one for all turns of a patch
  std::size_t most = 1500;  // patches of each set
};

// A random forest of 200 trees and a PatchLine, of equal say, learn on patches of three quarters of
// the bearings and are asked about the others; each patch is asked about once.  A fold is a
// quadrant of all places: so a place and quadrant is wholly on one side, also where both sets show
// one and the same place.  As many patches of each set in each fold and fifth of occupancy are
// drawn, so that neither tells anything.  With `shuffled` what comes out is 0.5 to chance, or the
// folds leak.  A pure function of its arguments.
//
// Error: TooFewPatches where fewer than kLeastPatches of each are left, or fewer than two folds.
inline constexpr std::size_t kLeastPatches = 40;
struct TooFewPatches {
  std::size_t first = 0, second = 0, matched = 0;
};
TellingApart tell_apart(std::span<const PicturePatch> first, std::span<const PicturePatch> second,
                        PatchView view, const TellingRules& rules = {});

}  // namespace skerry::echo
