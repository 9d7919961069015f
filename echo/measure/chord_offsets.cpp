#include "echo/measure/chord_offsets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "echo/measure/graph_roughness.hpp"
#include "echo/measure/line_fit.hpp"
#include "echo/measure/ruler_walk.hpp"

namespace skerry::echo {
namespace {

// A point of a coast seen from a chord: metres along it, and square to it on its left.
struct ChordPoint {
  double along = 0.0, off = 0.0;
};

std::vector<ChordPoint> seen_from_chord(std::span<const PlanePoint> piece) {
  const PlanePoint from = piece.front(), u = piece.back() - from;
  const double chord = distance(from, piece.back());
  std::vector<ChordPoint> out;
  for (PlanePoint p : piece) {
    const PlanePoint v = p - from;
    out.push_back({dot(v, u) / chord, cross(u, v) / chord});
  }
  return out;
}

// Offsets at 0, step, 2 step ... along the chord, each where the coast first passes there.
std::vector<double> evenly_spaced_offsets(std::span<const ChordPoint> seen, double step,
                                          std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i + 1 < seen.size(); ++i) {
    const ChordPoint a = seen[i], b = seen[i + 1];
    while (out.size() <= count) {
      const double at = static_cast<double>(out.size()) * step;
      if (b.along < at) break;
      const double run = b.along - a.along;
      const double share = run > 0.0 ? std::fmin(1.0, std::fmax(0.0, (at - a.along) / run)) : 1.0;
      out.push_back(a.off + (b.off - a.off) * share);
    }
  }
  return out;
}

// Sums over all chords.
struct Sums {
  std::vector<double> squares;           // of the middle's offset over the chord, one per chord
  std::vector<double> variation, pairs;  // by doubling of the lag
};

void add_piece(std::span<const PlanePoint> piece, double chord, std::size_t steps, Sums& sums) {
  const auto seen = seen_from_chord(piece);
  const double middle = middle_offset(piece);
  sums.squares.push_back(middle * middle);
  if (steps < 16) return;
  const auto offsets = evenly_spaced_offsets(seen, chord / static_cast<double>(steps), steps);
  const auto variogram = second_variation(offsets, static_cast<int>(steps / 4));
  sums.variation.resize(std::max(sums.variation.size(), variogram.size()));
  sums.pairs.resize(sums.variation.size());
  for (std::size_t k = 0; k < variogram.size(); ++k) {
    sums.variation[k] += variogram[k].mean;
    sums.pairs[k] += 1.0;
  }
}

double dimension_by_sums(const Sums& sums) {
  std::vector<double> x, y;
  for (std::size_t k = 0; k < sums.variation.size(); ++k) {
    if (!(sums.variation[k] > 0.0)) continue;
    x.push_back(static_cast<double>(k) * std::log(2.0));
    y.push_back(std::log(sums.variation[k] / sums.pairs[k]));
  }
  return 2.0 - fitted_line(x, y).slope / 2.0;
}

}  // namespace

double middle_offset(std::span<const PlanePoint> line) {
  if (line.size() < 2 || line.front() == line.back())
    return std::numeric_limits<double>::quiet_NaN();
  const PlanePoint u = line.back() - line.front();
  const double chord = distance(line.front(), line.back());
  double length = 0.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) length += distance(line[i], line[i + 1]);
  PlanePoint middle = line.back();
  double left = length / 2.0;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double segment = distance(line[i], line[i + 1]);
    if (left <= segment && segment > 0.0) {
      middle = line[i] + (line[i + 1] - line[i]) * (left / segment);
      break;
    }
    left -= segment;
  }
  const PlanePoint v = middle - line.front();
  return cross(u, v) / (chord * chord);
}

ChordOffsets chord_offsets(std::span<const PlaneLine> lines, double chord_m, double step_m) {
  if (!(chord_m > 0.0) || !(step_m > 0.0) || !(chord_m / step_m <= 4096.0))
    throw std::invalid_argument("chord offsets: chords of " + std::to_string(chord_m) +
                                " m in steps of " + std::to_string(step_m) +
                                " m; expected both positive and at most 4096 steps to a chord");
  const auto steps = static_cast<std::size_t>(chord_m / step_m + 1e-9);
  Sums sums;
  std::vector<PlanePoint> piece;
  for (const PlaneLine& line : lines) {
    if (line.size() < 2) continue;
    piece.assign(1, line.front());
    std::size_t next = 1;  // first vertex not yet in a piece
    walk_ruler(line, 0, chord_m, [&](std::size_t segment, PlanePoint foot) {
      for (; next <= segment; ++next) piece.push_back(line[next]);
      piece.push_back(foot);
      add_piece(piece, chord_m, steps, sums);
      piece.assign(1, foot);
    });
  }
  ChordOffsets out{chord_m, sums.squares.size()};
  out.middle_rms = out.middle_error = out.graph_dimension =
      std::numeric_limits<double>::quiet_NaN();
  if (out.chords < 2) return out;
  const double n = static_cast<double>(out.chords);
  double mean = 0.0, scatter = 0.0;
  for (double s : sums.squares) mean += s / n;
  for (double s : sums.squares) scatter += (s - mean) * (s - mean) / (n - 1.0);
  out.middle_rms = std::sqrt(mean);
  out.middle_error = mean > 0.0 ? std::sqrt(scatter / n) / (2.0 * out.middle_rms) : 0.0;
  out.graph_dimension = dimension_by_sums(sums);
  return out;
}

}  // namespace skerry::echo
