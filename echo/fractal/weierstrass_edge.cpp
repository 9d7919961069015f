#include "echo/fractal/weierstrass_edge.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/fractal/edge_refiner.hpp"
#include "echo/fractal/weierstrass_series.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/isa.hpp"

namespace skerry::echo {
namespace {

constexpr double kLongestEdge_m = 1e6;

// Every sum of terms goes in this many lanes, whatever the processor: the order is part of the
// result.
constexpr std::size_t kSumLanes = 8;

constexpr std::size_t whole_lanes(std::size_t terms) {
  return (terms + kSumLanes - 1) / kSumLanes * kSumLanes;
}

// out = in turned by (cos, sin), term by term; sum[i]: the real parts of terms i, i + kSumLanes and
// so on.
SKERRY_KERNEL_BODY turn_phasors_body(const double* __restrict in_re, const double* __restrict in_im,
                                     const double* __restrict cos, const double* __restrict sin,
                                     double* __restrict re, double* __restrict im,
                                     double* __restrict sum, std::size_t n) {
  for (std::size_t k = 0; k < n; ++k) {
    re[k] = in_re[k] * cos[k] - in_im[k] * sin[k];
    im[k] = in_re[k] * sin[k] + in_im[k] * cos[k];
  }
  for (std::size_t k = 0; k < n; k += kSumLanes) {
    for (std::size_t i = 0; i < kSumLanes; ++i) sum[i] += re[k + i];
  }
}

SKERRY_KERNEL(turn_phasors,
              (const double* __restrict in_re, const double* __restrict in_im,
               const double* __restrict cos, const double* __restrict sin, double* __restrict re,
               double* __restrict im, double* __restrict sum, std::size_t n),
              (in_re, in_im, cos, sin, re, im, sum, n))

// e^(2 pi i turns).
SinCos on_circle(double turns) { return sin_cos_degrees((turns - std::floor(turns)) * 360.0); }

// The variance over random phases, without c, of the middle less the mean of the ends.  A term's
// part is 1/2 gamma^(-2 H n) (1 - cos(pi gamma^n))^2.
double variance_of_middle(double gamma, double hurst) {
  const double log2_gamma = exact_log2(gamma);
  const auto part = [&](int n) {
    const double half_sine = on_circle(0.25 * exact_exp2(n * log2_gamma)).sin;
    const double bend = 2.0 * half_sine * half_sine;
    return 0.5 * exact_exp2(-2.0 * hurst * n * log2_gamma) * bend * bend;
  };
  // Upwards to waves of 2^-24 of the edge, the rest as their mean (bend^2 is 3/2); downwards as far
  // as 2^-20, where the parts have fallen to 2^-40 of the whole.
  double sum = 0.0;
  const int last = static_cast<int>(24.0 / log2_gamma),
            first = -static_cast<int>(20.0 / log2_gamma);
  for (int n = first; n <= last; ++n) sum += part(n);
  const double ratio = exact_exp2(-2.0 * hurst * log2_gamma);
  return sum + 0.75 * exact_exp2(-2.0 * hurst * (last + 1) * log2_gamma) / (1.0 - ratio);
}

}  // namespace

WeierstrassTables::WeierstrassTables(const CoastStyle& s, const FractionalBridge& bridge)
    : style(s) {
  const double hurst = bridge.hurst(), log2_gamma = exact_log2(s.gamma);
  const double c = 1.0 / std::sqrt(variance_of_middle(s.gamma, hurst));
  // A low term bends by gamma^(-H n) (2 pi gamma^n)^2 / 8 at most; those below it fall by gamma^-D.
  const double fall = exact_exp2(-(2.0 - hurst) * log2_gamma);
  const double bend_of_1 = c * std::numbers::pi * std::numbers::pi / 2.0;
  first = 0;
  for (double rest = bend_of_1 * fall / (1.0 - fall); rest > kLowTail; rest *= fall) --first;
  tail_ = 1.0 / (1.0 - exact_exp2(-hurst * log2_gamma));
  for (int n = first; static_cast<int>(waves.size()) < kMaxTerms; ++n) {
    waves.push_back(exact_exp2(n * log2_gamma));
    amplitude.push_back(c * exact_exp2(-hurst * n * log2_gamma));
    if (waves.back() * kFinest_m >= kLongestEdge_m) break;
  }
  for (std::uint32_t i = 0; i < 256; ++i) {
    const SinCos place = sin_cos_units(i << 24);
    circle_cos[i] = place.cos;
    circle_sin[i] = place.sin;
  }
  for (std::size_t level = 0; level < turns.size(); ++level) {
    const double part = half_to_the(static_cast<int>(level));
    for (double w : waves) {
      const SinCos turn = on_circle(w * part);
      turns[level].cos.push_back(turn.cos);
      turns[level].sin.push_back(turn.sin);
    }
    turns[level].cos.resize(whole_lanes(waves.size()), 1.0);
    turns[level].sin.resize(whole_lanes(waves.size()), 0.0);
  }
}

int WeierstrassTables::terms(double length_m, double gain_m) const {
  const auto too_short = std::lower_bound(waves.begin(), waves.end(), length_m / kFinest_m);
  // The sum left out from an amplitude on, doubled for the ends' share.
  const auto too_low = std::partition_point(amplitude.begin(), amplitude.end(), [&](double a) {
    return 2.0 * a * tail_ * gain_m > kFinest_m;
  });
  return static_cast<int>(std::max<std::ptrdiff_t>(
      std::min(too_short - waves.begin(), too_low - amplitude.begin()), 1 - first));
}

WeierstrassFunction::WeierstrassFunction(const WeierstrassTables& tables, int terms,
                                         std::uint64_t seed)
    : tables_(tables), terms_(whole_lanes(static_cast<std::size_t>(terms))) {
  const double side = (mixed(seed, 0x51DE) & 1u) ? 1.0 : -1.0;
  value_at_0_ = value_at_1_ = 0.0;
  for (std::size_t k = 0; k < terms_; ++k) {
    start_.re[k] = start_.im[k] = 0.0;
    if (k >= static_cast<std::size_t>(terms)) continue;
    const int n = tables.first + static_cast<int>(k);
    SinCos phase{.sin = 0.0, .cos = side};
    if (tables.style.phases == SeriesPhases::alternating) phase = {(n & 1) ? side : -side, 0.0};
    if (tables.style.phases == SeriesPhases::random) {
      const std::uint32_t place = random_phase(seed, n) >> 24;
      phase = {tables.circle_sin[place], tables.circle_cos[place]};
    }
    start_.re[k] = tables.amplitude[k] * phase.cos;
    start_.im[k] = tables.amplitude[k] * phase.sin;
    value_at_0_ += start_.re[k];
    value_at_1_ += start_.re[k] * tables.turns[0].cos[k] - start_.im[k] * tables.turns[0].sin[k];
  }
}

double WeierstrassFunction::middle(State left_end, int level, std::int64_t piece,
                                   Halves& at) const {
  const WeierstrassTables::Turns& turn = tables_.turns[static_cast<std::size_t>(level) + 1];
  double sum[kSumLanes] = {};
  turn_phasors(left_end->re.data(), left_end->im.data(), turn.cos.data(), turn.sin.data(),
               at.re.data(), at.im.data(), sum, terms_);
  double value = 0.0;
  for (const double lane : sum) value += lane;
  const double t = static_cast<double>(2 * piece + 1) * half_to_the(level + 1);
  return value - ((1.0 - t) * value_at_0_ + t * value_at_1_);
}

namespace {

class WeierstrassMethod final : public EdgeMethod {
 public:
  explicit WeierstrassMethod(const CoastStyle& style)
      : style_(style), tables_(style, style_.bridge) {}

  void refine(const GrowingEdge& edge, const DetailLimit& limit,
              std::vector<PlanePoint>& out) const override {
    const OffsetGraph graph(style_, edge);
    if (graph.is_straight() || !graph.is_halved(0, graph.first(), graph.last(), limit)) {
      out.push_back(edge.to);
      return;
    }
    const WeierstrassFunction function(
        tables_, tables_.terms(graph.length_m(), graph.most_gain_m()), edge.seed);
    GraphGrower(graph, function, limit, out)
        .grow(function.start(), 0, 0, graph.first(), graph.last());
  }

 private:
  GraphStyle style_;
  WeierstrassTables tables_;
};

}  // namespace

std::unique_ptr<const EdgeMethod> make_weierstrass_method(const CoastStyle& style) {
  return std::make_unique<WeierstrassMethod>(style);
}

}  // namespace skerry::echo
