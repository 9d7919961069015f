#include "server/debrief/chart_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "server/page/html_text.hpp"
#include "server/page/plot_figure.hpp"

namespace skerry::server {
namespace {

constexpr double kMile_m = 1852.0, kDegree_m = 60.0 * kMile_m;
constexpr double kSheetWidth = 1000.0, kMostHeight = 760.0, kLeastHeight = 420.0;
constexpr double kLeastHalf_m = 0.4 * kMile_m;

class Sheet {
 public:
  explicit Sheet(const ChartExtent& extent) : extent_(extent) {
    height_ = std::clamp(kSheetWidth * extent.half_north_m / extent.half_east_m, kLeastHeight,
                         kMostHeight);
    scale_ = std::min(0.5 * kSheetWidth / extent.half_east_m, 0.5 * height_ / extent.half_north_m);
    parallel_ = std::max(0.01, std::cos(degrees(extent.middle.latitude_deg).in_radians()));
  }
  double height() const { return height_; }
  double pixels_a_metre() const { return scale_; }
  PlanePoint at(GeoPoint place) const {
    return from_degrees(wrapped_longitude(place.longitude_deg - extent_.middle.longitude_deg),
                        place.latitude_deg - extent_.middle.latitude_deg);
  }
  PlanePoint from_degrees(double east, double north) const {
    return {0.5 * kSheetWidth + scale_ * east * kDegree_m * parallel_,
            0.5 * height_ - scale_ * north * kDegree_m};
  }
  bool has(PlanePoint p) const {
    return p.east_m >= 0.0 && p.east_m <= kSheetWidth && p.north_m >= 0.0 && p.north_m <= height_;
  }
  // Degrees at the edges.
  double west() const { return extent_.middle.longitude_deg - half_width_deg(); }
  double half_width_deg() const { return 0.5 * kSheetWidth / scale_ / kDegree_m / parallel_; }
  double half_height_deg() const { return 0.5 * height_ / scale_ / kDegree_m; }

 private:
  ChartExtent extent_;
  double height_, scale_, parallel_;
};

std::string degree_text(double degrees, char positive, char negative) {
  const double minutes = std::round(std::fabs(degrees) * 6000.0) / 100.0;
  return fmt::format("{:.0f}°{:05.2f}'{}", std::floor(minutes / 60.0 + 1e-9),
                     minutes - 60.0 * std::floor(minutes / 60.0 + 1e-9),
                     degrees < 0.0 ? negative : positive);
}

double degree_tick(double span_deg) {
  for (const double minutes : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 30.0, 60.0, 120.0}) {
    if (60.0 * span_deg / minutes <= 6.0) return minutes / 60.0;
  }
  return 5.0;
}

void draw_coast(const wire::Coastline& coast, const Sheet& sheet, const ChartExtent& extent,
                std::string& out) {
  const double east0 = wrapped_longitude(coast.longitude_deg() - extent.middle.longitude_deg);
  const double north0 = coast.latitude_deg() - extent.middle.latitude_deg;
  for (const wire::Coastline::Line& line : coast.lines()) {
    std::string path;
    std::int64_t east = 0, north = 0;
    PlanePoint last{-1e9, -1e9};
    for (int i = 0; i + 1 < line.points_size(); i += 2) {
      east += line.points(i);
      north += line.points(i + 1);
      const PlanePoint p = sheet.from_degrees(east0 + 1e-6 * static_cast<double>(east),
                                              north0 + 1e-6 * static_cast<double>(north));
      if (length_of(p - last) < 0.7) continue;  // of a pixel
      last = p;
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.east_m, p.north_m);
    }
    out += fmt::format("<path class=\"{}\" d=\"{}Z\"/>", line.water() ? "lake" : "land", path);
  }
}

void draw_graticule(const Sheet& sheet, const ChartExtent& extent, std::string& out) {
  const double lat0 = extent.middle.latitude_deg, lon0 = extent.middle.longitude_deg;
  const double lat_tick = degree_tick(2.0 * sheet.half_height_deg());
  for (double lat = std::ceil((lat0 - sheet.half_height_deg()) / lat_tick) * lat_tick;
       lat < lat0 + sheet.half_height_deg(); lat += lat_tick) {
    const double y = sheet.from_degrees(0.0, lat - lat0).north_m;
    out += fmt::format("<path class=\"grid\" d=\"M0 {:.1f}H{:.0f}\"/>", y, kSheetWidth);
    if (y > 24.0 && y < sheet.height() - 24.0) {
      out += fmt::format("<text class=\"tick\" x=\"4\" y=\"{:.1f}\">{}</text>", y - 3.0,
                         degree_text(lat, 'N', 'S'));
    }
  }
  const double lon_tick = degree_tick(2.0 * sheet.half_width_deg());
  for (double lon = std::ceil((lon0 - sheet.half_width_deg()) / lon_tick) * lon_tick;
       lon < lon0 + sheet.half_width_deg(); lon += lon_tick) {
    const double x = sheet.from_degrees(lon - lon0, 0.0).east_m;
    out += fmt::format("<path class=\"grid\" d=\"M{:.1f} 0V{:.0f}\"/>", x, sheet.height());
    if (x > 90.0 && x < kSheetWidth - 70.0) {
      out += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.0f}\">{}</text>", x + 3.0,
                         sheet.height() - 5.0, degree_text(wrapped_longitude(lon), 'E', 'W'));
    }
  }
}

