#include "server/app/chart_objects.hpp"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "protocol/wire/utf8.hpp"
#include "server/app/chart_lines.hpp"
#include "server/relay/sendable_text.hpp"

namespace skerry::server {
namespace {

constexpr double kMetresPerChartDegree = 60.0 * 1852.0;
constexpr double kLeastTolerance_m = 0.5;  // where the one asked for is 0 and cannot be kept
constexpr std::size_t kLongestName = 64;   // bytes

struct CutLine {
  wire::ChartLine::Kind kind = wire::ChartLine::COAST;
  float depth_m = 0.0f;
  std::vector<PlanePoint> points;
  std::vector<float> significance;
};

class Cutter {
 public:
  explicit Cutter(const wire::GetChartObjects& place)
      : place_(place),
        parallel_(std::max(0.01, std::cos(degrees(place.latitude_deg()).in_radians()))),
        half_m_(place.radius_nm() * 1852.0) {}

  PlanePoint plane(GeoPoint point) const {
    return {wrapped_longitude(point.longitude_deg - place_.longitude_deg()) *
                kMetresPerChartDegree * parallel_,
            (point.latitude_deg - place_.latitude_deg()) * kMetresPerChartDegree};
  }
  std::int64_t east(PlanePoint point) const {
    return std::llround(point.east_m / (kMetresPerChartDegree * parallel_) * 1e6);
  }
  static std::int64_t north(PlanePoint point) {
    return std::llround(point.north_m / kMetresPerChartDegree * 1e6);
  }
  bool is_within(PlanePoint point) const {
    return std::max(std::abs(point.east_m), std::abs(point.north_m)) <= half_m_;
  }

  void add(wire::ChartLine::Kind kind, float depth_m, const std::vector<PlanePoint>& line) {
    for (std::vector<PlanePoint>& part : parts_within(line, half_m_)) {
      std::vector<float> counts = significance(part);
      lines.push_back({kind, depth_m, std::move(part), std::move(counts)});
    }
  }
  // Whether the way from one to the other leads over the meridian opposite the centre.
  bool is_around(PlanePoint a, PlanePoint b) const {
    return std::abs(b.east_m - a.east_m) > 180.0 * kMetresPerChartDegree * parallel_;
  }
  void add_shore(const echo::CoastRing& ring);
  void add_contour(const echo::DepthContour& contour);

  std::vector<CutLine> lines;

