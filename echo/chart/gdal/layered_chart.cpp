#include "echo/chart/gdal/layered_chart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "echo/chart/gdal/chart_sheet.hpp"
#include "echo/chart/gdal/polygons/clip_area.hpp"
#include "echo/chart/gdal/polygons/cut_lines.hpp"
#include "echo/chart/gdal/polygons/seam_lines.hpp"
#include "echo/chart/moored_craft.hpp"

namespace skerry::echo {
namespace {

// `window` and every edge that it touches.
GeoBox grown_by_edges(const GeoBox& window, const std::vector<CoastRing>& rings) {
  GeoBox grown = window;
  for (const CoastRing& ring : rings) {
    for (std::size_t i = 0, n = ring.vertices.size(); i < n; ++i) {
      const GeoPoint a = ring.vertices[i], b = ring.vertices[i + 1 == n ? 0 : i + 1];
      const double run = wrapped_longitude(b.longitude_deg - a.longitude_deg);
      const GeoBox edge{std::min(a.latitude_deg, b.latitude_deg),
                        std::max(a.latitude_deg, b.latitude_deg),
                        run < 0.0 ? b.longitude_deg : a.longitude_deg, std::abs(run)};
      if (overlap(edge, window)) grown = joined(grown, edge);
    }
  }
  return grown;
}

// The radius around `centre` that holds the box: an upper bound, by way of the box's corners along
// parallel and meridian.
double radius_of(const GeoBox& box, GeoPoint centre) {
  constexpr double kMetresPerDegree = 111700.0;  // of latitude, where it is most
  const double tall = std::max(std::abs(box.north_deg - centre.latitude_deg),
                               std::abs(centre.latitude_deg - box.south_deg));
  const double to_west = std::abs(wrapped_longitude(box.west_deg - centre.longitude_deg));
  const double to_east =
      std::abs(wrapped_longitude(box.west_deg + box.width_deg - centre.longitude_deg));
  const double wide = std::min(180.0, std::max(to_west, to_east));
  const double shrink = std::cos(centre.latitude_deg * std::numbers::pi / 180.0);
  return std::min(2.1e7, kMetresPerDegree * (tall + wide * std::max(0.1, shrink)));
}

void merge_shores(const CoastChart& from, std::size_t first_ring, CoastChart& into,
                  ShoreTable& table) {
  std::vector<std::uint16_t> index;
  for (const Shore& shore : from.shores) index.push_back(table.index_of(shore));
  const std::uint16_t none = table.index_of(Shore{});
  for (std::size_t r = first_ring; r < into.rings.size(); ++r) {
    CoastRing& ring = into.rings[r];
    if (ring.shores.empty())
      ring.shores.assign(ring.vertices.size(), none);
    else
      for (std::uint16_t& shore : ring.shores) shore = index[shore];
  }
}

bool is_covered(GeoPoint place, const std::vector<const Coverage*>& higher) {
  return std::any_of(higher.begin(), higher.end(),
                     [&](const Coverage* coverage) { return coverage->contains(place); });
}

// Lays the covers of `chart`, which answers for `coverage`, over those of charts below it.
void lay_covers(const CoastChart& chart, const Coverage& coverage, std::vector<CoverArea>& covers) {
  if (!covers.empty()) {
    if (coverage.everywhere()) covers.clear();
    for (const CoveragePolygon& polygon : coverage.polygons)
      covers.push_back({LandCover::none, polygon});
  }
  covers.insert(covers.end(), chart.covers.begin(), chart.covers.end());
}

// Appends the runs of a contour that no chart in `higher` covers.
void append_uncovered(const DepthContour& contour, const std::vector<const Coverage*>& higher,
                      std::vector<DepthContour>& into) {
  std::vector<GeoPoint> run;
  const auto finish = [&] {
    if (run.size() > 1) into.push_back({contour.depth_m, std::move(run)});
    run.clear();
  };
  for (const GeoPoint& place : contour.line) {
    if (is_covered(place, higher))
      finish();
    else
      run.push_back(place);
  }
  finish();
}

}  // namespace

LayeredChart::LayeredChart(std::vector<std::unique_ptr<ChartSource>> charts)
    : charts_(std::move(charts)) {
  if (charts_.empty()) throw std::invalid_argument("a layered chart of no charts");
  bool everywhere = false;
  coverage_.nowhere = true;
  for (const auto& chart : charts_) {
    const auto* covered = dynamic_cast<const CoveredChart*>(chart.get());
    coverages_.push_back(covered ? covered->coverage() : Coverage{});
    const Coverage& own = coverages_.back();
    boxes_.push_back(own.box());
    everywhere = everywhere || own.everywhere();
    coverage_.nowhere = coverage_.nowhere && own.nowhere;
    coverage_.polygons.insert(coverage_.polygons.end(), own.polygons.begin(), own.polygons.end());
  }
  if (everywhere) coverage_.polygons.clear();
}

std::string LayeredChart::describe() const {
  std::string text;
  constexpr std::size_t kNamed = 4;
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    const bool last = i + 1 == charts_.size();
    if (i >= kNamed - 1 && charts_.size() > kNamed && !last) continue;
    if (i >= kNamed && last) text += fmt::format(" over {} more", charts_.size() - kNamed);
    text += (i == 0 ? "" : " over ") + charts_[i]->describe();
  }
  return text;
}

