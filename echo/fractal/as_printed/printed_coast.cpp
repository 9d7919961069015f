#include "echo/fractal/as_printed/printed_coast.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo::as_printed {
namespace {

void require(const char* what, double value, double min, double max) {
  if (value >= min && value <= max) return;  // false for NaN
  throw std::invalid_argument(std::string("coast as printed: ") + what + " is " +
                              std::to_string(value) + "; allowed: " + std::to_string(min) + " to " +
                              std::to_string(max));
}

void require_finite(std::span<const PixelPoint> line) {
  constexpr double kFarthest = 1e9;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (std::fabs(line[i].x_px) <= kFarthest && std::fabs(line[i].y_px) <= kFarthest) continue;
    throw std::invalid_argument("coast as printed: point " + std::to_string(i) + " is (" +
                                std::to_string(line[i].x_px) + ", " + std::to_string(line[i].y_px) +
                                ") pixels; allowed: -1e9 to 1e9");
  }
}

double length_of(PixelPoint a, PixelPoint b) {
  const double dx = b.x_px - a.x_px, dy = b.y_px - a.y_px;
  return std::sqrt(dx * dx + dy * dy);
}

PixelPoint between(PixelPoint a, PixelPoint b, double part) {
  return {a.x_px + (b.x_px - a.x_px) * part, a.y_px + (b.y_px - a.y_px) * part};
}

// `part` of the way from a to b, and `aside` lengths of a - b to the left of it (y runs down).
PixelPoint beside(PixelPoint a, PixelPoint b, double part, double aside) {
  const PixelPoint p = between(a, b, part);
  return {p.x_px + (b.y_px - a.y_px) * aside, p.y_px - (b.x_px - a.x_px) * aside};
}

// Standard normal (Box and Muller 1958).
double gauss(std::uint64_t hash) {
  const double u = as_unit(hash) + 0x1p-54;  // above 0
  const double radius = std::sqrt(-2.0 * std::numbers::ln2 * exact_log2(u));
  return radius * sin_cos_units(static_cast<std::uint32_t>(mixed(hash) >> 32)).cos;
}

// Refines edge after edge and appends what comes after each edge's beginning.
class Refiner {
 public:
  Refiner(const Parameters& parameters, double sigma_px) : p_(parameters), series_(parameters) {
    const double root = std::sqrt(std::max(0.0, 1.0 - exact_exp2(2.0 * p_.hurst - 2.0)));
    for (int i = 1; i <= p_.iterations; ++i)
      spread_.push_back(sigma_px * exact_exp2(-i * p_.hurst) * root);
  }

  std::vector<PixelPoint> run(std::span<const PixelPoint> line) {
    refuse_more_than_allowed(line);
    push(line.front());
    for (std::size_t i = 0; i + 1 < line.size(); ++i) {
      chart_edge(line[i], line[i + 1], mixed(p_.seed, i));
    }
    return std::move(out_);
  }

 private:
  bool is_koch() const {
    return p_.method == CoastMethod::regular_koch || p_.method == CoastMethod::random_koch;
  }
  bool is_refined_further(PixelPoint a, PixelPoint b, int iteration) const {
    return iteration <= p_.iterations &&
           !(p_.threshold_px > 0.0 && length_of(a, b) <= p_.threshold_px);
  }
  double pieces_of(PixelPoint a, PixelPoint b) const {
    if (!is_koch() || p_.control_value_px == 0.0) return 1.0;
    return std::max(1.0, std::ceil(length_of(a, b) / p_.control_value_px));
  }

  [[noreturn]] void refuse(const std::string& count) const {
    throw std::length_error("coast as printed: " + std::to_string(p_.iterations) +
                            " iterations would make " + count +
                            " points; allowed: " + std::to_string(p_.most_points) +
                            ". Take fewer iterations, a shorter coast or a threshold L");
  }

  void refuse_more_than_allowed(std::span<const PixelPoint> line) const {
    double edges = 0.0;
    for (std::size_t i = 0; i + 1 < line.size(); ++i) edges += pieces_of(line[i], line[i + 1]);
    if (p_.threshold_px == 0.0 && p_.method != CoastMethod::straight) {
      edges *= std::pow(is_koch() ? 4.0 : 2.0, p_.iterations);
    }
    if (edges + 1.0 > static_cast<double>(p_.most_points)) refuse(std::to_string(edges + 1.0));
  }

  void push(PixelPoint p) {
    if (out_.size() >= p_.most_points) refuse("more");
    out_.push_back(p);
  }

  void chart_edge(PixelPoint a, PixelPoint b, std::uint64_t seed) {
    switch (p_.method) {
      case CoastMethod::straight:
        return push(b);
      case CoastMethod::regular_koch:
      case CoastMethod::random_koch: {
        const auto pieces = static_cast<std::uint64_t>(pieces_of(a, b));
        PixelPoint from = a;
        for (std::uint64_t k = 1; k <= pieces; ++k) {
          const PixelPoint to =
              k == pieces ? b : between(a, b, static_cast<double>(k) / static_cast<double>(pieces));
          koch(from, to, mixed(seed, k), 1);
          from = to;
        }
        return;
      }
      case CoastMethod::midpoint:
        return midpoint(a, b, seed, 1);
      case CoastMethod::weierstrass:
        first_ = a;
        last_ = b;
        return halve(a, b, 0.0, 1.0, 1);
    }
  }

