#include "echo/coast_tool/judge_picture.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <span>
#include <utility>

#include "echo/assembly/scene_maker.hpp"
#include "echo/chart/land_mask.hpp"
#include "echo/coast_tool/printed_picture.hpp"
#include "echo/spoke_renderer.hpp"

namespace skerry::echo {
namespace {

// The same relief and noise for all, so that only the coast differs.
constexpr std::uint64_t kSceneSeed = 1;

RadarResolution resolution_of(const JudgeRadar& radar) {
  return {radar.scale.length().in_metres(), radar.geometry.cell_size(radar.scale).in_metres(),
          360.0 / radar.geometry.spokes_per_turn};
}

CoastPicturePtr prepared_coast(const CoastChart& chart, const CoastStyle& style, std::uint64_t seed,
                               GeoPoint place, const JudgeRadar& radar) {
  CoastRules rules;
  rules.seed = seed;
  rules.styles.fill(style);
  rules.guess_types = false;
  CoastPreparer preparer(chart, place, rules);
  return preparer.prepare(place, resolution_of(radar));
}

const CoastStyle kStraight{.method = CoastMethod::straight, .dimension = 1.0};

PictureScore picture_score_of(CoastPicturePtr picture, GeoPoint place, const JudgeRadar& radar) {
  const auto scene = scene_of(std::move(picture), {.position = place}, 1.0);
  scene->seed = kSceneSeed;

  RadarSet set;
  set.beam_width_deg = radar.beam_deg;
  const std::uint32_t spokes = radar.geometry.spokes_per_turn, cells = radar.geometry.cells;
  SpokeRenderer renderer(set, radar.geometry, {24.0, spokes}, 0);
  renderer.set_controls({.range_scale = radar.scale});
  std::vector<std::uint8_t> video(std::size_t{spokes} * cells);
  constexpr std::uint32_t kSector = 32;
  for (std::uint32_t first = 0; first < spokes; first += kSector) {
    // From the second turn on, so that the beam is full at the first spoke too.
    renderer.render(
        *scene, spokes + first, kSector,
        std::span(video).subspan(std::size_t{first} * cells, std::size_t{kSector} * cells));
  }
  const PictureTurn turn{spokes,         cells, radar.geometry.cell_size(radar.scale).in_metres(),
                         radar.beam_deg, 255,   video};
  const double range = radar.scale.length().in_metres();
  const PictureScore low = picture_score(turn, {.from_m = 0.02 * range, .threshold = 0.25}, range);
  const PictureScore high = picture_score(turn, {.from_m = 0.02 * range, .threshold = 0.5}, range);
  const auto middle = [](auto& a, const auto& b) {
    for (std::size_t i = 0; i < a.size(); ++i) a[i] = 0.5 * (a[i] + b[i]);
  };
  PictureScore mean = low;
  mean.below_beam = 0.5 * (low.below_beam + high.below_beam);
  mean.above_beam = 0.5 * (low.above_beam + high.above_beam);
  mean.below_recorded = 0.5 * (low.below_recorded + high.below_recorded);
  mean.above_recorded = 0.5 * (low.above_recorded + high.above_recorded);
  mean.within_a_cell = 0.5 * (low.within_a_cell + high.within_a_cell);
  mean.change_p99_m = 0.5 * (low.change_p99_m + high.change_p99_m);
  middle(mean.thickness_m, high.thickness_m);
  return mean;
}

}  // namespace

std::optional<GeoPoint> place_afloat(const ThinnedCoast& coast, const CoastArea& area,
                                     RangeScale scale) {
  const LocalPlane plane(area.centre());
  std::vector<PlanePoint> shore;
  for (const CoastRing& ring : coast.fine().rings) {
    for (std::size_t i = 0; i < ring.vertices.size(); ++i) {
      if (ring.edges[i] == EdgeKind::shoreline) shore.push_back(plane.to_plane(ring.vertices[i]));
    }
  }
  const double range = scale.length().in_metres();
  const double reach = 0.6 * area.radius().in_metres();
  constexpr int kPlaces = 2000;
  constexpr double kGoldenAngle = 2.39996322972865332;
  for (int i = 0; i < kPlaces; ++i) {
    const double away = reach * std::sqrt(i / static_cast<double>(kPlaces));
    const PlanePoint at{away * std::sin(i * kGoldenAngle), away * std::cos(i * kGoldenAngle)};
    double nearest = std::numeric_limits<double>::infinity();
    for (const PlanePoint p : shore) {
      const PlanePoint d = p - at;
      nearest = std::min(nearest, dot(d, d));
    }
    nearest = std::sqrt(nearest);
    if (nearest < 0.2 * range || nearest > range / 3.0) continue;
    const GeoPoint place = plane.to_geo(at);
    if (!is_land(coast.fine(), place) && !is_land(coast.coarse(), place)) return place;
  }
  return std::nullopt;
}

PictureScore score_of_fine(const ThinnedCoast& coast, GeoPoint place, const JudgeRadar& radar) {
  return picture_score_of(prepared_coast(coast.fine(), kStraight, 0, place, radar), place, radar);
}

PictureScore score_of_drawn(const ThinnedCoast& coast, const Contestant& contestant,
                            std::uint64_t seed, GeoPoint place, const JudgeRadar& radar) {
  if (const auto* style = std::get_if<CoastStyle>(&contestant.method))
    return picture_score_of(prepared_coast(coast.coarse(), *style, seed, place, radar), place,
                            radar);
  const CoastPicturePtr straight = prepared_coast(coast.coarse(), kStraight, 0, place, radar);
  as_printed::Parameters parameters = std::get<as_printed::Parameters>(contestant.method);
  parameters.seed = seed;
  return picture_score_of(printed_picture(*straight, parameters, ThinnedCoast::kDisplayPixels),
                          place, radar);
}

}  // namespace skerry::echo
