#include "server/app/chart_lines.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace skerry::server {
namespace {

constexpr double kTie_m = 1e-6;  // two distances that are the same
// Distances worked out before spans are halved instead: some lines split off vertex by vertex.
constexpr std::size_t kLooksPerVertex = 64;

// The part of a segment within the square, by Liang and Barsky: from and to as parts of it.
std::optional<std::pair<double, double>> part_within(PlanePoint a, PlanePoint b, double half_m) {
  const PlanePoint way = b - a;
  double from = 0.0, to = 1.0;
  const std::array<std::pair<double, double>, 4> sides = {{{-way.east_m, a.east_m + half_m},
                                                           {way.east_m, half_m - a.east_m},
                                                           {-way.north_m, a.north_m + half_m},
                                                           {way.north_m, half_m - a.north_m}}};
  for (const auto& [step, room] : sides) {
    if (step == 0.0) {
      if (room < 0.0) return std::nullopt;
      continue;
    }
    const double at = room / step;
    if (step < 0.0)
      from = std::max(from, at);
    else
      to = std::min(to, at);
  }
  if (from >= to) return std::nullopt;
  return std::pair(from, to);
}

double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint way = b - a;
  const double square = dot(way, way);
  const double along = square > 0.0 ? std::clamp(dot(p - a, way) / square, 0.0, 1.0) : 0.0;
  return length_of(p - (a + way * along));
}

}  // namespace

std::vector<std::vector<PlanePoint>> parts_within(const std::vector<PlanePoint>& line,
                                                  double half_m) {
  std::vector<std::vector<PlanePoint>> parts;
  bool goes_on = false;  // the last part ends at the next vertex
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const auto part = part_within(line[i], line[i + 1], half_m);
    if (!part) {
      goes_on = false;
      continue;
    }
    const auto [from, to] = *part;
    const PlanePoint way = line[i + 1] - line[i];
    if (!goes_on || from > 0.0) parts.push_back({from > 0.0 ? line[i] + way * from : line[i]});
    parts.back().push_back(to < 1.0 ? line[i] + way * to : line[i + 1]);
    goes_on = to >= 1.0;
  }
  return parts;
}

std::vector<float> significance(const std::vector<PlanePoint>& line, std::size_t* looked_at) {
  std::vector<float> out(line.size(), 0.0f);
  if (line.empty()) return out;
  out.front() = out.back() = std::numeric_limits<float>::infinity();
  struct Span {
    std::size_t first, last;
    float most;  // no vertex of it counts for more than the one that split it off
  };
  std::vector<Span> spans = {{0, line.size() - 1, std::numeric_limits<float>::infinity()}};
  std::size_t looks = 0;
  while (!spans.empty()) {
    const Span span = spans.back();
    spans.pop_back();
    if (span.last - span.first < 2) continue;
    const std::size_t middle = span.first + (span.last - span.first) / 2;
    const auto to_middle = [middle](std::size_t i) { return i < middle ? middle - i : i - middle; };
    std::size_t furthest = span.first + 1;
    double most = -1.0;
    for (std::size_t i = span.first + 1; i < span.last; ++i) {
      const double off = distance_to_segment(line[i], line[span.first], line[span.last]);
      if (off > most + kTie_m) {
        most = off;
        furthest = i;
      } else if (off >= most - kTie_m && to_middle(i) < to_middle(furthest)) {
        furthest = i;
      }
    }
    looks += span.last - span.first - 1;
    if (most < kStraight_m) continue;
    // What is said of the tolerance is true wherever the span is split.
    if (looks > kLooksPerVertex * line.size()) furthest = middle;
    const float counts = std::min(span.most, static_cast<float>(most));
    out[furthest] = counts;
    spans.push_back({span.first, furthest, counts});
    spans.push_back({furthest, span.last, counts});
  }
  if (looked_at != nullptr) *looked_at = looks;
  return out;
}

}  // namespace skerry::server
