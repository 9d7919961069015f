#include "echo/returns/structure_returns.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/radar/radar_equation.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

bool stands_on_land(ObjectClass kind) {
  return kind == ObjectClass::building || kind == ObjectClass::landmark;
}

// Two neighbouring rays; what lies between them is shared by both.
struct Gap {
  SinCos left, right;

  bool holds(PlanePoint p) const { return right_of(left, p) >= 0.0 && right_of(right, p) < 0.0; }
  // 0 on the left ray, 1 on the right one; error: a third of the gap's angle squared.
  double nearness_to_right(PlanePoint p) const {
    const double from_left = right_of(left, p), both = from_left - right_of(right, p);
    return both > 0.0 ? std::clamp(from_left / both, 0.0, 1.0) : 0.5;
  }
  // Cuts a -> b down to what lies between the two; false if nothing does.
  bool clip(PlanePoint& a, PlanePoint& b) const {
    double from = 0.0, to = 1.0;
    const auto keep_where_positive = [&](double at_a, double at_b) {
      if (at_a < 0.0 && at_b < 0.0) return false;
      if (at_a < 0.0) from = std::max(from, at_a / (at_a - at_b));
      if (at_b < 0.0) to = std::min(to, at_a / (at_a - at_b));
      return from < to;
    };
    if (!keep_where_positive(right_of(left, a), right_of(left, b)) ||
        !keep_where_positive(-right_of(right, a), -right_of(right, b)))
      return false;
    const PlanePoint start = a, along = b - a;
    a = start + along * from;
    b = start + along * to;
    return holds((a + b) * 0.5);
  }
};

class StructureRay {
 public:
  StructureRay(const StructureModel& model, const GroundProfile* ground, std::span<float> power)
      : model_(model), ground_(ground), power_(power) {}

  // The part a -> b of a wall lies between two rays; this one's share of it goes from `share_a` to
  // `share_b`.
  bool add_part(const Wall& wall, PlanePoint a, PlanePoint b, double share_a, double share_b) {
    const double range_a = length_of(a), range_b = length_of(b);
    const double near = std::min(range_a, range_b), far = std::max(range_a, range_b);
    const double depth = far - near;
    const double spanned = std::fabs(cross(a, b));
    bool any = false;
    for (auto cell = static_cast<std::size_t>(near / model_.cell_m); cell < power_.size(); ++cell) {
      const double cell_near = static_cast<double>(cell) * model_.cell_m;
      if (cell_near > far) break;
      const double from = std::max(near, cell_near), to = std::min(far, cell_near + model_.cell_m);
      const double range = std::max(1.0, 0.5 * (from + to));
      const double part = depth > 0.0 ? (to - from) / depth : 1.0;
      const double along = depth > 0.0 ? (0.5 * (from + to) - range_a) / (range_b - range_a) : 0.5;
      const double share = share_a + along * (share_b - share_a);
      const double height = visible_wall(wall, cell, range);
      if (height <= 0.0) continue;
      const double across = spanned * part / range + kAlongTheLine * (to - from);
      add(cell, wall_gamma(wall.kind) * height * across * share, range);
      any = true;
    }
    return any;
  }

  bool add_point(const PointObject& point, PlanePoint at, double share) {
    const double range = std::max(1.0, length_of(at));
    const auto cell = static_cast<std::size_t>(range / model_.cell_m);
    if (cell >= power_.size()) return false;
    const Extent extent = raised(0.0, static_cast<double>(point.height_m), point.kind, cell);
    const double hidden = hidden_up_to(cell, range) - extent.base;
    const double height = extent.top - extent.base;
    if (hidden > 0.0 && hidden >= height) return false;
    const double visible = hidden > 0.0 ? 1.0 - hidden / height : 1.0;
    add(cell, static_cast<double>(point.cross_section_m2) * visible * share, range);
    return true;
  }

 private:
  struct Extent {
    double base, top;
  };

  void add(std::size_t cell, double cross_section, double range) {
    const double r2 = range * range;
    power_[cell] += static_cast<float>(model_.unit_signal_to_noise * cross_section / (r2 * r2));
  }

  // Height under which nothing at that range can be seen.  What stands in a cell is not hidden by
  // the cell's own ground or shore, nor by that of the cell before it.
  double hidden_up_to(std::size_t cell, double range) const {
    const double sea = hidden_height(range, model_.antenna_height_m);
    if (!ground_) return sea;
    const double slope = static_cast<double>(ground_->shadow[cell > 0 ? cell - 1 : 0]);
    return std::max(
        sea, model_.antenna_height_m + range * range / (2.0 * kEffectiveEarth) + slope * range);
  }

  Extent raised(double base, double top, ObjectClass kind, std::size_t cell) const {
    if (!ground_ || !stands_on_land(kind)) return {base, top};
    const double ground = static_cast<double>(ground_->height_m[cell]);
    return ground > 0.0 ? Extent{std::max(base, ground), std::max(top, ground + kStandsOut)}
                        : Extent{base, top};
  }

  double visible_wall(const Wall& wall, std::size_t cell, double range) const {
    double base = static_cast<double>(wall.base_m), top = static_cast<double>(wall.top_m);
    if (wall.kind == ObjectClass::bridge) top = std::max(top, base + kDeckDepth);
    const Extent extent = raised(base, top, wall.kind, cell);
    return extent.top - std::max(extent.base, hidden_up_to(cell, range));
  }

  const StructureModel& model_;
  const GroundProfile* ground_;
  std::span<float> power_;
};

}  // namespace

double wall_gamma(ObjectClass kind) {
  switch (kind) {
    case ObjectClass::bridge:
      return 1.0;
    case ObjectClass::breakwater:
    case ObjectClass::rock:
      return 0.316;
    default:
      return 0.501;
  }
}

void find_structures(const StructureIndex& index, const Ray& ray, const StructureModel& model,
                     NearStructures& near) {
  index.walls_near(ray.bearing_units, model.ray_units, near.walls);
  index.points_near(ray.bearing_units, model.ray_units, near.points);
}

bool add_structures(const StructureIndex& index, const NearStructures& near, const Ray& ray,
                    const StructureModel& model, const GroundProfile* ground,
                    std::span<float> power) {
  const SinCos middle = sin_cos_units(ray.bearing_units);
  const Gap before{sin_cos_units(ray.bearing_units - model.ray_units), middle};
  const Gap after{middle, sin_cos_units(ray.bearing_units + model.ray_units)};
  StructureRay out(model, ground, power);
  bool any = false;
  for (const std::uint32_t i : near.walls) {
    const Wall& wall = index.structures().walls[i];
    for (const Gap* gap : {&before, &after}) {
      PlanePoint a = wall.from - ray.own_ship, b = wall.to - ray.own_ship;
      if (!gap->clip(a, b)) continue;
      const double at_a = gap->nearness_to_right(a), at_b = gap->nearness_to_right(b);
      any |= gap == &before ? out.add_part(wall, a, b, at_a, at_b)
                            : out.add_part(wall, a, b, 1.0 - at_a, 1.0 - at_b);
    }
  }
  for (const std::uint32_t i : near.points) {
    const PointObject& point = index.structures().points[i];
    const PlanePoint at = point.place - ray.own_ship;
    if (before.holds(at)) any |= out.add_point(point, at, before.nearness_to_right(at));
    if (after.holds(at)) any |= out.add_point(point, at, 1.0 - after.nearness_to_right(at));
  }
  return any;
}

}  // namespace skerry::echo