 private:
  const wire::GetChartObjects& place_;
  double parallel_, half_m_;
};

// Only shorelines: where land ends at the limit of a chart or of a storage bin there is no coast.
void Cutter::add_shore(const echo::CoastRing& ring) {
  const std::size_t n = ring.vertices.size();
  const auto is_shore = [&](std::size_t i) { return ring.edges[i] == echo::EdgeKind::shoreline; };
  std::size_t begin = 0;  // after an edge that is no shore, if there is one
  while (begin < n && is_shore((begin + n - 1) % n)) ++begin;
  begin %= std::max<std::size_t>(n, 1);
  std::vector<PlanePoint> run;
  for (std::size_t k = 0; k < n; ++k) {
    const std::size_t i = (begin + k) % n;
    if (!is_shore(i)) {
      add(wire::ChartLine::COAST, 0.0f, run);
      run.clear();
      continue;
    }
    const PlanePoint from = plane(ring.vertices[i]), to = plane(ring.vertices[(i + 1) % n]);
    if (is_around(from, to)) {
      add(wire::ChartLine::COAST, 0.0f, run);
      run.clear();
      continue;
    }
    if (run.empty()) run.push_back(from);
    run.push_back(to);
  }
  add(wire::ChartLine::COAST, 0.0f, run);
}

void Cutter::add_contour(const echo::DepthContour& contour) {
  std::vector<PlanePoint> run;
  for (const GeoPoint& point : contour.line) {
    const PlanePoint at = plane(point);
    if (!run.empty() && is_around(run.back(), at)) {
      add(wire::ChartLine::DEPTH_CONTOUR, contour.depth_m, run);
      run.clear();
    }
    run.push_back(at);
  }
  add(wire::ChartLine::DEPTH_CONTOUR, contour.depth_m, run);
}

void add_marks(const echo::ChartDetail& detail, const Cutter& cutter, std::size_t most_bytes,
               wire::ChartObjects& out) {
  struct Placed {
    const echo::ChartMark* mark;
    PlanePoint at;
  };
  std::vector<Placed> placed;
  for (const echo::ChartMark& mark : detail.marks) {
    const PlanePoint at = cutter.plane(mark.place);
    if (cutter.is_within(at)) placed.push_back({&mark, at});
  }
  std::stable_sort(placed.begin(), placed.end(), [](const Placed& a, const Placed& b) {
    return dot(a.at, a.at) < dot(b.at, b.at);
  });
  std::size_t bytes = 0;
  for (const auto& [mark, at] : placed) {
    wire::ChartMark told;
    told.set_kind(static_cast<wire::ChartMark::Kind>(mark->kind));
    told.set_longitude(static_cast<std::int32_t>(cutter.east(at)));
    told.set_latitude(static_cast<std::int32_t>(Cutter::north(at)));
    told.set_fixed(mark->fixed);
    told.set_shape(mark->shape);
    for (const std::uint8_t colour : mark->colours) told.add_colours(colour);
    told.set_name(sendable(mark->name, kLongestName));
    told.set_light(sendable(mark->light, kLongestName));
    told.set_racon(mark->racon);
    if (mark->depth_m) told.set_depth_m(static_cast<double>(*mark->depth_m));
    bytes += told.ByteSizeLong() + 3;
    if (bytes > most_bytes) break;
    *out.add_marks() = std::move(told);
  }
  out.set_marks_left_out(static_cast<std::uint32_t>(placed.size()) -
                         static_cast<std::uint32_t>(out.marks_size()));
}

void add_lines(const Cutter& cutter, double tolerance_m, wire::ChartObjects& out) {
  for (const CutLine& line : cutter.lines) {
    wire::ChartLine told;
    told.set_kind(line.kind);
    told.set_depth_m(static_cast<double>(line.depth_m));
    std::int64_t east = 0, north = 0;
    for (std::size_t i = 0; i < line.points.size(); ++i) {
      if (!(static_cast<double>(line.significance[i]) > tolerance_m)) continue;
      const std::int64_t x = cutter.east(line.points[i]), y = Cutter::north(line.points[i]);
      told.add_points(static_cast<std::int32_t>(x - east));
      told.add_points(static_cast<std::int32_t>(y - north));
      east = x;
      north = y;
    }
    // An island or a hole that is smaller than the tolerance is left with its two ends at one
    // place.
    const bool is_dot = line.points.front() == line.points.back() && told.points_size() <= 4;
    if (!is_dot) *out.add_lines() = std::move(told);
  }
}

}  // namespace

wire::ChartObjects chart_objects_of(const echo::CoastChart& coast, const echo::ChartDetail& detail,
                                    const wire::GetChartObjects& place, std::size_t most_bytes) {
  Cutter cutter(place);
  for (const echo::CoastRing& ring : coast.rings) cutter.add_shore(ring);
  for (const echo::DepthContour& contour : detail.contours) cutter.add_contour(contour);

  wire::ChartObjects out;
  out.set_latitude_deg(place.latitude_deg());
  out.set_longitude_deg(place.longitude_deg());
  out.set_radius_nm(place.radius_nm());
  out.set_chart(coast.source);
  out.set_coast_only(!detail.is_charted);
  add_marks(detail, cutter, static_cast<std::size_t>(kMarkShare * static_cast<double>(most_bytes)),
            out);
  for (double tolerance_m = place.tolerance_m();;
       tolerance_m = std::max(kLeastTolerance_m, 2.0 * tolerance_m)) {
    out.clear_lines();
    add_lines(cutter, tolerance_m, out);
    out.set_tolerance_m(tolerance_m);
    // Beyond the square all lines but those from side to side are gone: no more can be done.
    if ((out.ByteSizeLong() <= most_bytes && out.lines_size() <= kMostChartLines) ||
        tolerance_m > 4.0 * place.radius_nm() * 1852.0)
      break;
  }
  return out;
}

const wire::ChartObjects& ChartObjectsMaker::about(const echo::ChartSource& chart,
                                                   const wire::GetChartObjects& place) {
  const auto same = std::find_if(kept_.begin(), kept_.end(), [&](const Kept& kept) {
    return google::protobuf::util::MessageDifferencer::Equals(kept.place, place);
  });
  if (same != kept_.end()) return same->objects;
  const GeoPoint centre{place.latitude_deg(), place.longitude_deg()};
  const Length radius = nautical_miles(place.radius_nm());
  wire::ChartObjects made =
      chart_objects_of(chart.load(centre, radius), chart.detail(centre, radius), place);
  if (kept_.size() == kKept) kept_.pop_front();
  kept_.push_back({place, std::move(made)});
  return kept_.back().objects;
}

}  // namespace skerry::server
