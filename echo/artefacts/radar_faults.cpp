#include "echo/artefacts/radar_faults.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

float left_of(double loss_db) {
  return loss_db == 0.0 ? 1.0f : static_cast<float>(ratio_from_decibels(-loss_db));
}

}  // namespace

void FaultyReceiver::set(const RadarFaults& faults, double cell_m) {
  faults_ = faults;
  power_factor_ = left_of(faults.power_loss_db);
  tune_factor_ = left_of(faults.detuned_db);
  noise_factor_ = left_of(faults.noise_db);
  is_blind_ = faults.blind_width_deg > 0.0;
  blind_from_units_ = RelativeBearing::from(degrees(faults.blind_from_deg)).units();
  blind_width_units_ = faults.blind_width_deg >= 360.0
                           ? ~std::uint32_t{0}
                           : RelativeBearing::from(degrees(faults.blind_width_deg)).units();
  const double shift = faults.range_error_m / cell_m;
  shift_cells_ = static_cast<std::int64_t>(std::floor(shift));
  shift_part_ = static_cast<float>(shift - std::floor(shift));
  acts_ = faults.trigger_lost || is_blind_ || faults.range_error_m != 0.0 || noise_factor_ != 1.0f;
}

bool FaultyReceiver::is_blind(std::uint32_t relative_units) const {
  return faults_.trigger_lost ||
         (is_blind_ && relative_units - blind_from_units_ <= blind_width_units_);
}

void FaultyReceiver::apply(std::uint32_t relative_units, std::span<float> row,
                           std::span<float> closing) const {
  if (is_blind(relative_units)) {
    std::fill(row.begin(), row.end(), 0.0f);
    std::fill(closing.begin(), closing.end(), 0.0f);
    return;
  }
  if (shift_cells_ != 0 || shift_part_ != 0.0f) {
    thread_local std::vector<float> before;
    const auto size = static_cast<std::int64_t>(row.size());
    const auto at = [&](std::int64_t i) {
      return i < 0 || i >= size ? 0.0f : before[static_cast<std::size_t>(i)];
    };
    before.assign(row.begin(), row.end());
    for (std::int64_t i = 0; i < size; ++i) {
      const std::int64_t from = i - shift_cells_;
      row[static_cast<std::size_t>(i)] =
          (1.0f - shift_part_) * at(from) + shift_part_ * at(from - 1);
    }
    if (!closing.empty()) {
      before.assign(closing.begin(), closing.end());
      const std::int64_t whole = shift_cells_ + (shift_part_ < 0.5f ? 0 : 1);
      for (std::int64_t i = 0; i < size; ++i) closing[static_cast<std::size_t>(i)] = at(i - whole);
    }
  }
  if (noise_factor_ != 1.0f) {
    for (float& power : row) power *= noise_factor_;
  }
}

std::uint32_t row_cells_for_error(const ScanGeometry& geometry, RangeScale scale,
                                  std::uint32_t cells, double range_error_m) {
  if (range_error_m >= 0.0) return cells;
  const double beyond = cells - range_error_m / geometry.cell_size(scale).in_metres();
  const double quarters = std::ceil(4.0 * beyond / geometry.cells);
  const auto whole = static_cast<std::uint32_t>(std::min(8.0, quarters));
  return std::max(cells, (geometry.cells * whole + 3) / 4);
}

}  // namespace skerry::echo
