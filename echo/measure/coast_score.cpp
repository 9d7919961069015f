#include "echo/measure/coast_score.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>

#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

double chord_of(const PlaneLine& line) { return length_of(line.back() - line.front()); }

// A line in the coordinates of its chord: along it from its first end, and off it to the left.
struct OffChord {
  double along_m, off_m;
};
std::vector<OffChord> off_chord(const PlaneLine& line) {
  const PlanePoint unit = (line.back() - line.front()) * (1.0 / chord_of(line));
  std::vector<OffChord> out;
  for (const PlanePoint p : line) {
    const PlanePoint v = p - line.front();
    out.push_back({dot(v, unit), cross(unit, v)});
  }
  return out;
}

void find_bays(const PlaneLine& line, double least_depth_m, CoastShape& shape) {
  const std::vector<OffChord> points = off_chord(line);
  double depth = 0.0, left_at = points.front().along_m;
  for (std::size_t i = 1; i < points.size(); ++i) {
    const OffChord a = points[i - 1], b = points[i];
    const bool last = i + 1 == points.size();
    if (last || (a.off_m > 0.0) != (b.off_m > 0.0)) {
      const double part = last || a.off_m == b.off_m ? 1.0 : a.off_m / (a.off_m - b.off_m);
      const double at = a.along_m + part * (b.along_m - a.along_m);
      if (depth >= least_depth_m) {
        shape.depths_m.push_back(depth);
        shape.widths_m.push_back(std::fabs(at - left_at));
      }
      depth = 0.0;
      left_at = at;
    }
    depth = std::max(depth, std::fabs(b.off_m));
  }
}

constexpr int kFractions = 64;

// Offsets at equal parts of the line's own length, metres; the ends, 0, left out.
using Offsets = std::array<double, kFractions - 1>;
Offsets offsets_of(const PlaneLine& line) {
  const std::vector<OffChord> points = off_chord(line);
  const double whole = length_of(line);
  Offsets offsets{};
  double passed = 0.0;
  std::size_t i = 1;
  for (std::size_t k = 0; k < offsets.size(); ++k) {
    const double target = whole * static_cast<double>(k + 1) / kFractions;
    double step = length_of(line[i] - line[i - 1]);
    while (i + 1 < line.size() && passed + step < target) {
      passed += step;
      ++i;
      step = length_of(line[i] - line[i - 1]);
    }
    const double part = step > 0.0 ? (target - passed) / step : 0.0;
    offsets[k] = points[i - 1].off_m + part * (points[i].off_m - points[i - 1].off_m);
  }
  return offsets;
}

// Adds the squares of the amplitudes of the offsets' half waves over the chord.
void add_spectrum(const PlaneLine& line, std::array<double, kSpectrumOctaves>& squares) {
  const Offsets offsets = offsets_of(line);
  const double chord = chord_of(line);
  for (int wave = 1; wave < (1 << kSpectrumOctaves); ++wave) {
    double sum = 0.0;
    for (std::size_t k = 0; k < offsets.size(); ++k) {
      sum +=
          offsets[k] * std::sin(std::numbers::pi * wave * static_cast<double>(k + 1) / kFractions);
    }
    const double amplitude = 2.0 / kFractions * sum / chord;
    squares[wave >= 4 ? 2 : wave >= 2 ? 1 : 0] += amplitude * amplitude;
  }
}

double distance_to(PlanePoint p, const PlaneLine& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i) {
    least = std::min(least, distance_squared_to_segment(p, line[i - 1], line[i]));
  }
  return std::sqrt(least);
}

constexpr double kSample_m = 20.0;

// Distances of places every kSample_m along `from` to `to`.
void add_distances(const PlaneLine& from, const PlaneLine& to, std::vector<double>& distances) {
  double next = 0.5 * kSample_m, passed = 0.0;
  for (std::size_t i = 1; i < from.size(); ++i) {
    const double step = length_of(from[i] - from[i - 1]);
    for (; next < passed + step; next += kSample_m) {
      const double part = (next - passed) / step;
      distances.push_back(distance_to(from[i - 1] + (from[i] - from[i - 1]) * part, to));
    }
    passed += step;
  }
}

bool same_place(PlanePoint a, PlanePoint b) { return length_of(a - b) < 1e-6; }

}  // namespace

double quantile_of(std::span<const double> ascending, double part) {
  if (ascending.empty()) return std::numeric_limits<double>::quiet_NaN();
  const double at = part * static_cast<double>(ascending.size() - 1);
  const auto low = static_cast<std::size_t>(at);
  const std::size_t high = std::min(low + 1, ascending.size() - 1);
  return ascending[low] + (ascending[high] - ascending[low]) * (at - static_cast<double>(low));
}

