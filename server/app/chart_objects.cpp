#include "server/app/chart_objects.hpp"

#include <google/protobuf/util/message_differencer.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "protocol/wire/utf8.hpp"
#include "server/app/chart_lines.hpp"
#include "server/app/contour_join.hpp"
#include "server/relayed/sendable_text.hpp"

namespace skerry::server {
namespace {

constexpr double kMetresPerChartDegree = 60.0 * 1852.0;
constexpr double kLeastTolerance_m = 0.5;   // where the one asked for is 0 and cannot be kept
constexpr std::size_t kLongestName = 64;    // bytes
constexpr std::size_t kLongestChart = 200;  // bytes of the chart's name
constexpr std::size_t kBytesOfCounts = 16;  // tolerance and lines left out, with their tags

struct CutLine {
  wire::ChartLine::Kind kind = wire::ChartLine::COAST;
  float depth_m = 0.0f;
  std::vector<PlanePoint> points;
  std::vector<float> significance;
  double extent_m = 0.0;  // the diagonal of its box
};

double diagonal_of(const std::vector<PlanePoint>& line) {
  PlanePoint least = line.front(), most = line.front();
  for (const PlanePoint& point : line) {
    least = {std::min(least.east_m, point.east_m), std::min(least.north_m, point.north_m)};
    most = {std::max(most.east_m, point.east_m), std::max(most.north_m, point.north_m)};
  }
  return length_of(most - least);
}

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
      const double extent_m = diagonal_of(part);
      lines.push_back({kind, depth_m, std::move(part), std::move(counts), extent_m});
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

// The most that a message of so many bytes takes within another: its tag and its length too.
std::size_t bytes_within(std::size_t bytes) {
  return bytes + (bytes < 128 ? 2 : bytes < 16'384 ? 3 : 6);
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
    bytes += bytes_within(told.ByteSizeLong());
    if (bytes > most_bytes || out.marks_size() >= kMostChartMarks) break;
    *out.add_marks() = std::move(told);
  }
  out.set_marks_left_out(static_cast<std::uint32_t>(placed.size()) -
                         static_cast<std::uint32_t>(out.marks_size()));
}

wire::ChartLine thinned(const CutLine& line, const Cutter& cutter, double tolerance_m) {
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
  return told;
}

// Puts the lines into `out`, in their order, as far as they fit into kMostChartLines and
// `most_bytes`.  How many do not; nothing if one of the first kMostChartLines does not fit into the
// bytes, without `may_leave_out`.
std::optional<std::uint32_t> add_lines(const Cutter& cutter, double tolerance_m,
                                       std::size_t most_bytes, bool may_leave_out,
                                       wire::ChartObjects& out) {
  std::size_t bytes = 0;
  std::uint32_t left_out = 0;
  for (const CutLine& line : cutter.lines) {
    wire::ChartLine told = thinned(line, cutter, tolerance_m);
    // An island or a hole that is smaller than the tolerance is left with its two ends at one
    // place.
    if (line.points.front() == line.points.back() && told.points_size() <= 4) continue;
    const std::size_t own = bytes_within(told.ByteSizeLong());
    const bool is_room = out.lines_size() < kMostChartLines;
    if (!is_room || bytes + own > most_bytes) {
      if (is_room && !may_leave_out) return std::nullopt;
      ++left_out;
      continue;
    }
    bytes += own;
    *out.add_lines() = std::move(told);
  }
  return left_out;
}

// Coast before contours, of each the longest first.
void sort_by_extent(std::vector<CutLine>& lines) {
  std::stable_sort(lines.begin(), lines.end(), [](const CutLine& a, const CutLine& b) {
    return a.kind != b.kind ? a.kind == wire::ChartLine::COAST : a.extent_m > b.extent_m;
  });
}

}  // namespace

wire::ChartObjects chart_objects_of(const echo::CoastChart& coast, const echo::ChartDetail& detail,
                                    const wire::GetChartObjects& place, std::size_t most_bytes) {
  Cutter cutter(place);
  for (const echo::CoastRing& ring : coast.rings) cutter.add_shore(ring);
  for (const echo::DepthContour& contour : joined(detail.contours)) cutter.add_contour(contour);

  wire::ChartObjects out;
  out.set_latitude_deg(place.latitude_deg());
  out.set_longitude_deg(place.longitude_deg());
  out.set_radius_nm(place.radius_nm());
  out.set_chart(sendable(coast.source, kLongestChart));
  out.set_coast_only(!detail.is_charted);
  add_marks(detail, cutter, static_cast<std::size_t>(kMarkShare * static_cast<double>(most_bytes)),
            out);
  sort_by_extent(cutter.lines);
  const std::size_t taken = out.ByteSizeLong() + kBytesOfCounts;
  const std::size_t room = most_bytes - std::min(most_bytes, taken);
  // Open lines do not become fewer by tolerance: it is for the bytes alone, and has an end.
  const double most_m = kMostTolerance * place.radius_nm() * 1852.0;
  for (double tolerance_m = place.tolerance_m();;
       tolerance_m = std::min(most_m, std::max(kLeastTolerance_m, 2.0 * tolerance_m))) {
    const bool is_last = tolerance_m >= most_m;
    out.clear_lines();
    out.set_tolerance_m(tolerance_m);
    if (const auto left_out = add_lines(cutter, tolerance_m, room, is_last, out)) {
      out.set_lines_left_out(*left_out);
      return out;
    }
  }
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
