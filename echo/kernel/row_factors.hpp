// Factors on rows of power.
#pragma once

#include <span>

namespace skerry::echo {

// row[i] *= factor.
void scale_row(std::span<float> row, float factor) noexcept;

}  // namespace skerry::echo