double kolmogorov_smirnov(std::span<const double> a, std::span<const double> b) {
  if (a.empty() || b.empty()) return a.empty() && b.empty() ? 0.0 : 1.0;
  double most = 0.0;
  std::size_t i = 0, j = 0;
  while (i < a.size() && j < b.size()) {
    const double value = std::min(a[i], b[j]);
    while (i < a.size() && a[i] <= value) ++i;
    while (j < b.size() && b[j] <= value) ++j;
    most = std::max(most, std::fabs(static_cast<double>(i) / static_cast<double>(a.size()) -
                                    static_cast<double>(j) / static_cast<double>(b.size())));
  }
  return most;
}

std::vector<bool> has_offsets(const CoastPieces& real) {
  std::vector<bool> counts;
  for (const PlaneLine& line : real)
    counts.push_back(line.size() >= 2 && chord_of(line) > 0.0 &&
                     length_of(line) <= 3.0 * chord_of(line));
  return counts;
}

CoastShape shape_of(const CoastPieces& pieces, const ScoreScales& scales,
                    const std::vector<bool>& chosen) {
  CoastShape shape;
  double chords_km = 0.0, counted = 0.0;
  for (std::size_t i = 0; i < pieces.size(); ++i) {
    const PlaneLine& line = pieces[i];
    if (line.size() < 2) throw std::invalid_argument("coast piece of fewer than two points");
    shape.length_km += 1e-3 * length_of(line);
    if (chord_of(line) <= 0.0) continue;
    chords_km += 1e-3 * chord_of(line);
    find_bays(line, scales.least_depth_m, shape);
    if (!chosen.at(i)) continue;
    counted += 1.0;
    add_spectrum(line, shape.spectrum);
  }
  for (double& square : shape.spectrum) square = counted > 0.0 ? std::sqrt(square / counted) : 0.0;
  shape.bays_per_km =
      chords_km > 0.0 ? static_cast<double>(shape.depths_m.size()) / chords_km : 0.0;
  std::sort(shape.depths_m.begin(), shape.depths_m.end());
  std::sort(shape.widths_m.begin(), shape.widths_m.end());
  shape.dimensions = local_dimensions(box_census(pieces, scales.smallest_m, scales.largest_m));
  return shape;
}

CoastScore score_of(const CoastPieces& real, const CoastShape& real_shape, const CoastPieces& made,
                    const CoastShape& made_shape, const std::vector<bool>& chosen) {
  if (real.size() != made.size())
    throw std::invalid_argument("coasts of " + std::to_string(real.size()) + " and " +
                                std::to_string(made.size()) + " pieces, expected the same number");
  std::vector<double> there, back;
  double squares = 0.0, places = 0.0;
  for (std::size_t i = 0; i < real.size(); ++i) {
    if (real[i].size() < 2 || made[i].size() < 2 || !same_place(real[i].front(), made[i].front()) ||
        !same_place(real[i].back(), made[i].back()))
      throw std::invalid_argument("piece " + std::to_string(i) +
                                  " of the coasts has other ends, expected the same");
    add_distances(real[i], made[i], there);
    add_distances(made[i], real[i], back);
    if (!chosen.at(i)) continue;
    const Offsets should_be = offsets_of(real[i]), are = offsets_of(made[i]);
    for (std::size_t k = 0; k < are.size(); ++k) {
      squares += (are[k] - should_be[k]) * (are[k] - should_be[k]);
      places += 1.0;
    }
  }
  std::sort(there.begin(), there.end());
  std::sort(back.begin(), back.end());
  CoastScore score;
  score.apart_rms_m = places > 0.0 ? std::sqrt(squares / places) : 0.0;
  score.real_to_made_p50_m = quantile_of(there, 0.5);
  score.real_to_made_p90_m = quantile_of(there, 0.9);
  score.made_to_real_p50_m = quantile_of(back, 0.5);
  score.made_to_real_p90_m = quantile_of(back, 0.9);
  const std::size_t sizes = std::min(real_shape.dimensions.size(), made_shape.dimensions.size());
  for (std::size_t i = 0; i < sizes; ++i) {
    const double off = made_shape.dimensions[i].dimension - real_shape.dimensions[i].dimension;
    score.dimension_error += off * off / static_cast<double>(sizes);
  }
  score.dimension_error = std::sqrt(score.dimension_error);
  score.depth_distance = kolmogorov_smirnov(real_shape.depths_m, made_shape.depths_m);
  score.width_distance = kolmogorov_smirnov(real_shape.widths_m, made_shape.widths_m);
  for (std::size_t i = 0; i < kSpectrumOctaves; ++i) {
    if (real_shape.spectrum[i] <= 0.0) continue;
    const double off = made_shape.spectrum[i] / real_shape.spectrum[i] - 1.0;
    score.spectrum_error += off * off / static_cast<double>(kSpectrumOctaves);
  }
  score.spectrum_error = std::sqrt(score.spectrum_error);
  return score;
}

}  // namespace skerry::echo
