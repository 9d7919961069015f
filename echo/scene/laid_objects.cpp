#include "echo/scene/laid_objects.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>
#include <string>

#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kHighestRacon = 500.0;  // m, as Racon allows

void require_sound(const ChartObject& object) {
  const auto refuse = [&](const std::string& what) {
    throw std::invalid_argument("chart object \"" + object.name + "\" of class " +
                                std::to_string(static_cast<int>(object.kind)) + ": " + what);
  };
  const auto number = [&](const char* what, float value) {
    if (!(std::fabs(value) < 1e9f))
      refuse(std::string(what) + " is " + std::to_string(value) + "; allowed: up to 1e9");
  };
  number("height", object.height_m);
  number("clearance", object.clearance_m);
  number("cross-section", object.cross_section_m2);
  for (const GeoPoint& p : object.outline) {
    if (!(std::fabs(p.latitude_deg) <= 90.0 && std::fabs(p.longitude_deg) <= 360.0))
      refuse("a vertex is at latitude " + std::to_string(p.latitude_deg) + ", longitude " +
             std::to_string(p.longitude_deg));
  }
}

}  // namespace

LaidObjects::LaidObjects(const std::vector<ChartObject>& objects, const LocalPlane& plane) {
  for (const ChartObject& object : objects) {
    require_sound(object);
    const std::size_t n = object.outline.size();
    const float top = std::max(0.0f, object.height_m);
    const float base = std::clamp(object.clearance_m, 0.0f, top);
    if (n == 0) continue;
    const PlanePoint first = plane.to_plane(object.outline[0]);
    if (n == 1) {
      all_.points.push_back(
          {first, top, std::max(0.0f, object.cross_section_m2), object.kind, object.identity});
      if (!object.racon_code.empty()) {
        Racon racon;
        racon.place = first;
        racon.height_m = std::min(static_cast<double>(top), kHighestRacon);
        racon.code = object.racon_code;
        racon.identity = object.identity;
        racons_.push_back(std::move(racon));
      }
      continue;
    }
    const auto wall = [&](PlanePoint from, PlanePoint to) {
      if (from == to) return;
      all_.walls.push_back({from, to, base, top, object.kind});
    };
    PlanePoint last = first;
    for (std::size_t i = 1; i < n; ++i) {
      const PlanePoint next = plane.to_plane(object.outline[i]);
      wall(last, next);
      last = next;
    }
    if (object.closed && n > 2) wall(last, first);
  }
}

std::shared_ptr<const Structures> LaidObjects::within(PlanePoint centre, double reach_m) const {
  auto near = std::make_shared<Structures>();
  for (const Wall& w : all_.walls) {
    if (distance_to_segment(centre, w.from, w.to) <= reach_m) near->walls.push_back(w);
  }
  for (const PointObject& p : all_.points) {
    if (length_of(p.place - centre) <= reach_m) near->points.push_back(p);
  }
  if (near->walls.empty() && near->points.empty()) return nullptr;
  return near;
}

std::vector<Racon> LaidObjects::racons_within(PlanePoint centre, double reach_m) const {
  std::vector<Racon> near;
  std::copy_if(racons_.begin(), racons_.end(), std::back_inserter(near),
               [&](const Racon& racon) { return length_of(racon.place - centre) <= reach_m; });
  return near;
}

}  // namespace skerry::echo