void draw_scale(const Sheet& sheet, std::string& out) {
  double miles = 0.1;
  for (const double each : {0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0}) {
    if (each * kMile_m * sheet.pixels_a_metre() <= 220.0) miles = each;
  }
  const double length = miles * kMile_m * sheet.pixels_a_metre(), right = kSheetWidth - 16.0;
  out += fmt::format(
      "<path class=\"scale\" d=\"M{:.1f} 16v8H{:.1f}v-8\"/>"
      "<text class=\"label\" x=\"{:.1f}\" y=\"16\" text-anchor=\"middle\">{:g} NM</text>",
      right - length, right, right - 0.5 * length, miles);
}

// The part of a track that lies within a few figures' widths, without points that no one sees.
std::string track_path(const ShipTrack& track, const Sheet& sheet) {
  std::string path;
  PlanePoint last{-1e9, -1e9};
  for (std::size_t i = 0; i < track.points.size(); ++i) {
    const TrackPoint& point = track.points[i];
    const PlanePoint p = sheet.at(point.position);
    const bool begins = path.empty() || point.jumped;
    if (!begins && i + 1 < track.points.size() && length_of(p - last) < 1.0) continue;
    last = p;
    path += fmt::format("{}{:.1f} {:.1f}", begins ? "M" : "L", std::clamp(p.east_m, -3e3, 4e3),
                        std::clamp(p.north_m, -3e3, 4e3));
  }
  return path;
}

// What sets tracked.  Bounded: a set may have told of thousands.
void draw_known(const Debrief& debrief, const Sheet& sheet, std::string& out) {
  constexpr std::size_t kMostWays = 500;
  std::size_t drawn = 0;
  for (const KnownView& view : debrief.known) {
    for (const KnownTarget& target : view.targets) {
      if (drawn == kMostWays) return;
      std::string path;
      PlanePoint last{-1e9, -1e9};
      for (const GeoPoint& place : target.way) {
        const PlanePoint p = sheet.at(place);
        if (!sheet.has(p) || length_of(p - last) < 1.0) continue;
        last = p;
        path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", p.east_m, p.north_m);
      }
      if (path.find('L') == std::string::npos) continue;
      ++drawn;
      const std::string name = target.name.empty() ? "" : ", " + target.name;
      out +=
          fmt::format("<path class=\"way known\" d=\"{}\"><title>{}</title></path>", path,
                      escaped(fmt::format("target {} of {}{}", target.number, view.radar, name)));
    }
  }
}

void draw_hull(const ShipTrack& track, const TrackPoint& point, int colour, const Sheet& sheet,
               std::string& out) {
  const PlanePoint p = sheet.at(point.position);
  if (!sheet.has(p)) return;
  const double length = std::max(track.length_m * sheet.pixels_a_metre(), 12.0);
  const double side = 0.5 * std::max(track.beam_m * sheet.pixels_a_metre(), 5.0);
  out += fmt::format(
      "<path class=\"hull f{}\" transform=\"translate({:.1f} {:.1f}) rotate({:.0f})\" "
      "d=\"M0 {:.1f}L{:.1f} {:.1f}V{:.1f}H{:.1f}V{:.1f}Z\"/>",
      colour, p.east_m, p.north_m, point.heading_deg, -0.5 * length, side, -0.25 * length,
      0.5 * length, -side, -0.25 * length);
}

