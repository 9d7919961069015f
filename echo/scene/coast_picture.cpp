#include "echo/scene/coast_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/chart/land_mask.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

double length_of(PlanePoint v) { return std::sqrt(v.east_m * v.east_m + v.north_m * v.north_m); }

double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint ab = b - a, ap = p - a;
  const double length2 = ab.east_m * ab.east_m + ab.north_m * ab.north_m;
  const double along = ap.east_m * ab.east_m + ap.north_m * ab.north_m;
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  return length_of(ap - ab * t);
}

}  // namespace

CoastPreparer::CoastPreparer(CoastChart chart, GeoPoint anchor, const CoastRules& rules)
    : chart_(std::move(chart)), plane_(anchor), rules_(rules) {
  for (const CoastStyle& style : rules_.styles) refiners_.emplace_back(style);
  std::vector<PlanePoint> laid;
  for (const CoastRing& ring : chart_.rings) {
    const std::size_t n = ring.vertices.size();
    if (n < 3) continue;  // bounds nothing
    laid.resize(n);
    for (std::size_t i = 0; i < n; ++i) laid[i] = plane_.to_plane(ring.vertices[i]);
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t j = i + 1 == n ? 0 : i + 1;
      if (ring.edges[i] != EdgeKind::shoreline || ring.vertex_ids[i] == ring.vertex_ids[j])
        continue;
      edges_.push_back({laid[i], laid[j], ring.vertex_ids[i], ring.vertex_ids[j]});
    }
  }
  clearance_.emplace(edges_);
}

double CoastPreparer::slack_for(double range_m) { return std::max(20.0, 0.02 * range_m); }

bool CoastPreparer::serves(GeoPoint own_ship, double range_m) const {
  const double off = length_of(plane_.to_plane(own_ship));
  const PlanePoint window = plane_.to_plane(chart_.centre);
  const double from_window = length_of(plane_.to_plane(own_ship) - window);
  return off <= kMaxAnchorDistance &&
         from_window + range_m + 2.0 * slack_for(range_m) <= chart_.radius_m;
}

CoastPicturePtr CoastPreparer::prepare(GeoPoint own_ship, const RadarResolution& resolution) {
  auto picture = std::make_shared<CoastPicture>(CoastPicture{.plane = plane_,
                                                             .centre = {},
                                                             .vertices = {},
                                                             .run_starts = {},
                                                             .shores = {PictureShore{}},
                                                             .edge_shores = {},
                                                             .structures = nullptr,
                                                             .elevation = chart_.elevation});
  const PlanePoint centre = plane_.to_plane(own_ship);
  const double slack = slack_for(resolution.range_m);
  picture->centre = centre;
  picture->slack_m = slack;
  picture->range_m = resolution.range_m;
  picture->centre_ashore = is_land(chart_, own_ship);

  const DetailLimit limit{centre, slack, resolution.range_m, resolution.cell_m,
                          resolution.spoke_degrees * (std::numbers::pi / 180.0)};
  std::uint32_t run_end = 0;  // index of the edge after the last one laid down
  for (std::uint32_t i = 0; i < edges_.size(); ++i) {
    const ShoreEdge& edge = edges_[i];
    const double length = length_of(edge.to - edge.from);
    const double distance = distance_to_segment(centre, edge.from, edge.to);
    if (distance - 0.29 * length > resolution.range_m + slack) continue;
    const bool joins =
        !picture->vertices.empty() && run_end == i && i > 0 && edges_[i - 1].to_id == edge.from_id;
    if (!joins) {
      picture->run_starts.push_back(static_cast<std::uint32_t>(picture->vertices.size()));
      picture->vertices.push_back(edge.from);
    }
    refiners_[0].refine(
        {edge.from, edge.to, mixed(edge.seed(), rules_.seed), clearance_->half_angle_tan(i)}, limit,
        picture->vertices);
    run_end = i + 1;
  }
  picture->run_starts.push_back(static_cast<std::uint32_t>(picture->vertices.size()));
  return picture;
}

}  // namespace skerry::echo
