#include "echo/scene/structure_index.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {

StructureIndex::StructureIndex(std::shared_ptr<const Structures> structures, PlanePoint own_ship,
                               double slack_m)
    : structures_(std::move(structures)), own_ship_(own_ship), slack_m_(slack_m) {
  constexpr double kBucketsPerRadian = kBuckets / kRadiansPerTurn;
  std::vector<Span> spans;
  const auto place = [&](Buckets& into, std::uint32_t item, PlanePoint a, PlanePoint b) {
    const double distance = distance_to_segment({}, a, b);
    if (distance <= 2.0 * slack_m) {
      into.near.push_back(item);
      return;
    }
    // asin(x) <= 1.0472 x for x <= 1/2; one part in 1e9 covers the rounding of atan2.
    const double margin = 1.0472 * slack_m / distance + 1e-9;
    const double bearing = std::atan2(a.east_m, a.north_m);
    const double turn = std::remainder(std::atan2(b.east_m, b.north_m) - bearing, kRadiansPerTurn);
    const double low = bearing + std::min(turn, 0.0) - margin;
    const double high = bearing + std::max(turn, 0.0) + margin;
    spans.push_back({static_cast<std::int32_t>(std::floor(low * kBucketsPerRadian)),
                     static_cast<std::int32_t>(std::floor(high * kBucketsPerRadian)), item});
  };
  for (std::uint32_t i = 0; i < structures_->walls.size(); ++i) {
    const Wall& wall = structures_->walls[i];
    place(walls_, i, wall.from - own_ship, wall.to - own_ship);
  }
  walls_.fill(spans);
  spans.clear();
  for (std::uint32_t i = 0; i < structures_->points.size(); ++i) {
    const PlanePoint at = structures_->points[i].place - own_ship;
    place(points_, i, at, at);
  }
  points_.fill(spans);
}

bool StructureIndex::serves(PlanePoint own_ship) const {
  return length_of(own_ship - own_ship_) <= slack_m_;
}

void StructureIndex::walls_near(std::uint32_t bearing_units, std::uint32_t reach_units,
                                std::vector<std::uint32_t>& found) const {
  walls_.find(bearing_units, reach_units, found);
}

void StructureIndex::points_near(std::uint32_t bearing_units, std::uint32_t reach_units,
                                 std::vector<std::uint32_t>& found) const {
  points_.find(bearing_units, reach_units, found);
}

void StructureIndex::Buckets::fill(std::span<const Span> spans) {
  constexpr std::uint32_t kMask = kBuckets - 1;
  starts.assign(kBuckets + 1, 0);
  for (const Span& s : spans) {
    for (std::int32_t k = s.first; k <= s.last; ++k)
      ++starts[(static_cast<std::uint32_t>(k) & kMask) + 1];
  }
  for (std::uint32_t k = 0; k < kBuckets; ++k) starts[k + 1] += starts[k];
  items.resize(starts[kBuckets]);
  std::vector<std::uint32_t> next(starts.begin(), starts.end() - 1);
  for (const Span& s : spans) {
    for (std::int32_t k = s.first; k <= s.last; ++k)
      items[next[static_cast<std::uint32_t>(k) & kMask]++] = s.item;
  }
}

void StructureIndex::Buckets::find(std::uint32_t bearing_units, std::uint32_t reach_units,
                                   std::vector<std::uint32_t>& found) const {
  found.assign(near.begin(), near.end());
  constexpr std::uint32_t kUnitsPerBucket = 0x100000000ull / kBuckets;
  const std::uint32_t first = (bearing_units - reach_units) / kUnitsPerBucket;
  const std::uint32_t last = (bearing_units + reach_units) / kUnitsPerBucket;
  for (std::uint32_t k = first;; k = (k + 1) % kBuckets) {
    found.insert(found.end(), items.begin() + starts[k], items.begin() + starts[k + 1]);
    if (k == last) break;
  }
  if (found.size() < 2) return;
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
}

}  // namespace skerry::echo
