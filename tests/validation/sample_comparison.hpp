// Whether two large samples are of one law: mean, variance, Kolmogorov and Smirnov.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace skerry::validation {

// Counts integer values in a histogram.
class ValueCounts {
 public:
  void add(std::uint32_t value) {
    if (value >= counts_.size()) counts_.resize(value + 1);
    ++counts_[value];
    ++size_;
  }
  void add(const ValueCounts& other) {
    counts_.resize(std::max(counts_.size(), other.counts_.size()));
    for (std::size_t v = 0; v < other.counts_.size(); ++v) counts_[v] += other.counts_[v];
    size_ += other.size_;
  }
  double size() const { return static_cast<double>(size_); }
  double at(std::size_t value) const {
    return value < counts_.size() ? static_cast<double>(counts_[value]) : 0.0;
  }
  std::size_t top() const { return counts_.size(); }
  double mean() const { return moment(0.0, 1); }
  // About the mean.
  double central(int order) const { return moment(mean(), order); }

 private:
  double moment(double about, int order) const {
    double sum = 0.0;
    for (std::size_t v = 0; v < counts_.size(); ++v)
      sum += static_cast<double>(counts_[v]) * std::pow(static_cast<double>(v) - about, order);
    return sum / size();
  }
  std::vector<std::uint64_t> counts_;
  std::uint64_t size_ = 0;
};

struct Comparison {
  double mean_off = 0.0;      // deviations of the difference of two means
  double mean_steps = 0.0;    // the difference
  double variance_off = 0.0;  // deviations of the logarithm of the ratio of two variances
  double variance_ratio = 1.0;
  double distance = 0.0;  // between the two distributions, Kolmogorov and Smirnov
};

// independent: how many of the values of one sample are, as a share.
// Var(mean) = var / n and Var(variance) = (m4 - var^2) / n of independent values; where the values
// of a region are of many laws, the same ones in both samples, the true scatter is less.
inline Comparison compared(const ValueCounts& a, const ValueCounts& b, double independent) {
  Comparison out;
  const double n = a.size() * independent, va = a.central(2), vb = b.central(2);
  const double v = 0.5 * (va + vb), m4 = 0.5 * (a.central(4) + b.central(4));
  out.mean_steps = a.mean() - b.mean();
  out.mean_off = out.mean_steps / std::sqrt(2.0 * v / n);
  out.variance_ratio = va / vb;
  out.variance_off = std::log(va / vb) / std::sqrt(2.0 * (m4 / v / v - 1.0) / n);
  double below_a = 0.0, below_b = 0.0;
  for (std::size_t i = 0; i < std::max(a.top(), b.top()); ++i) {
    below_a += a.at(i) / a.size();
    below_b += b.at(i) / b.size();
    out.distance = std::max(out.distance, std::fabs(below_a - below_b));
  }
  return out;
}

}  // namespace skerry::validation
