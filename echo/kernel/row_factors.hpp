// Factors on rows of power.
#pragma once

#include <span>

namespace skerry::echo {

// row[i] *= factors[i].  Requires factors.size() >= row.size(), no overlap.
void multiply_row(std::span<float> row, std::span<const float> factors) noexcept;

// row[i] *= factor.
void scale_row(std::span<float> row, float factor) noexcept;

}  // namespace skerry::echo
