#include "echo/coast_tool/figure_coast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <utility>

#include "echo/assembly/scene_maker.hpp"
#include "echo/coast_tool/printed_picture.hpp"
#include "echo/returns/coast_crossings.hpp"
#include "echo/spoke_renderer.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint64_t kSeed = 1;

CoastPicturePtr prepared_figure(const CoastChart& chart, GeoPoint place, RangeScale scale,
                                const CoastStyle& style) {
  CoastRules rules{.seed = kSeed};
  rules.styles.fill(style);
  const ScanGeometry geometry;
  CoastPreparer preparer(chart, place, rules);
  return preparer.prepare(place, {scale.length().in_metres(), geometry.cell_size(scale).in_metres(),
                                  360.0 / geometry.spokes_per_turn});
}

}  // namespace

FigureCoast::FigureCoast(CoastChart chart, GeoPoint place, RangeScale scale)
    : chart_(std::move(chart)), place_(place), scale_(scale) {
  straight_ =
      prepared_figure(chart_, place_, scale_, {.method = CoastMethod::straight, .dimension = 1.0});
  if (straight_->vertices.empty()) {
    throw std::invalid_argument(fmt::format(
        "{} has no shore within {} NM of {:.5f},{:.5f}; take a place nearer the coast "
        "or a longer range",
        chart_.source, scale_.in_nautical_miles(), place_.latitude_deg, place_.longitude_deg));
  }
}

CoastPicturePtr FigureCoast::printed(const as_printed::Parameters& parameters) const {
  return printed_picture(*straight_, parameters, kDisplayPixels);
}

CoastPicturePtr FigureCoast::corrected(const CoastStyle& style) const {
  return prepared_figure(chart_, place_, scale_, style);
}

Scan FigureCoast::scan_of(CoastPicturePtr picture) const {
  const auto scene = scene_of(std::move(picture), {.position = place_}, 1.0);
  scene->seed = kSeed;

  Scan scan;
  const std::uint32_t spokes = scan.geometry.spokes_per_turn;
  SpokeRenderer renderer({}, scan.geometry, {24.0, spokes}, 0);
  renderer.set_controls({.range_scale = scale_});
  std::vector<std::uint8_t> video(std::size_t{spokes} * scan.geometry.cells);
  constexpr std::uint32_t kSector = 16;
  for (std::uint32_t first = 0; first < spokes; first += kSector) {
    renderer.render(*scene, first, kSector,
                    std::span(video).subspan(std::size_t{first} * scan.geometry.cells,
                                             std::size_t{kSector} * scan.geometry.cells));
  }
  scan.spokes.resize(spokes);
  scan.received = spokes;
  for (std::uint32_t i = 0; i < spokes; ++i) {
    Spoke spoke;
    spoke.header.sequence = spoke.header.index = i;
    spoke.header.geometry = scan.geometry;
    spoke.header.range_scale = scale_;
    spoke.header.own_ship = place_;
    const auto cells = video.begin() + static_cast<std::ptrdiff_t>(i) * scan.geometry.cells;
    spoke.cells.assign(cells, cells + scan.geometry.cells);
    scan.spokes[i] = std::move(spoke);
  }
  return scan;
}

LandByRay::LandByRay(const CoastPicture& picture) : rays_(kRays) {
  const PolarIndex index(picture, picture.centre, 1.0);
  const bool ashore = is_ashore(picture, index, picture.centre);
  std::vector<Crossing> crossings;
  std::vector<LandInterval> land;
  for (std::uint32_t ray = 0; ray < kRays; ++ray) {
    // Between two of the bearings that a chart's own corners may lie on.
    const std::uint32_t bearing = ray * (0x80000000u / (kRays / 2)) + 12345;
    find_crossings(picture, index, {picture.centre, bearing}, crossings);
    land_along(crossings, ashore, complete_range(picture, picture.centre), land);
    for (const LandInterval& l : land) rays_[ray].push_back({l.begin_m, l.end_m});
  }
}

bool LandByRay::is_land(double bearing_deg, double range_m) const {
  const auto ray = static_cast<std::uint32_t>(std::lround(bearing_deg * (kRays / 360.0))) % kRays;
  return std::any_of(rays_[ray].begin(), rays_[ray].end(),
                     [&](const Stretch& s) { return range_m >= s.begin_m && range_m < s.end_m; });
}

}  // namespace skerry::echo
