#include "echo/targets/far_lobes.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "echo/kernel/coherent_receiver.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/targets/point_echo.hpp"
#include "echo/targets/sector_view.hpp"

namespace skerry::echo {
namespace {

constexpr double kLobeDeg = 1.4;
constexpr float kLeastLevel = 0.05f;  // of the noise
constexpr float kLeastShare = 1e-4f;  // of a cell
constexpr std::uint32_t kMaxLobeRows = 64;
constexpr std::size_t kRunCells = 16;

}  // namespace

FarLobes::FarLobes(const RadarModel& model)
    : model_(model),
      least_power_(static_cast<float>(kLeastLobePower /
                                      ratio_from_decibels(2.0 * model.set.far_side_lobe_db))) {
  const double spoke_deg = 360.0 / model.geometry.spokes_per_turn;
  lobe_spokes_ = std::max(1u, static_cast<std::uint32_t>(kLobeDeg / spoke_deg + 0.5));
}

void FarLobes::lay(const StrongEchoes& strong) {
  points_.clear();
  const double cells = model_.geometry.cells;
  const double pulse = std::max(1.0, model_.pulse_cells);
  for (std::size_t i = 0; i < strong.points.size();) {
    const PointEcho& echo = strong.points[i];
    double start = cells, end = 0.0, power = 0.0;
    for (; i < strong.points.size() && strong.points[i].body == echo.body; ++i) {
      const double at = strong.points[i].range_m / model_.cell_m;
      if (!(at >= 0.0) || at >= cells) continue;
      start = std::min(start, at), end = std::max(end, at + pulse);
      power += static_cast<double>(std::min(strong.points[i].power, kMaxPointPower));
    }
    if (start >= cells) continue;
    const auto mean = static_cast<float>(power * pulse / (end - start));
    if (!(mean > least_power_)) continue;
    const auto cell = static_cast<std::uint32_t>(start), last = static_cast<std::uint32_t>(end);
    const auto lead = static_cast<float>(1.0 - (start - cell));
    const auto tail = static_cast<float>(end - last);
    points_.push_back({echo.bearing_units, echo.body, cell, last - cell - 1, mean,
                       lead < kLeastShare ? 0.0f : lead, tail < kLeastShare ? 0.0f : tail});
  }
}

void FarLobes::prepare(const AntennaPattern& pattern, const StrongEchoes& strong,
                       std::span<const std::uint32_t> met, std::uint32_t near_units,
                       const SpokeAim& first, const SpokeAim& last) {
  clear();
  if (strong.version != laid_) {
    lay(strong);
    laid_ = strong.version;
  }
  if (points_.empty()) return;
  const std::uint32_t cells = model_.geometry.cells;
  const auto spokes = static_cast<std::uint32_t>(last.spoke - first.spoke) + 1;
  // Never more rows than there is room for, however long the sector.
  row_spokes_ = std::max(lobe_spokes_, (spokes + kMaxLobeRows - 1) / kMaxLobeRows);
  const std::uint32_t rows = (spokes + row_spokes_ - 1) / row_spokes_;
  first_spoke_ = first.spoke;
  pitch_ = (cells + kRunCells - 1) / kRunCells * kRunCells;
  if (rows_.size() < rows * pitch_) rows_.resize(rows * pitch_);
  taken_.assign(rows * pitch_ / kRunCells, 0);
  const std::int64_t turned = static_cast<std::int32_t>(last.plane_units - first.plane_units);
  const std::uint32_t middle = first.plane_units + static_cast<std::uint32_t>(turned / 2);
  std::array<std::uint32_t, kMaxLobeRows> axes;
  for (std::uint32_t r = 0; r < rows; ++r) {
    // Twice the spoke in the middle of those that share the row.
    const std::int64_t twice = std::min(2 * spokes - 2, row_spokes_ * (2 * r + 1) - 1);
    const std::int64_t along = spokes > 1 ? turned * twice / (2 * (spokes - 1)) : 0;
    axes[r] = first.plane_units + static_cast<std::uint32_t>(along);
  }
  for (const Point& point : points_) {
    if (units_apart(point.units, middle) <= near_units) continue;
    if (std::find(met.begin(), met.end(), point.body) != met.end()) continue;
    const std::uint32_t tail = point.cell + point.full + 1;
    const std::uint32_t full_end = std::min(tail, cells);
    for (std::uint32_t r = 0; r < rows; ++r) {
      const float level = point.power * pattern.two_way(units_apart(point.units, axes[r]));
      if (level < kLeastLevel) continue;
      take(r, point.cell / kRunCells, std::min(tail, cells - 1) / kRunCells);
      float* row = rows_.data() + r * pitch_;
      row[point.cell] += level * point.lead;
      for (std::uint32_t c = point.cell + 1; c < full_end; ++c) row[c] += level;
      if (tail < cells) row[tail] += level * point.tail;
    }
  }
  find_runs(rows);
}

// Zeros where nothing was yet.
void FarLobes::take(std::size_t row, std::size_t first_run, std::size_t last_run) {
  std::uint8_t* const taken = taken_.data() + row * (pitch_ / kRunCells);
  for (std::size_t b = first_run; b <= last_run; ++b) {
    if (taken[b] != 0) continue;
    taken[b] = 1;
    std::fill_n(rows_.begin() + static_cast<std::ptrdiff_t>(row * pitch_ + b * kRunCells),
                kRunCells, 0.0f);
  }
}

// Once for all spokes of a row: most of it is empty.
void FarLobes::find_runs(std::uint32_t rows) {
  runs_.clear();
  const std::size_t runs = pitch_ / kRunCells;
  for (std::uint32_t r = 0; r < rows; ++r) {
    begins_.push_back(runs_.size());
    const std::uint8_t* const taken = taken_.data() + r * runs;
    for (std::size_t b = 0; b < runs;) {
      const void* const found = std::memchr(taken + b, 1, runs - b);
      if (found == nullptr) break;
      b = static_cast<std::size_t>(static_cast<const std::uint8_t*>(found) - taken);
      std::size_t end = b + 1;
      while (end < runs && taken[end] != 0) ++end;
      const std::size_t first = b * kRunCells;
      const std::size_t last = std::min<std::size_t>(end * kRunCells, model_.geometry.cells);
      runs_.push_back(
          {static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(last - first)});
      b = end;
    }
  }
  begins_.push_back(runs_.size());
}

void FarLobes::add(const SpokeAim& aim, std::span<float> power) const {
  if (begins_.empty() || aim.spoke < first_spoke_) return;
  const std::size_t r = static_cast<std::size_t>(aim.spoke - first_spoke_) / row_spokes_;
  if (r + 1 >= begins_.size()) return;
  const float* const row = rows_.data() + r * pitch_;
  for (std::size_t i = begins_[r]; i < begins_[r + 1]; ++i) {
    const Run& run = runs_[i];
    add_row(power.subspan(run.first, run.count), {row + run.first, run.count});
  }
}

}  // namespace skerry::echo
