#include "echo/targets/radial_speeds.hpp"

#include <algorithm>

#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kIndex = 0x0FFFFFFFu;  // of a body's number

struct Way {
  PlanePoint place, velocity;
};

// For a body that moves by itself; nothing for all others.
const Way* way_of(const Scene& scene, std::uint32_t body, Way& way) {
  const std::uint32_t index = body & kIndex;
  if (body == body_of(BodyKind::ship, index) && index < scene.hulls.size()) {
    way = {scene.hulls[index].centre, scene.hulls[index].velocity};
    return &way;
  }
  if (body == body_of(BodyKind::point, index) && index < scene.points.size()) {
    way = {scene.points[index].place, scene.points[index].velocity};
    return &way;
  }
  return nullptr;
}

}  // namespace

float RadialSpeeds::closing_of(const Scene& scene, const SectorView& view, std::uint32_t body) {
  Way way;
  if (way_of(scene, body, way) == nullptr || length_of(way.velocity) < kAfloat) return 0.0f;
  const PlanePoint from = view.from_own_ship(way.place, way.velocity);
  const double range = length_of(from);
  if (range < 1.0) return 0.0f;
  const PlanePoint relative = way.velocity - scene.own_velocity;
  return static_cast<float>(-dot(relative, from) / range);
}

void RadialSpeeds::keep_moving(const Scene& scene, const SectorView& view,
                               const std::vector<PointEcho>& points, std::vector<PointEcho>& kept) {
  kept.clear();
  Mover mover{~0u, 0.0f};
  for (const PointEcho& point : points) {
    if (point.body != mover.body) {
      mover = {point.body, closing_of(scene, view, point.body)};
      if (mover.closing != 0.0f) movers_.push_back(mover);
    }
    if (mover.closing != 0.0f) kept.push_back(point);
  }
}

void RadialSpeeds::prepare(const Scene& scene, const std::vector<PointEcho>& points,
                           const StrongEchoes& strong, const SpokeAim& first,
                           const SpokeAim& last) {
  const SectorView view(first, last, 0);
  movers_.clear();
  keep_moving(scene, view, points, points_);
  strong_.version = strong.version;
  keep_moving(scene, view, strong.points, strong_.points);
  std::stable_sort(movers_.begin(), movers_.end(),
                   [](const Mover& a, const Mover& b) { return a.body < b.body; });
  if (scene.artefacts.side_lobes) {
    splat_.prepare(points_, first, last, strong_);
  } else {
    splat_.prepare(points_, first, last);
  }
}

float RadialSpeeds::speed_of(std::uint32_t body) const {
  const auto found = std::lower_bound(
      movers_.begin(), movers_.end(), body,
      [](const Mover& mover, std::uint32_t number) { return mover.body < number; });
  return found != movers_.end() && found->body == body ? found->closing : 0.0f;
}

void RadialSpeeds::find(const SpokeAim& aim, std::span<const float> power,
                        std::span<float> closing) const {
  std::fill(closing.begin(), closing.end(), 0.0f);
  if (movers_.empty()) return;
  thread_local std::vector<float> strongest;
  strongest.assign(power.size(), 0.0f);
  splat_.each_body(aim, power.size(),
                   [&](std::uint32_t body, std::uint32_t first, std::span<const float> cells) {
                     const float speed = speed_of(body);
                     for (std::size_t i = 0; i < cells.size(); ++i) {
                       if (cells[i] <= strongest[first + i]) continue;
                       strongest[first + i] = cells[i];
                       closing[first + i] = speed;
                     }
                   });
  for (std::size_t i = 0; i < power.size(); ++i) {
    if (2.0f * strongest[i] < power[i]) closing[i] = 0.0f;
  }
}

}  // namespace skerry::echo