void draw_times(const ShipTrack& track, double every_s, const Sheet& sheet, std::string& out) {
  double next_s = 0.0;
  PlanePoint last{-1e9, -1e9};
  for (const TrackPoint& point : track.points) {
    if (point.when.at_s + 1e-6 < next_s) continue;
    next_s = (std::floor(point.when.at_s / every_s + 1e-6) + 1.0) * every_s;
    const PlanePoint p = sheet.at(point.position);
    if (!sheet.has(p)) continue;
    out += fmt::format("<circle class=\"dot\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\"/>", p.east_m,
                       p.north_m);
    if (length_of(p - last) < 34.0) continue;  // no room for another text
    last = p;
    out += fmt::format("<text class=\"time\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>", p.east_m + 5.0,
                       p.north_m - 5.0, clock_text(point.when.at_s));
  }
}

void draw_name(const ShipTrack& track, const Sheet& sheet, std::string& out) {
  // At the last place that is in sight.
  for (auto point = track.points.rbegin(); point != track.points.rend(); ++point) {
    const PlanePoint p = sheet.at(point->position);
    if (!sheet.has(p)) continue;
    const bool left = p.east_m > kSheetWidth - 120.0;
    out += fmt::format(
        "<text class=\"label{}\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>",
        track.own ? " own" : "", p.east_m + (left ? -9.0 : 9.0),
        std::clamp(p.north_m + 13.0, 12.0, sheet.height() - 18.0), left ? "end" : "start",
        escaped(track.name));
    return;
  }
}

}  // namespace

ChartExtent chart_extent(const Debrief& debrief) {
  ChartExtent extent;
  bool any = false;
  double south = 0.0, north = 0.0, west = 0.0, east = 0.0, lon0 = 0.0;
  for (const ShipTrack& track : debrief.own_ships) {
    for (const TrackPoint& point : track.points) {
      if (!any) {
        lon0 = point.position.longitude_deg;
        south = north = point.position.latitude_deg;
      }
      any = true;
      const double lon = wrapped_longitude(point.position.longitude_deg - lon0);
      south = std::min(south, point.position.latitude_deg);
      north = std::max(north, point.position.latitude_deg);
      west = std::min(west, lon);
      east = std::max(east, lon);
    }
  }
  extent.middle = {0.5 * (south + north), wrapped_longitude(lon0 + 0.5 * (west + east))};
  const double parallel =
      std::max(0.01, std::cos(degrees(extent.middle.latitude_deg).in_radians()));
  const double across = 0.5 * (east - west) * kDegree_m * parallel;
  const double along = 0.5 * (north - south) * kDegree_m;
  const double margin = std::max(kLeastHalf_m, 0.15 * std::max(across, along));
  extent.half_east_m = across + margin;
  extent.half_north_m = along + margin;
  return extent;
}

std::string chart_figure(const Debrief& debrief, const std::optional<wire::Coastline>& coast) {
  const ChartExtent extent = chart_extent(debrief);
  const Sheet sheet(extent);
  std::string out = fmt::format(
      "<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"Tracks on the "
      "chart\"><rect class=\"sea\" width=\"{:.0f}\" height=\"{:.0f}\"/>",
      kSheetWidth, sheet.height(), kSheetWidth, sheet.height());
  if (coast) draw_coast(*coast, sheet, extent, out);
  draw_graticule(sheet, extent, out);
  for (const ShipTrack& track : debrief.targets) {
    out += fmt::format("<path class=\"way target\" d=\"{}\"><title>{}</title></path>",
                       track_path(track, sheet), escaped(track.name));
    if (!track.points.empty()) draw_hull(track, track.points.back(), 8, sheet, out);
  }
  draw_known(debrief, sheet, out);
  for (std::size_t i = 0; i < debrief.own_ships.size(); ++i) {
    const ShipTrack& track = debrief.own_ships[i];
    const int colour = static_cast<int>(i % 8);
    out += fmt::format("<path class=\"way c{}\" d=\"{}\"><title>{}</title></path>", colour,
                       track_path(track, sheet), escaped(track.name));
    draw_times(track, time_tick(debrief.end.at_s, 12), sheet, out);
    if (!track.points.empty()) draw_hull(track, track.points.back(), colour, sheet, out);
  }
  for (const ShipTrack& track : debrief.targets) draw_name(track, sheet, out);
  for (const ShipTrack& track : debrief.own_ships) draw_name(track, sheet, out);
  for (std::size_t i = 0; i < debrief.contacts.size(); ++i) {
    const PlanePoint p = sheet.at(debrief.contacts[i].position);
    out += fmt::format(
        "<g class=\"mishap\"><circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"9\"/><text x=\"{:.1f}\" "
        "y=\"{:.1f}\" text-anchor=\"middle\">{}</text></g>",
        p.east_m, p.north_m, p.east_m, p.north_m + 4.0, i + 1);
  }
  draw_scale(sheet, out);
  return out + "</svg>\n";
}

}  // namespace skerry::server
