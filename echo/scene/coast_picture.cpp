#include "echo/scene/coast_picture.hpp"

#include <algorithm>
#include <utility>

#include "echo/chart/land_mask.hpp"
#include "echo/fractal/clearance.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/scene/coast_edges.hpp"
#include "echo/scene/edge_detail.hpp"
#include "echo/scene/laid_objects.hpp"
#include "echo/scene/picture_memory.hpp"
#include "echo/scene/style_refiners.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {

struct CoastPreparer::Laid {
  Laid(const CoastChart& chart, const LocalPlane& plane, const CoastRules& rules)
      : coast(lay_edges(chart, plane, rules)),
        objects(chart.objects, plane),
        cover(CoverGrid::of(chart)),
        clearance(coast.edges),
        refiners(coast.all_styles.size()) {
    for (const CoastStyle& style : coast.all_styles) require_valid(style);
  }

  // Found when first wanted.
  const EdgeRefiner& refiner(std::uint16_t style) {
    if (!refiners[style]) refiners[style] = refiner_of(coast.all_styles[style]);
    return *refiners[style];
  }

  CoastEdges coast;
  LaidObjects objects;
  std::shared_ptr<const CoverGrid> cover;
  Clearance clearance;
  std::vector<std::shared_ptr<const EdgeRefiner>> refiners;  // by style
  std::size_t most_vertices = 0;                             // of any picture
  PictureMemory memory;
  Effort effort;
};

CoastPreparer::CoastPreparer(CoastChart chart, GeoPoint anchor, const CoastRules& rules)
    : chart_(std::move(chart)),
      plane_(anchor),
      seed_(rules.seed),
      laid_(std::make_unique<Laid>(chart_, plane_, rules)) {}
CoastPreparer::~CoastPreparer() = default;
CoastPreparer::CoastPreparer(CoastPreparer&&) noexcept = default;
CoastPreparer& CoastPreparer::operator=(CoastPreparer&&) noexcept = default;

double CoastPreparer::slack_for(double range_m) { return std::max(20.0, 0.02 * range_m); }

const CoastPreparer::Effort& CoastPreparer::last_effort() const { return laid_->effort; }

bool CoastPreparer::serves(GeoPoint own_ship, double range_m) const {
  const double off = length_of(plane_.to_plane(own_ship));
  const PlanePoint window = plane_.to_plane(chart_.centre);
  const double from_window = length_of(plane_.to_plane(own_ship) - window);
  return off <= kMaxAnchorDistance &&
         from_window + range_m + 2.0 * slack_for(range_m) <= chart_.radius_m;
}

CoastPicturePtr CoastPreparer::prepare(GeoPoint own_ship, const RadarResolution& resolution) {
  const PlanePoint centre = plane_.to_plane(own_ship);
  const double slack = slack_for(resolution.range_m);
  const double reach = resolution.range_m + slack;
  auto picture = std::make_shared<CoastPicture>(
      CoastPicture{.plane = plane_,
                   .centre = centre,
                   .slack_m = slack,
                   .range_m = resolution.range_m,
                   .centre_ashore = is_land(chart_, own_ship),
                   .vertices = {},
                   .run_starts = {},
                   .shores = laid_->coast.kinds,
                   .edge_shores = {},
                   .structures = laid_->objects.within(centre, reach),
                   .racons = laid_->objects.racons_within(centre, reach),
                   .elevation = chart_.elevation,
                   .cover = laid_->cover});
  const DetailLimit limit{centre, slack, resolution.range_m, resolution.cell_m,
                          resolution.spoke_degrees * kRadiansPerDegree};
  const std::vector<ShoreEdge>& edges = laid_->coast.edges;
  std::vector<PlanePoint>& vertices = picture->vertices;
  // Room never written to costs nothing; moving what has been made does.
  vertices.reserve(
      std::max(laid_->most_vertices, std::min<std::size_t>(4 * edges.size(), 1u << 20)));
  std::vector<PictureMemory::Place> places(edges.size());
  Effort effort;
  bool all_alike = true;      // of shores[0]
  std::uint32_t run_end = 0;  // index of the edge after the last one laid down
  for (std::uint32_t i = 0; i < edges.size(); ++i) {
    const ShoreEdge& edge = edges[i];
    const double length = length_of(edge.to - edge.from);
    const PlanePoint middle = (edge.from + edge.to) * 0.5;
    // Refinement reaches at most 0.29 of an edge's length away from it.
    const double too_far = reach + 0.8 * length;
    if (dot(middle - centre, middle - centre) > too_far * too_far ||
        distance_to_segment(centre, edge.from, edge.to) - 0.29 * length > reach)
      continue;
    const bool joins =
        !vertices.empty() && run_end == i && i > 0 && edges[i - 1].to_id == edge.from_id;
    if (!joins) {
      picture->run_starts.push_back(static_cast<std::uint32_t>(vertices.size()));
      vertices.push_back(edge.from);
    }
    run_end = i + 1;
    const auto begun = static_cast<std::uint32_t>(vertices.size());
    const std::uint8_t shore = laid_->coast.shores[i];
    const CoastStyle& style = laid_->coast.all_styles[laid_->coast.styles[i]];
    EdgeDetail detail;
    if (style.method != CoastMethod::straight && !picture->shores[shore].seam)
      detail = detail_of(middle, length, limit);
    const auto refine = [&](const DetailLimit& to) {
      laid_->refiner(laid_->coast.styles[i])
          .refine(
              {edge.from, edge.to, mixed(edge.seed(), seed_), laid_->clearance.half_angle_tan(i)},
              to, vertices);
      ++effort.refined;
    };
    switch (detail.rule) {
      case EdgeDetail::Rule::straight:
        vertices.push_back(edge.to);
        ++effort.straight;
        break;
      case EdgeDetail::Rule::by_piece:
        refine(limit);
        break;
      case EdgeDetail::Rule::whole:
        if (const auto known = laid_->memory.find(i, detail.cell_m); !known.empty()) {
          vertices.insert(vertices.end(), known.begin(), known.end());
          ++effort.reused;
        } else {
          refine(whole_edge_limit(detail.cell_m));
        }
        places[i] = {detail.cell_m, begun, static_cast<std::uint32_t>(vertices.size()) - begun};
        break;
    }
    all_alike = all_alike && shore == 0;
    if (!all_alike) {
      picture->edge_shores.resize(vertices.size(), 0);
      std::fill(picture->edge_shores.begin() + begun - 1, picture->edge_shores.end() - 1, shore);
    }
  }
  picture->run_starts.push_back(static_cast<std::uint32_t>(vertices.size()));
  laid_->effort = effort;
  laid_->most_vertices = std::max(laid_->most_vertices, vertices.size());
  laid_->memory.keep(picture, resolution, std::move(places));
  return picture;
}

}  // namespace skerry::echo
