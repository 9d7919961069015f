#include "echo/kernel/rain_grid.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/isa.hpp"
#include "echo/kernel/relief_noise.hpp"

namespace skerry::echo {
namespace {

SKERRY_KERNEL_BODY add_grid_body(const GridView& grid, const GridWalk& walk, float weight,
                                 float more_weight, float* __restrict out, std::size_t n) {
  const float* const values = grid.values;
  const auto columns = static_cast<std::int32_t>(grid.columns);
  // Just short of the last value, so that there is one to the right and above.
  const float end_column = static_cast<float>(columns - 1) - 1e-3f;
  const float end_row = static_cast<float>(static_cast<std::int32_t>(grid.rows) - 1) - 1e-3f;
  const GridWalk w = walk;
  for (std::size_t j = 0; j < n; ++j) {
    const auto step = static_cast<float>(static_cast<std::int32_t>(j));
    float x = w.column + step * w.more_columns, y = w.row + step * w.more_rows;
    x = x > 0.0f ? x : 0.0f;
    y = y > 0.0f ? y : 0.0f;
    x = x < end_column ? x : end_column;
    y = y < end_row ? y : end_row;
    const auto ix = static_cast<std::int32_t>(x), iy = static_cast<std::int32_t>(y);
    const float fx = x - static_cast<float>(ix), fy = y - static_cast<float>(iy);
    const std::int32_t at = iy * columns + ix;
    const float a = values[at], b = values[at + 1];
    const float c = values[at + columns], d = values[at + columns + 1];
    const float low = a + fx * (b - a), high = c + fx * (d - c);
    out[j] += (weight + step * more_weight) * (low + fy * (high - low));
  }
}

SKERRY_KERNEL_BODY refine_row_body(const float* __restrict near, const float* __restrict other,
                                   float* __restrict fine, std::size_t coarse) {
  float before = 0.75f * near[0] + 0.25f * other[0];
  float here = 0.75f * near[1] + 0.25f * other[1];
  for (std::size_t i = 0; i < coarse; ++i) {
    const float after = 0.75f * near[i + 2] + 0.25f * other[i + 2];
    fine[2 * i] = 0.75f * here + 0.25f * before;
    fine[2 * i + 1] = 0.75f * here + 0.25f * after;
    before = here;
    here = after;
  }
}

SKERRY_KERNEL_BODY add_grain_body(std::uint32_t first, std::uint32_t salt, float now, float next,
                                  float* __restrict row, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t place = first + static_cast<std::uint32_t>(i) * kColumnStep;
    row[i] += now * corner(place) + next * corner(place + salt);
  }
}

SKERRY_KERNEL_BODY raise_row_body(const GridRise& rise, const float* __restrict outline,
                                  float* __restrict row, std::size_t n) {
  const GridRise by = rise;
  const float bend = 1.0f / (3.0f * by.most * by.most);
  for (std::size_t i = 0; i < n; ++i) {
    float value = row[i];
    value = value > -by.most ? value : -by.most;
    value = value < by.most ? value : by.most;
    const float octaves = by.spread * (value - value * value * value * bend) + outline[i];
    const float raised = fast_exp2(octaves > -100.0f ? octaves : -100.0f) - by.least;
    row[i] = raised > 0.0f ? raised : 0.0f;
  }
}

SKERRY_KERNEL(add_grid,
              (const GridView& grid, const GridWalk& walk, float weight, float more_weight,
               float* __restrict out, std::size_t n),
              (grid, walk, weight, more_weight, out, n))
SKERRY_KERNEL(refine_row,
              (const float* __restrict near, const float* __restrict other, float* __restrict fine,
               std::size_t coarse),
              (near, other, fine, coarse))
SKERRY_KERNEL(add_grain,
              (std::uint32_t first, std::uint32_t salt, float now, float next,
               float* __restrict row, std::size_t n),
              (first, salt, now, next, row, n))
SKERRY_KERNEL(raise_row,
              (const GridRise& rise, const float* __restrict outline, float* __restrict row,
               std::size_t n),
              (rise, outline, row, n))

}  // namespace

void add_grid(const GridView& grid, const GridWalk& walk, float weight, float more_weight,
              std::span<float> out) noexcept {
  add_grid(grid, walk, weight, more_weight, out.data(), out.size());
}

double grid_reference(const GridView& grid, double column, double row) {
  const double x = std::clamp(column, 0.0, static_cast<double>(grid.columns) - 1.0);
  const double y = std::clamp(row, 0.0, static_cast<double>(grid.rows) - 1.0);
  const auto ix = std::min(static_cast<std::uint32_t>(x), grid.columns - 2);
  const auto iy = std::min(static_cast<std::uint32_t>(y), grid.rows - 2);
  const double fx = x - ix, fy = y - iy;
  const auto value = [&](std::uint32_t i, std::uint32_t k) {
    return static_cast<double>(grid.at(ix + i, iy + k));
  };
  const double low = value(0, 0) + fx * (value(1, 0) - value(0, 0));
  const double high = value(0, 1) + fx * (value(1, 1) - value(0, 1));
  return low + fy * (high - low);
}

void refine_row(std::span<const float> near, std::span<const float> other,
                std::span<float> fine) noexcept {
  refine_row(near.data(), other.data(), fine.data(), fine.size() / 2);
}

void add_grain(std::uint32_t first, std::uint32_t salt, float now, float next,
               std::span<float> row) noexcept {
  add_grain(first, salt, now, next, row.data(), row.size());
}

void raise_row(const GridRise& rise, std::span<const float> outline,
               std::span<float> row) noexcept {
  raise_row(rise, outline.data(), row.data(), row.size());
}

}  // namespace skerry::echo
