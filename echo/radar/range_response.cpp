#include "echo/radar/range_response.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/shared_tables.hpp"

namespace skerry::echo {
namespace {

constexpr double kLog2E = 1.4426950408889634;
constexpr double kMostCells = 4096.0;

// 1 - (1 + x) e^-x: the filter's answer to a step, x >= 0.
double step_answer(double x) { return 1.0 - (1.0 + x) * exact_exp2(-std::min(x, 500.0) * kLog2E); }

// In the middles of steps of so many cells, until it has decayed.
std::vector<double> voltages(double pulse_cells, double a, double step) {
  std::vector<double> voltage;
  double peak = 0.0;
  for (double x = 0.5 * step; x < pulse_cells + kMostCells; x += step) {
    const double past = x - pulse_cells;
    const double v = step_answer(a * x) - (past > 0.0 ? step_answer(a * past) : 0.0);
    peak = std::max(peak, v);
    if (past > 0.0 && v < RangeResponse::kEnd * peak) break;
    voltage.push_back(v);
  }
  return voltage;
}

bool is_fast(double poles_per_cell) {
  return !(poles_per_cell > 0.0) || poles_per_cell >= RangeResponse::kFastest;
}

}  // namespace

RangeResponse::RangeResponse(double pulse_cells, double poles_per_cell)
    : pulse_cells_(std::max(1.0, pulse_cells)) {
  const double a = poles_per_cell;
  if (is_fast(a)) {
    cells_ = static_cast<std::uint32_t>(std::ceil(pulse_cells_)) + 1;
    return;
  }
  const double step = 1.0 / kSteps;
  const std::vector<double> voltage = voltages(pulse_cells_, a, step);
  const double peak = *std::max_element(voltage.begin(), voltage.end());
  sums_.assign(1, 0.0);
  for (const double v : voltage) sums_.push_back(sums_.back() + v * v / (peak * peak) * step);
  cells_ = static_cast<std::uint32_t>(voltage.size() / kSteps) + 2;
  sums_.resize((cells_ + std::size_t{1}) * kSteps + 1, sums_.back());

  tap_cells_ = (cells_ + kMostTaps - 1) / kMostTaps;
  for (std::uint32_t cell = 0; cell < cells_; cell += tap_cells_) {
    const std::uint32_t end = std::min(cell + tap_cells_, cells_);
    const double power = sums_[end * kSteps] - sums_[cell * kSteps];
    taps_.push_back(static_cast<float>(power / tap_cells_));
  }
}

void RangeResponse::shares_of(double into, std::span<float> shares) const {
  if (is_box()) {
    const double end = into + pulse_cells_;
    for (std::size_t c = 0; c < shares.size(); ++c) {
      const auto cell = static_cast<double>(c);
      const double share = std::min(end, cell + 1.0) - std::max(into, cell);
      shares[c] = static_cast<float>(std::max(0.0, share));
    }
    return;
  }
  // Sums to places between two steps joined straight.
  const double at = into * kSteps;
  const auto whole = static_cast<std::size_t>(at);
  const double rest = at - static_cast<double>(whole);
  double before = 0.0;
  for (std::size_t c = 0; c < shares.size(); ++c) {
    const std::size_t upper = (c + 1) * kSteps - whole;
    const double sum = upper > 0 ? sums_[upper] + rest * (sums_[upper - 1] - sums_[upper]) : 0.0;
    shares[c] = static_cast<float>(sum - before);
    before = sum;
  }
}

std::shared_ptr<const RangeResponse> range_response_for(const RadarModel& model) {
  static SharedTables<std::pair<double, double>, RangeResponse> tables;
  return tables.get({model.pulse_cells, model.poles_per_cell},
                    [&] { return RangeResponse(model.pulse_cells, model.poles_per_cell); });
}

double coherence_cells(double pulse_cells, double poles_per_cell) {
  constexpr double kE = 2.718281828459045;
  if (is_fast(poles_per_cell)) return (1.0 - 1.0 / kE) * pulse_cells;
  const double step = pulse_cells / 64.0;
  const std::vector<double> voltage = voltages(pulse_cells, poles_per_cell, step);
  const auto overlap = [&](std::size_t lag) {
    double sum = 0.0;
    for (std::size_t i = 0; i + lag < voltage.size(); ++i) sum += voltage[i] * voltage[i + lag];
    return sum;
  };
  const double least = overlap(0) / kE;
  double before = overlap(0);
  for (std::size_t lag = 1; lag < voltage.size(); ++lag) {
    const double here = overlap(lag);
    if (here <= least) return step * (static_cast<double>(lag) - (least - here) / (before - here));
    before = here;
  }
  return step * static_cast<double>(voltage.size());
}

double range_voltage_reference(double x, double pulse_cells, double poles_per_cell) {
  const auto answer = [&](double cells) {
    const double a = poles_per_cell * std::max(0.0, cells);
    return 1.0 - (1.0 + a) * std::exp(-a);
  };
  return answer(x) - answer(x - std::max(1.0, pulse_cells));
}

}  // namespace skerry::echo
