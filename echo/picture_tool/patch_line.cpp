#include "echo/picture_tool/patch_line.hpp"

#include <algorithm>
#include <cmath>

namespace skerry::echo {
namespace {

constexpr double kRidge = 0.02;  // of a standardised feature's variance, 1
constexpr double kCut = 4.0;     // standard deviations

// Means and deviations of what was learnt.
struct Standard {
  std::vector<double> mean, deviation;

  Standard(std::span<const LabelledPatch> learnt, std::size_t features)
      : mean(features, 0.0), deviation(features, 0.0) {
    const auto n = static_cast<double>(learnt.size());
    for (std::size_t f = 0; f < features; ++f) {
      for (const auto& each : learnt) mean[f] += each.patch->features[f] / n;
      for (const auto& each : learnt) {
        const double off = each.patch->features[f] - mean[f];
        deviation[f] += off * off / n;
      }
      deviation[f] = deviation[f] > 1e-18 ? std::sqrt(deviation[f]) : 1.0;
    }
  }

  std::vector<double> of(const PicturePatch& patch) const {
    std::vector<double> out(mean.size());
    for (std::size_t f = 0; f < out.size(); ++f)
      out[f] = std::clamp((patch.features[f] - mean[f]) / deviation[f], -kCut, kCut);
    return out;
  }
};

// Solves the n equations of a symmetric positive matrix, by Cholesky's method, in place.
std::vector<double> solved(std::vector<double> a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t j = 0; j < n; ++j) {
    for (std::size_t k = 0; k < j; ++k) a[j * n + j] -= a[j * n + k] * a[j * n + k];
    a[j * n + j] = std::sqrt(a[j * n + j]);
    for (std::size_t i = j + 1; i < n; ++i) {
      for (std::size_t k = 0; k < j; ++k) a[i * n + j] -= a[i * n + k] * a[j * n + k];
      a[i * n + j] /= a[j * n + j];
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= a[i * n + k] * b[k];
    b[i] /= a[i * n + i];
  }
  for (std::size_t i = n; i-- > 0;) {
    for (std::size_t k = i + 1; k < n; ++k) b[i] -= a[k * n + i] * b[k];
    b[i] /= a[i * n + i];
  }
  return b;
}

}  // namespace

std::vector<double> line_values(std::span<const LabelledPatch> learnt,
                                std::span<const LabelledPatch> asked, std::size_t features) {
  const Standard standard(learnt, features);
  const auto n = static_cast<double>(learnt.size());
  double share = 0.0;
  for (const auto& each : learnt) share += each.label / n;
  std::vector<double> square(features * features, 0.0), with_label(features, 0.0);
  for (const auto& each : learnt) {
    const std::vector<double> z = standard.of(*each.patch);
    for (std::size_t i = 0; i < features; ++i) {
      with_label[i] += z[i] * (each.label - share) / n;
      for (std::size_t k = 0; k <= i; ++k) square[i * features + k] += z[i] * z[k] / n;
    }
  }
  for (std::size_t i = 0; i < features; ++i) square[i * features + i] += kRidge;
  const std::vector<double> weights = solved(std::move(square), std::move(with_label));
  std::vector<double> values;
  for (const auto& each : asked) {
    const std::vector<double> z = standard.of(*each.patch);
    double value = 0.0;
    for (std::size_t f = 0; f < features; ++f) value += weights[f] * z[f];
    values.push_back(value);
  }
  return values;
}

}  // namespace skerry::echo
