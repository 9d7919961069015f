#include "echo/chart/gdal/chart_sheet.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint64_t kPlaceDomain = 0x706C616365ull;  // keeps clear of GSHHG's identities

}  // namespace

std::uint64_t identity_of(GeoPoint place) {
  const auto north = static_cast<std::int64_t>(std::llround(place.latitude_deg * kStepsPerDegree));
  auto east = static_cast<std::int64_t>(
      std::llround(wrapped_longitude(place.longitude_deg) * kStepsPerDegree));
  if (east == 1'800'000'000) east = -east;
  if (north == 900'000'000 || north == -900'000'000) east = 0;
  return mixed(kPlaceDomain, static_cast<std::uint64_t>(north), static_cast<std::uint64_t>(east));
}

ShoreTable::ShoreTable(std::vector<Shore>& shores) : shores_(shores) {
  if (shores_.empty()) shores_.push_back(Shore{});
  for (std::size_t i = shores_.size(); i-- > 0;) {
    std::uint32_t bits = 0;
    std::memcpy(&bits, &shores_[i].height_m, sizeof bits);
    known_[std::uint64_t{bits} << 8 | static_cast<std::uint8_t>(shores_[i].type)] =
        static_cast<std::uint16_t>(i);
  }
}

std::uint16_t ShoreTable::index_of(const Shore& shore) {
  std::uint32_t bits = 0;
  std::memcpy(&bits, &shore.height_m, sizeof bits);
  const std::uint64_t key = std::uint64_t{bits} << 8 | static_cast<std::uint8_t>(shore.type);
  if (const auto found = known_.find(key); found != known_.end()) return found->second;
  if (shores_.size() >= kMostShores) return known_[0];
  const auto index = static_cast<std::uint16_t>(shores_.size());
  shores_.push_back(shore);
  known_.emplace(key, index);
  return index;
}

void ChartSheet::index() {
  ring_boxes_.clear();
  object_boxes_.clear();
  contour_boxes_.clear();
  for (const CoastRing& ring : rings) ring_boxes_.push_back(box_around(ring.vertices));
  for (const ChartObject& object : objects) object_boxes_.push_back(box_around(object.outline));
  for (const DepthContour& contour : contours) contour_boxes_.push_back(box_around(contour.line));
  const auto size = [](const CoverArea& area) {
    const GeoBox box = box_around(area.rings.front());
    return (box.north_deg - box.south_deg) * box.width_deg;
  };
  std::vector<std::pair<double, CoverArea>> by_size;
  for (CoverArea& area : covers) by_size.emplace_back(size(area), std::move(area));
  std::stable_sort(by_size.begin(), by_size.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  covers.clear();
  cover_boxes_.clear();
  for (auto& [_, area] : by_size) {
    cover_boxes_.push_back(box_around(area.rings.front()));
    covers.push_back(std::move(area));
  }
}

namespace {

// Error: std::invalid_argument.
void require_window(GeoPoint centre, Length radius) {
  if (!(std::abs(centre.latitude_deg) <= 90.0) || !std::isfinite(centre.longitude_deg) ||
      !(radius.in_metres() >= 0.0))
    throw std::invalid_argument(fmt::format(
        "no chart window of radius {} m around latitude {}, longitude {}: expected a latitude "
        "within 90 degrees of the equator and a radius of 0 or more",
        radius.in_metres(), centre.latitude_deg, centre.longitude_deg));
}

}  // namespace

CoastChart ChartSheet::window(GeoPoint centre, Length radius) const {
  require_window(centre, radius);
  CoastChart chart;
  chart.centre = {centre.latitude_deg, wrapped_longitude(std::fmod(centre.longitude_deg, 360.0))};
  chart.radius_m = radius.in_metres();
  chart.source = source;
  chart.shores = shores;
  const GeoBox box = box_around(chart.centre, chart.radius_m);
  for (std::size_t i = 0; i < rings.size(); ++i) {
    if (overlap(ring_boxes_[i], box)) chart.rings.push_back(rings[i]);
  }
  for (std::size_t i = 0; i < objects.size(); ++i) {
    if (overlap(object_boxes_[i], box)) chart.objects.push_back(objects[i]);
  }
  for (std::size_t i = 0; i < covers.size(); ++i) {
    if (overlap(cover_boxes_[i], box)) chart.covers.push_back(covers[i]);
  }
  return chart;
}

ChartDetail ChartSheet::detail_window(GeoPoint centre, Length radius) const {
  require_window(centre, radius);
  const GeoPoint middle{centre.latitude_deg,
                        wrapped_longitude(std::fmod(centre.longitude_deg, 360.0))};
  const GeoBox box = box_around(middle, radius.in_metres());
  ChartDetail detail;
  detail.is_charted = overlap(coverage.box(), box);
  for (std::size_t i = 0; i < contours.size(); ++i) {
    if (overlap(contour_boxes_[i], box)) detail.contours.push_back(contours[i]);
  }
  for (const ChartMark& mark : marks) {
    if (overlap(box_around({mark.place}), box)) detail.marks.push_back(mark);
  }
  return detail;
}

}  // namespace skerry::echo
