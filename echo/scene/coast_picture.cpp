#include "echo/scene/coast_picture.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/chart/land_mask.hpp"
#include "echo/fractal/dimension.hpp"
#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kShortestPiece = 0.25;  // metres; below it nothing is ever refined

double length_of(PlanePoint v) { return std::sqrt(v.east_m * v.east_m + v.north_m * v.north_m); }

double distance_to_segment(PlanePoint p, PlanePoint a, PlanePoint b) {
  const PlanePoint ab = b - a, ap = p - a;
  const double length2 = ab.east_m * ab.east_m + ab.north_m * ab.north_m;
  const double along = ap.east_m * ab.east_m + ap.north_m * ab.north_m;
  const double t = length2 > 0.0 ? std::clamp(along / length2, 0.0, 1.0) : 0.0;
  return length_of(ap - ab * t);
}

// The longest piece the radar sees as straight at that distance, metres.
double straight_length(double distance, const RadarResolution& resolution) {
  const double arc = distance * resolution.spoke_degrees * (std::numbers::pi / 180.0);
  return std::max({0.5 * resolution.cell_m, 0.5 * arc, kShortestPiece});
}

}  // namespace

CoastPreparer::CoastPreparer(CoastChart chart, GeoPoint anchor, double dimension,
                             std::uint64_t seed)
    : chart_(std::move(chart)),
      plane_(anchor),
      apex_factor_(apex_factor_for_dimension(dimension)),
      seed_(seed) {
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

void CoastPreparer::refine(const CoastPiece& piece, Roughness roughness,
                           const RadarResolution& resolution, PlanePoint centre, double slack,
                           std::vector<PlanePoint>& out) const {
  const double length = length_of(piece.to - piece.from);
  const double middle = length_of((piece.from + piece.to) * 0.5 - centre);
  const double nearest = std::max(0.0, middle - 0.6 * length - slack);
  const bool in_range = nearest <= resolution.range_m;
  // The apex stands out by at most half the length times the two factors; a fifth of the straight
  // length is the share a piece of just that length would have at full roughness.
  const double height = 0.5 * length * roughness.half_angle_tan * roughness.apex_factor;
  if (!in_range || height <= 0.2 * straight_length(nearest, resolution)) {
    out.push_back(piece.to);
    return;
  }
  CoastPiece pieces[4];
  split(piece, roughness, pieces);
  for (const CoastPiece& p : pieces) refine(p, roughness, resolution, centre, slack, out);
}

CoastPicturePtr CoastPreparer::prepare(GeoPoint own_ship, const RadarResolution& resolution) {
  auto picture = std::make_shared<CoastPicture>(CoastPicture{plane_, {}, 0.0, 0.0, false, {}, {}});
  const PlanePoint centre = plane_.to_plane(own_ship);
  const double slack = slack_for(resolution.range_m);
  picture->centre = centre;
  picture->slack_m = slack;
  picture->range_m = resolution.range_m;
  picture->centre_ashore = is_land(chart_, own_ship);

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
    const Roughness roughness{clearance_->half_angle_tan(i), apex_factor_};
    refine({edge.from, edge.to, mixed(edge.seed(), seed_)}, roughness, resolution, centre, slack,
           picture->vertices);
    run_end = i + 1;
  }
  picture->run_starts.push_back(static_cast<std::uint32_t>(picture->vertices.size()));
  return picture;
}

}  // namespace skerry::echo
