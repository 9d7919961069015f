#include "echo/radar/range_response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/shared_tables.hpp"

namespace skerry::echo {
namespace {

constexpr double kLog2E = 1.4426950408889634;
constexpr double kMostCells = 4096.0;
constexpr double kGaussianEnd = 0.97;  // 1 / B: where its answer to a step is kEnd
const double kGaussianRate = std::sqrt(2.0 * std::numbers::pi);

double exact_exp(double x) { return exact_exp2(std::max(x, -700.0) * kLog2E); }

// (1 + erf(x)) / 2.  Error: 8e-8 (Abramowitz and Stegun 7.1.26).
double gaussian_answer(double x) {
  const double z = std::fabs(x), t = 1.0 / (1.0 + 0.3275911 * z);
  const double poly =
      t *
      (0.254829592 + t * (-0.284496736 + t * (1.421413741 + t * (-1.453152027 + t * 1.061405429))));
  const double tail = 0.5 * poly * exact_exp(-z * z);
  return x < 0.0 ? tail : 1.0 - tail;
}

double two_pole_answer(double x) { return x > 0.0 ? 1.0 - (1.0 + x) * exact_exp(-x) : 0.0; }

double voltage_at(double x, const RangeShape& shape) {
  const double past = x - shape.pulse_cells, b = shape.bandwidth_cells;
  if (shape.filter == RangeFilter::gaussian)
    return gaussian_answer(kGaussianRate * b * x) - gaussian_answer(kGaussianRate * b * past);
  return two_pole_answer(4.0 * b * x) - two_pole_answer(4.0 * b * past);
}

double begin_of(const RangeShape& shape) {
  return shape.filter == RangeFilter::gaussian ? -kGaussianEnd / shape.bandwidth_cells : 0.0;
}

// In the middles of steps of so many cells from `begin` on, until it has decayed.
std::vector<double> voltages(const RangeShape& shape, double begin, double step) {
  std::vector<double> voltage;
  double peak = 0.0;
  for (double x = begin + 0.5 * step; x < shape.pulse_cells + kMostCells; x += step) {
    const double v = voltage_at(x, shape);
    peak = std::max(peak, v);
    if (x > shape.pulse_cells && v < RangeResponse::kEnd * peak) break;
    voltage.push_back(v);
  }
  return voltage;
}

bool is_sharp(const RangeShape& shape) {
  return shape.filter == RangeFilter::none || !(shape.bandwidth_cells > 0.0) ||
         shape.bandwidth_cells >= RangeResponse::kFastest;
}

}  // namespace

RangeResponse::RangeResponse(const RangeShape& shape)
    : pulse_cells_(std::max(1.0, shape.pulse_cells)) {
  if (is_sharp(shape)) {
    cells_ = static_cast<std::uint32_t>(std::ceil(pulse_cells_)) + 1;
    return;
  }
  const RangeShape own{shape.filter, pulse_cells_, shape.bandwidth_cells};
  const double step = 1.0 / kSteps;
  lead_ = static_cast<std::uint32_t>(std::min(kMostCells, std::ceil(-begin_of(own))));
  const std::vector<double> voltage = voltages(own, -static_cast<double>(lead_), step);
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
  static SharedTables<RangeShape, RangeResponse> tables;
  const RangeShape shape = range_shape(model);
  return tables.get(shape, [&] { return RangeResponse(shape); });
}

double coherence_cells(const RangeShape& shape) {
  constexpr double kE = 2.718281828459045;
  if (is_sharp(shape)) return (1.0 - 1.0 / kE) * shape.pulse_cells;
  const double step = shape.pulse_cells / 64.0;
  const std::vector<double> voltage = voltages(shape, begin_of(shape), step);
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

double range_voltage_reference(double x, const RangeShape& shape) {
  const double b = shape.bandwidth_cells;
  const auto answer = [&](double cells) {
    if (shape.filter == RangeFilter::gaussian)
      return 0.5 * std::erfc(-std::sqrt(2.0 * std::numbers::pi) * b * cells);
    const double a = 4.0 * b * std::max(0.0, cells);
    return 1.0 - (1.0 + a) * std::exp(-a);
  };
  return answer(x) - answer(x - std::max(1.0, shape.pulse_cells));
}

}  // namespace skerry::echo