CoastChart LayeredChart::load(GeoPoint centre, Length radius) const {
  // From the lowest up, so that a limit that cuts an edge in the window is known.
  GeoBox window = box_around(centre, std::max(0.0, radius.in_metres()));
  std::vector<std::size_t> asked;  // lowest first
  std::vector<CoastChart> loaded, aside(charts_.size());
  for (std::size_t i = charts_.size(); i-- > 0;) {
    if (!overlap(boxes_[i], window)) {
      aside[i] = charts_[i]->load(centre, radius);
      continue;
    }
    const double reach = std::max(radius.in_metres(), radius_of(window, centre));
    const bool grown = !asked.empty();
    loaded.push_back(charts_[i]->load(centre, grown ? metres(reach) : radius));
    asked.push_back(i);
    window = grown_by_edges(window, loaded.back().rings);
  }
  std::reverse(asked.begin(), asked.end());
  std::reverse(loaded.begin(), loaded.end());

  CoastChart chart;
  chart.centre = {centre.latitude_deg, wrapped_longitude(std::fmod(centre.longitude_deg, 360.0))};
  chart.radius_m = radius.in_metres();
  std::vector<const Coverage*> coverages;
  for (const std::size_t i : asked) coverages.push_back(&coverages_[i]);
  const std::vector<ClipArea> areas = ClipArea::of(coverages, chart.centre.longitude_deg);

  ShoreTable table(chart.shores);
  Coverage limits;
  std::vector<const Coverage*> higher;
  for (std::size_t i = 0, k = 0; i < charts_.size(); ++i) {
    const bool is_asked = k < asked.size() && asked[k] == i;
    const CoastChart& own = is_asked ? loaded[k] : aside[i];
    const std::size_t objects_before = chart.objects.size();
    for (const ChartObject& object : own.objects) {
      if (!is_covered(object.outline.front(), higher)) chart.objects.push_back(object);
    }
    if (is_asked) {
      const std::size_t first = chart.rings.size();
      for (const CoastRing& ring : own.rings) areas[k].clip(ring, chart.rings);
      merge_shores(own, first, chart, table);
      const Coverage limit = areas[k].limit();
      limits.polygons.insert(limits.polygons.end(), limit.polygons.begin(), limit.polygons.end());
      if (!chart.elevation) chart.elevation = own.elevation;
      higher.push_back(&coverages_[i]);
      ++k;
    }
    if (is_asked || chart.objects.size() > objects_before)
      chart.source += (chart.source.empty() ? "" : " over ") + own.source;
  }
  for (std::size_t i = charts_.size(), k = asked.size(); i-- > 0;) {
    const bool is_asked = k > 0 && asked[k - 1] == i;
    if (is_asked) --k;
    lay_covers(is_asked ? loaded[k] : aside[i], coverages_[i], chart.covers);
  }
  if (asked.size() > 1) settle_seams(CutLines(limits), chart.rings);
  remove_craft_ashore(chart);
  return chart;
}

ChartDetail LayeredChart::detail(GeoPoint centre, Length radius) const {
  const GeoBox window = box_around(centre, std::max(0.0, radius.in_metres()));
  ChartDetail detail;
  std::vector<const Coverage*> higher;
  for (std::size_t i = 0; i < charts_.size(); ++i) {
    const ChartDetail own = charts_[i]->detail(centre, radius);
    detail.is_charted = detail.is_charted || own.is_charted;
    for (const DepthContour& contour : own.contours)
      append_uncovered(contour, higher, detail.contours);
    for (const ChartMark& mark : own.marks) {
      if (!is_covered(mark.place, higher)) detail.marks.push_back(mark);
    }
    if (overlap(boxes_[i], window)) higher.push_back(&coverages_[i]);
  }
  return detail;
}

}  // namespace skerry::echo
