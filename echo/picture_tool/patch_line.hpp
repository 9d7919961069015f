// PatchLine: the weighted sum of features that best parts two sets of patches.
#pragma once

#include <span>
#include <vector>

#include "echo/measure/picture_patches.hpp"

namespace skerry::echo {

struct LabelledPatch {
  const PicturePatch* patch;
  int label;  // 0 or 1
};

// Fits label to features by least squares with a ridge (which for two labels is Fisher's
// discriminant), each feature over its standard deviation and cut at 4 of them; then gives the
// value of each patch that is asked about.  A small shift of many features, of which each tree of a
// forest sees a few, adds up here.  Only the first `features` of them count.  Requires both labels
// among the learnt.
std::vector<double> line_values(std::span<const LabelledPatch> learnt,
                                std::span<const LabelledPatch> asked, std::size_t features);

}  // namespace skerry::echo
