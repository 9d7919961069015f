#include "echo/scene/polar_index.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace skerry::echo {
namespace {

struct Span {
  std::int32_t first, last;  // buckets, first may be negative, last - first < kBuckets
  std::uint32_t edge;
};

double distance_of_segment_from_origin(PlanePoint a, PlanePoint b) {
  const PlanePoint ab = b - a;
  const double length2 = ab.east_m * ab.east_m + ab.north_m * ab.north_m;
  const double along = -(a.east_m * ab.east_m + a.north_m * ab.north_m);
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  const PlanePoint d = a + ab * t;
  return std::sqrt(d.east_m * d.east_m + d.north_m * d.north_m);
}

}  // namespace

PolarIndex::PolarIndex(const CoastPicture& picture, PlanePoint own_ship, double slack_m)
    : own_ship_(own_ship), slack_m_(slack_m), starts_(kBuckets + 1, 0) {
  std::vector<Span> spans;
  spans.reserve(picture.edge_count());
  constexpr double kBucketsPerRadian = kBuckets / (2.0 * std::numbers::pi);
  for (std::size_t run = 0; run + 1 < picture.run_starts.size(); ++run) {
    const std::uint32_t begin = picture.run_starts[run], end = picture.run_starts[run + 1];
    PlanePoint a = picture.vertices[begin] - own_ship;
    double bearing_a = std::atan2(a.east_m, a.north_m);
    for (std::uint32_t v = begin; v + 1 < end; ++v) {
      const PlanePoint b = picture.vertices[v + 1] - own_ship;
      const double bearing_b = std::atan2(b.east_m, b.north_m);
      const double distance = distance_of_segment_from_origin(a, b);
      if (distance <= 2.0 * slack_m) {
        near_.push_back(v);
      } else {
        // asin(x) <= 1.0472 x for x <= 1/2; one part in 1e9 covers the rounding of atan2.
        const double margin = 1.0472 * slack_m / distance + 1e-9;
        double turn = bearing_b - bearing_a;
        if (turn > std::numbers::pi) turn -= 2.0 * std::numbers::pi;
        if (turn < -std::numbers::pi) turn += 2.0 * std::numbers::pi;
        const double low = (turn < 0.0 ? bearing_a + turn : bearing_a) - margin;
        const double high = (turn < 0.0 ? bearing_a : bearing_a + turn) + margin;
        spans.push_back({static_cast<std::int32_t>(std::floor(low * kBucketsPerRadian)),
                         static_cast<std::int32_t>(std::floor(high * kBucketsPerRadian)), v});
      }
      a = b;
      bearing_a = bearing_b;
    }
  }
  constexpr std::uint32_t kMask = kBuckets - 1;
  for (const Span& s : spans) {
    for (std::int32_t k = s.first; k <= s.last; ++k)
      ++starts_[(static_cast<std::uint32_t>(k) & kMask) + 1];
  }
  for (std::uint32_t k = 0; k < kBuckets; ++k) starts_[k + 1] += starts_[k];
  edges_.resize(starts_[kBuckets]);
  std::vector<std::uint32_t> fill(starts_.begin(), starts_.end() - 1);
  for (const Span& s : spans) {
    for (std::int32_t k = s.first; k <= s.last; ++k) {
      edges_[fill[static_cast<std::uint32_t>(k) & kMask]++] = s.edge;
    }
  }
}

bool PolarIndex::serves(PlanePoint own_ship) const {
  const PlanePoint d = own_ship - own_ship_;
  return d.east_m * d.east_m + d.north_m * d.north_m <= slack_m_ * slack_m_;
}

std::span<const std::uint32_t> PolarIndex::candidates(std::uint32_t bearing_units) const {
  const std::uint32_t bucket =
      bearing_units / static_cast<std::uint32_t>(0x100000000ull / kBuckets);
  return {edges_.data() + starts_[bucket], starts_[bucket + 1] - starts_[bucket]};
}

}  // namespace skerry::echo
