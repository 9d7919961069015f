// A chart out of a caller's own rings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "echo/capi/call.hpp"
#include "echo/capi/shared_chart.hpp"
#include "echo/chart/local_plane.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo::capi {
namespace {

constexpr double kMostReachMetres = 1e6;

// Degrees in units of 1e-7, 1 cm: what tells two vertices apart.
std::int64_t units_of(double degrees) {
  return static_cast<std::int64_t>(std::floor(degrees * 1e7 + 0.5));
}
double degrees_of(std::int64_t units) { return static_cast<double>(units) / 1e7; }

struct Ring {
  CoastRing shore;
  double reach_m = 0.0;  // of the farthest vertex from the first
};

double distance(const LocalPlane& plane, GeoPoint place) {
  return length_of(plane.to_plane(place));
}

Ring ring_of(std::span<const skerry_echo_position> vertices, std::size_t number,
             std::size_t first_vertex) {
  Ring ring;
  CoastRing& shore = ring.shore;
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const skerry_echo_position given = vertices[i];
    // False for NaN.
    if (!(std::fabs(given.latitude_deg) <= 90.0 && std::fabs(given.longitude_deg) <= 180.0)) {
      throw CallError(
          SKERRY_ECHO_ERROR_ARGUMENT,
          fmt::format("vertices[{}] (ring {}) is at {}, {}; allowed: latitude -90 to "
                      "90, longitude -180 to 180",
                      first_vertex + i, number, given.latitude_deg, given.longitude_deg));
    }
    const std::int64_t latitude = units_of(given.latitude_deg);
    std::int64_t longitude = units_of(given.longitude_deg);
    if (longitude == 1'800'000'000) longitude = -longitude;
    const std::uint64_t identity =
        mixed(static_cast<std::uint64_t>(latitude), static_cast<std::uint64_t>(longitude));
    if (!shore.vertex_ids.empty() && shore.vertex_ids.back() == identity) continue;
    shore.vertices.push_back({degrees_of(latitude), degrees_of(longitude)});
    shore.vertex_ids.push_back(identity);
  }
  while (shore.vertex_ids.size() > 1 && shore.vertex_ids.front() == shore.vertex_ids.back()) {
    shore.vertices.pop_back();
    shore.vertex_ids.pop_back();
  }
  if (shore.vertices.size() < 3) {
    throw CallError(SKERRY_ECHO_ERROR_ARGUMENT,
                    fmt::format("ring {} has {} different vertices; at least 3 bound an area",
                                number, shore.vertices.size()));
  }
  const LocalPlane plane(shore.vertices.front());
  for (std::size_t i = 0; i < shore.vertices.size(); ++i) {
    ring.reach_m = std::max(ring.reach_m, distance(plane, shore.vertices[i]));
  }
  if (ring.reach_m > kMostReachMetres) {
    throw CallError(SKERRY_ECHO_ERROR_ARGUMENT,
                    fmt::format("ring {} reaches {:.0f} km from its first vertex; allowed: {:.0f}",
                                number, ring.reach_m * 1e-3, kMostReachMetres * 1e-3));
  }
  shore.edges.assign(shore.vertices.size(), EdgeKind::shoreline);
  return ring;
}

class RingSource : public ChartSource {
 public:
  RingSource(std::vector<Ring> rings, std::vector<Shore> shores)
      : rings_(std::move(rings)), shores_(std::move(shores)) {}

  CoastChart load(GeoPoint centre, Length radius) const override {
    CoastChart chart;
    chart.centre = centre;
    chart.radius_m = radius.in_metres();
    chart.source = describe();
    chart.shores = shores_;
    const LocalPlane plane(centre);
    for (const Ring& ring : rings_) {
      // The plane's distances are a little short far from its anchor.
      const double away = distance(plane, ring.shore.vertices.front());
      if (0.75 * away <= ring.reach_m + chart.radius_m) chart.rings.push_back(ring.shore);
    }
    return chart;
  }
  std::string describe() const override { return fmt::format("{} rings", rings_.size()); }

 private:
  std::vector<Ring> rings_;
  std::vector<Shore> shores_;
};

}  // namespace

std::shared_ptr<SharedChart> shared_chart_from_rings(std::span<const skerry_echo_position> vertices,
                                                     std::span<const std::size_t> ring_sizes,
                                                     std::span<const std::int32_t> ring_types) {
  std::vector<Shore> shores(kCoastTypes);
  for (int type = 0; type < kCoastTypes; ++type) shores[type].type = static_cast<CoastType>(type);
  std::vector<Ring> rings;
  std::size_t first = 0;
  for (std::size_t r = 0; r < ring_sizes.size(); ++r) {
    Ring ring = ring_of(vertices.subspan(first, ring_sizes[r]), r, first);
    if (!ring_types.empty()) {
      ring.shore.shores.assign(ring.shore.vertices.size(),
                               static_cast<std::uint16_t>(ring_types[r]));
    }
    rings.push_back(std::move(ring));
    first += ring_sizes[r];
  }
  return std::make_shared<SharedChart>(
      std::make_unique<RingSource>(std::move(rings), std::move(shores)), std::string());
}

}  // namespace skerry::echo::capi
