#include "echo/measure/graph_roughness.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

constexpr std::size_t kBlocks = 32;

double variation(double from, double to, double power) {
  const double apart = std::fabs(to - from);
  return power == 2.0 ? apart * apart : power == 1.0 ? apart : std::pow(apart, power);
}

// Sums of the variation by lag, of the pairs that begin in each block.
struct BlockSums {
  std::vector<double> sum, pairs;  // by lag
};

double variation_dimension(const std::vector<double>& log_lag, const std::vector<BlockSums>& blocks,
                           std::span<const std::uint32_t> drawn, double power) {
  std::vector<double> y(log_lag.size());
  for (std::size_t k = 0; k < y.size(); ++k) {
    double sum = 0.0, pairs = 0.0;
    for (std::uint32_t b : drawn) {
      sum += blocks[b].sum[k];
      pairs += blocks[b].pairs[k];
    }
    y[k] = std::log(sum / pairs);
  }
  return 2.0 - fitted_line(log_lag, y).slope / power;
}

DimensionEstimate graph_dimension(std::span<const double> heights, double power, int longest_lag) {
  const std::size_t n = heights.size();
  if (longest_lag < 2 || n < kBlocks * static_cast<std::size_t>(longest_lag))
    return {kNotKnown, kNotKnown, {kNotKnown, kNotKnown}};
  std::vector<double> log_lag;
  std::vector<BlockSums> blocks(kBlocks);
  for (std::size_t lag = 1; lag <= static_cast<std::size_t>(longest_lag); lag *= 2) {
    log_lag.push_back(std::log(static_cast<double>(lag)));
    for (BlockSums& block : blocks) {
      block.sum.push_back(0.0);
      block.pairs.push_back(0.0);
    }
    for (std::size_t i = 0; i + lag < n; ++i) {
      BlockSums& block = blocks[i * kBlocks / n];
      block.sum.back() += variation(heights[i], heights[i + lag], power);
      block.pairs.back() += 1.0;
    }
  }
  std::vector<std::uint32_t> all(kBlocks);
  for (std::uint32_t b = 0; b < kBlocks; ++b) all[b] = b;
  const auto of = [&](std::span<const std::uint32_t> drawn) {
    return variation_dimension(log_lag, blocks, drawn, power);
  };
  const double dimension = of(all);
  if (!std::isfinite(dimension)) return {kNotKnown, kNotKnown, {kNotKnown, kNotKnown}};
  const double memory = (0.017 + 0.05 * std::max(0.0, 1.4 - dimension)) *
                        std::pow(64.0 * longest_lag / static_cast<double>(n), 0.2);
  const double error = std::max(bootstrap(kBlocks, of).standard_error, memory);
  return {dimension, error, {dimension - 2.0 * error, dimension + 2.0 * error}};
}

// Means of term(i, lag) over all i with i + reach * lag in the graph.
template <typename Term>
std::vector<GraphVariation> by_lag(std::size_t heights, int longest_lag, std::size_t reach,
                                   Term&& term) {
  std::vector<GraphVariation> out;
  const auto longest = static_cast<std::size_t>(std::max(longest_lag, 0));
  for (std::size_t lag = 1; lag <= longest && reach * lag < heights; lag *= 2) {
    const std::size_t terms = heights - reach * lag;
    double sum = 0.0;
    for (std::size_t i = 0; i < terms; ++i) sum += term(i, lag);
    out.push_back({static_cast<int>(lag), sum / static_cast<double>(terms)});
  }
  return out;
}

}  // namespace

std::vector<GraphVariation> graph_variation(std::span<const double> heights, double power,
                                            int longest_lag) {
  return by_lag(heights.size(), longest_lag, 1, [&](std::size_t i, std::size_t lag) {
    return variation(heights[i], heights[i + lag], power);
  });
}

std::vector<GraphVariation> second_variation(std::span<const double> heights, int longest_lag) {
  return by_lag(heights.size(), longest_lag, 2, [&](std::size_t i, std::size_t lag) {
    return variation(heights[i + lag] - heights[i], heights[i + 2 * lag] - heights[i + lag], 2.0);
  });
}

DimensionEstimate variogram_dimension(std::span<const double> heights, int longest_lag) {
  return graph_dimension(heights, 2.0, longest_lag);
}

DimensionEstimate madogram_dimension(std::span<const double> heights, int longest_lag) {
  return graph_dimension(heights, 1.0, longest_lag);
}

std::vector<SpectrumOctave> power_spectrum(std::span<const double> heights) {
  constexpr double kMostPerOctave = 24.0;
  const std::size_t n = heights.size();
  if (n < 32) return {};
  const double steps = static_cast<double>(n - 1);
  std::vector<double> h(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = static_cast<double>(i) / steps;
    const double hann = 0.5 - 0.5 * std::cos(kRadiansPerTurn * t);
    h[i] = (heights[i] - heights[0] - (heights[n - 1] - heights[0]) * t) * hann;
  }
  std::vector<SpectrumOctave> out;
  for (double low = 4.0; 2.0 * low <= static_cast<double>(n) / 2.0; low *= 2.0) {
    const double frequencies = std::min(low, kMostPerOctave);
    double sum = 0.0;
    for (double k = 0.0; k < frequencies; ++k) {
      // Whole cycles in the graph, so that the window's neighbours are those of a plain DFT.
      const double cycles = std::floor(low * std::exp2((k + 0.5) / frequencies) + 0.5);
      const double turn = kRadiansPerTurn * cycles / static_cast<double>(n);
      const double c = std::cos(turn), s = std::sin(turn);
      double re = 1.0, im = 0.0, sum_re = 0.0, sum_im = 0.0;
      for (double v : h) {
        sum_re += v * re;
        sum_im += v * im;
        const double next = re * c - im * s;
        im = re * s + im * c;
        re = next;
      }
      sum += (sum_re * sum_re + sum_im * sum_im) / static_cast<double>(n);
    }
    out.push_back({low * std::sqrt(2.0) / static_cast<double>(n), sum / frequencies});
  }
  return out;
}

LineFit spectrum_slope(std::span<const SpectrumOctave> spectrum) {
  std::vector<double> x, y;
  for (std::size_t i = 0; i + 1 < spectrum.size(); ++i) {
    if (!(spectrum[i].power > 0.0)) continue;
    x.push_back(std::log(spectrum[i].cycles_per_step));
    y.push_back(std::log(spectrum[i].power));
  }
  return fitted_line(x, y);
}

}  // namespace skerry::echo
