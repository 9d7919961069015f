// The loops behind a field of rain: grown level by level, read along a ray.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace skerry::echo {

// Values on a square lattice, row by row.
struct GridView {
  const float* values = nullptr;
  std::uint32_t columns = 0, rows = 0;  // each at least 2
  float at(std::uint32_t column, std::uint32_t row) const { return values[row * columns + column]; }
};

// A straight way over a grid, in its columns and rows.
struct GridWalk {
  float column = 0.0f, row = 0.0f, more_columns = 0.0f, more_rows = 0.0f;  // per step
};

// out[j] += (weight + j * more_weight) * the grid at the j-th place, bilinear between its values; a
// place outside counts as the nearest one inside.  Error: float roundings, of which the place's are
// 1e-4 of a column; held by RainGrid.ReadsBetweenValuesAsItsReference.
void add_grid(const GridView& grid, const GridWalk& walk, float weight, float more_weight,
              std::span<float> out) noexcept;
double grid_reference(const GridView& grid, double column, double row);

// One row of a lattice twice as fine: each value is 9/16, 3/16, 3/16 and 1/16 of the four coarse
// ones around it (a quadratic spline).  near and other: the coarse rows, three quarters and a
// quarter; fine[2 i] and fine[2 i + 1] lie to both sides of coarse value i + 1.  Requires
// near.size() = other.size() = fine.size() / 2 + 2.
void refine_row(std::span<const float> near, std::span<const float> other,
                std::span<float> fine) noexcept;

// row[i] += now * (random value of place i) + next * (another): in [-1, 1], of the hash of
// first + i * kColumnStep (relief_noise.hpp) and of that with `salt` added.
void add_grain(std::uint32_t first, std::uint32_t salt, float now, float next,
               std::span<float> row) noexcept;

// row[i] = max(0, 2^(spread * bent(row[i]) + outline[i]) - least), the exponent at least -100.
// bent(v) = v - v^3 / (3 most^2), v held to +-most: goes with small values and flattens to 2/3
// most. Requires spread * 2/3 most + outline[i] <= 100.
struct GridRise {
  float spread = 1.0f, most = 4.0f, least = 0.0f;
};
void raise_row(const GridRise& rise, std::span<const float> outline, std::span<float> row) noexcept;

}  // namespace skerry::echo
