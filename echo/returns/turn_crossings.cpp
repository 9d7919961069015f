#include "echo/returns/turn_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "echo/kernel/bearing_sector.hpp"

namespace skerry::echo {
namespace {

constexpr std::size_t kVerticesAtOnce = 2048;  // vertices looked at in one go

}  // namespace

void TurnCrossings::begin(const CoastPicture& coast, PlanePoint at, std::uint32_t rays,
                          double reach_m) {
  at_ = at;
  if (rays != rays_) {
    rays_ = rays;
    directions_.resize(rays);
    const auto step = static_cast<std::uint32_t>(0x100000000ull / rays);
    for (std::uint32_t k = 0; k < rays; ++k) directions_[k] = sin_cos_units(k * step);
  }
  reach_m_ = nearest_m_ = reach_m;
  next_ = run_ = 0;
  found_.clear();
  shores_met_.assign(256, 0);
  done_ = false;
  if (coast.vertices.empty()) finish();
}

void TurnCrossings::cross(const CoastPicture& coast, std::uint32_t vertex, std::int32_t from,
                          std::int32_t to) {
  const PlanePoint a = coast.vertices[vertex] - at_, b = coast.vertices[vertex + 1] - at_;
  const auto turn = static_cast<std::int32_t>(rays_);
  std::int32_t steps = to - from;  // to the right
  if (steps > turn / 2) steps -= turn;
  if (steps < -turn / 2) steps += turn;
  if (std::abs(steps) > turn / 4) {
    // So near that it spans a good part of the turn: which way it passes decides.
    const bool right = skerry::cross(a, b) < 0.0;
    if (right && steps < 0) steps += turn;
    if (!right && steps > 0) steps -= turn;
  }
  const bool right = steps > 0;
  const std::int32_t first = right ? from + 1 : from + steps + 1;
  for (std::int32_t k = 0; k < std::abs(steps); ++k) {
    const auto ray = static_cast<std::uint32_t>(first + k + turn) % rays_;
    const SinCos direction = directions_[ray];
    const double right_a = right_of(direction, a);
    const double right_b = right_of(direction, b);
    const double along_a = ahead_of(direction, a);
    const double along_b = ahead_of(direction, b);
    const double across = right_a - right_b;
    const double part = across != 0.0 ? std::clamp(right_a / across, 0.0, 1.0) : 0.5;
    const double range = std::max(0.0, along_a + (along_b - along_a) * part);
    if (range >= reach_m_) continue;
    nearest_m_ = std::min(nearest_m_, range);
    // Land is left of a -> b: an edge that runs to the right has it on the far side.
    const std::uint8_t shore = coast.shore_of(vertex);
    shores_met_[shore] = 1;
    found_.push_back({ray, {range, right, shore, vertex}});
  }
}

void TurnCrossings::work_to(const CoastPicture& coast, std::size_t vertices) {
  while (!done_ && next_ < vertices) {
    const std::size_t end = std::min(coast.vertices.size(), next_ + kVerticesAtOnce);
    // One more, for the edge that leaves the block.
    const std::size_t seen = std::min(coast.vertices.size(), end + 1);
    sectors_.resize(seen - next_);
    bearing_sectors({coast.vertices.data() + next_, seen - next_}, at_, rays_, sectors_);
    const std::size_t base = next_;
    while (next_ < end) {
      while (run_ + 1 < coast.run_starts.size() && coast.run_starts[run_ + 1] <= next_) ++run_;
      const std::size_t run_end =
          run_ + 1 < coast.run_starts.size() ? coast.run_starts[run_ + 1] : coast.vertices.size();
      const std::size_t last = std::min(end, run_end - 1);
      for (std::size_t v = next_; v < last; ++v) {
        const std::int32_t from = sectors_[v - base], to = sectors_[v + 1 - base];
        if (from != to) cross(coast, static_cast<std::uint32_t>(v), from, to);
      }
      next_ = last < end ? last + 1 : end;
    }
    if (next_ >= coast.vertices.size()) finish();
  }
}

void TurnCrossings::finish() {
  starts_.assign(rays_ + 1, 0);
  for (const OnRay& f : found_) ++starts_[f.ray + 1];
  for (std::uint32_t r = 0; r < rays_; ++r) starts_[r + 1] += starts_[r];
  sorted_.resize(found_.size());
  for (const OnRay& f : found_) sorted_[starts_[f.ray]++] = f.crossing;
  for (std::uint32_t r = rays_; r > 0; --r) starts_[r] = starts_[r - 1];
  starts_[0] = 0;
  done_ = true;
}

void TurnCrossings::of(std::uint32_t ray, std::vector<Crossing>& crossings) const {
  crossings.assign(sorted_.begin() + starts_[ray], sorted_.begin() + starts_[ray + 1]);
  sort_crossings(crossings);
}

}  // namespace skerry::echo