  void koch(PixelPoint a, PixelPoint b, std::uint64_t seed, int iteration) {
    if (!is_refined_further(a, b, iteration)) return push(b);
    const double height = p_.apex_factor * std::numbers::sqrt3 / 6.0;
    const bool right = p_.method == CoastMethod::random_koch && (mixed(seed) >> 63) != 0;
    const PixelPoint corners[5] = {a, between(a, b, 1.0 / 3.0),
                                   beside(a, b, 0.5, right ? -height : height),
                                   between(a, b, 2.0 / 3.0), b};
    for (std::uint64_t k = 0; k < 4; ++k) {
      koch(corners[k], corners[k + 1], mixed(seed, k + 1), iteration + 1);
    }
  }

  void midpoint(PixelPoint a, PixelPoint b, std::uint64_t seed, int iteration) {
    if (!is_refined_further(a, b, iteration)) return push(b);
    const double h = spread_[static_cast<std::size_t>(iteration - 1)] * gauss(mixed(seed));
    const PixelPoint middle{(a.x_px + b.x_px) / 2.0 + h, (a.y_px + b.y_px) / 2.0 + h};
    midpoint(a, middle, mixed(seed, 1), iteration + 1);
    midpoint(middle, b, mixed(seed, 2), iteration + 1);
  }

  void halve(PixelPoint a, PixelPoint b, double t0, double t1, int iteration) {
    if (!is_refined_further(a, b, iteration)) return push(b);
    const double t = 0.5 * (t0 + t1);
    const PixelPoint middle = beside(first_, last_, t, p_.amplitude * series_.at(t));
    halve(a, middle, t0, t, iteration + 1);
    halve(middle, b, t, t1, iteration + 1);
  }

  const Parameters& p_;
  Series series_;
  std::vector<double> spread_;  // of h_i, pixels, by iteration
  PixelPoint first_, last_;     // of the edge that a series grows on
  std::vector<PixelPoint> out_;
};

}  // namespace

void require_valid(const Parameters& p) {
  require("iterations", p.iterations, 1, 8);
  require("threshold L in pixels", p.threshold_px, 0.0, 1e6);
  if (p.control_value_px != 0.0)
    require("control value c in pixels (or 0 for none)", p.control_value_px, 1.0, 1e6);
  require("apex factor", p.apex_factor, 0.0, 2.0);
  require("H", p.hurst, 0.0, 1.0);
  if (p.sigma_px) require("sigma in pixels", *p.sigma_px, 0.0, 1e6);
  require("dimension", p.dimension, 1.0, 1.99);
  require("gamma", p.gamma, 1.01, 8.0);
  require("number of terms below 0", p.terms_below, 0, 300);
  require("number of terms above 0", p.terms_above, 0, 300);
  require("amplitude", p.amplitude, 0.0, 10.0);
  require("greatest number of points", static_cast<double>(p.most_points), 2,
          static_cast<double>(kMostPoints));
  if (p.phases == SeriesPhases::random) {
    throw std::invalid_argument(
        "coast as printed: phases are random; allowed: cosine (0), alternating (n pi)");
  }
}

std::vector<PixelPoint> refine(std::span<const PixelPoint> line, const Parameters& parameters) {
  require_valid(parameters);
  require_finite(line);
  if (line.size() < 2) return {line.begin(), line.end()};
  return Refiner(parameters, parameters.sigma_px.value_or(deviation_of_heights(line))).run(line);
}

double deviation_of_heights(std::span<const PixelPoint> line) {
  if (line.empty()) return 0.0;
  const auto n = static_cast<double>(line.size());
  double mean = 0.0, squares = 0.0;
  for (const PixelPoint& p : line) mean += p.y_px / n;
  for (const PixelPoint& p : line) squares += (p.y_px - mean) * (p.y_px - mean);
  return std::sqrt(squares / n);
}

Series::Series(const Parameters& p) : sines_(p.phases == SeriesPhases::alternating) {
  require_valid(p);
  const double octaves = exact_log2(p.gamma);
  for (int n = -p.terms_below; n <= p.terms_above; ++n) {
    const double weight = exact_exp2(-(2.0 - p.dimension) * n * octaves);
    terms_.push_back(
        {exact_exp2(n * octaves) / kRadiansPerTurn, sines_ && n % 2 != 0 ? -weight : weight});
  }
}

double Series::at(double t) const {
  constexpr double kMostTurns = 0x1p53 / kRadiansPerTurn;
  double sum = 0.0;
  for (const Term& term : terms_) {
    const double turns = term.turns * t;
    if (std::fabs(turns) > kMostTurns) break;  // and so are all that follow
    const SinCos wave = sin_cos_degrees(360.0 * (turns - std::floor(turns + 0.5)));
    // 1 - cos x as sin^2 / (1 + cos): the waves longer than t would be lost in rounding.
    const double rise = wave.cos > 0.0 ? wave.sin * wave.sin / (1.0 + wave.cos) : 1.0 - wave.cos;
    sum += term.weight * (sines_ ? wave.sin : rise);
  }
  return sum;
}

}  // namespace skerry::echo::as_printed
