#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/chart/local_plane.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/track_tool/track_writer.hpp"

namespace skerry::server {
namespace {

constexpr double kMile_m = Length::kMetresPerNauticalMile;

const char* word_of(TrackStatus status) {
  switch (status) {
    case TrackStatus::tentative:
      return "tentative";
    case TrackStatus::tracked:
      return "tracked";
    case TrackStatus::lost:
      return "lost";
  }
  return "";
}

std::string minutes_text(double minutes) {
  std::string text = fmt::format("{:.2f}", minutes);
  return text == "-0.00" ? "0.00" : text;
}

TrackRow row_of(const PlottedTrack& track) {
  const PlottedApproach closest = closest_approach(track);
  const double course_rad = std::atan2(track.velocity_mps.east_m, track.velocity_mps.north_m);
  TrackRow row;
  row.since = since_of(track.utc, track.time);
  row.number = track.number;
  row.status = track.status;
  row.place = track.place;
  row.course_deg = radians(course_rad).in_degrees();
  row.speed_kn = length_of(track.velocity_mps) / kKnot;
  row.range_m = track.range_m;
  row.bearing_deg = track.bearing.in_degrees();
  row.cpa_nm = closest.range_m / kMile_m;
  if (closest.moves) row.tcpa_min = closest.time_s / 60.0;
  row.place_sigma_m = track.place_sigma_m;
  row.hits = track.hits;
  row.looks = track.looks;
  row.by_hand = track.by_hand;
  row.own_ship = track.own_ship;
  return row;
}

}  // namespace

Duration since_of(UtcTime utc, ScenarioTime scenario) {
  return utc.time_since_epoch().count() != 0 ? utc.time_since_epoch() : scenario.time_since_epoch();
}

std::string time_text(Duration since) {
  const auto ms = std::chrono::round<std::chrono::milliseconds>(since).count();
  const auto size = static_cast<std::uint64_t>(ms < 0 ? -ms : ms);
  return fmt::format("{}{}.{:03}", ms < 0 ? "-" : "", size / 1000, size % 1000);
}

std::string degrees_text(double degrees) {
  const double turn = degrees - 360.0 * std::floor(degrees / 360.0);
  std::string text = fmt::format("{:.2f}", turn);
  return text == "360.00" ? "0.00" : text;
}

void TableWriter::turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) {
  for (const PlottedTrack& track : tracked) row(row_of(track));
  for (const PlottedTrack& track : lost) row(row_of(track));
}

TrackCsv::TrackCsv(std::uint32_t radar, TextSink sink) : radar_(radar), sink_(std::move(sink)) {
  sink_(
      "utc_s,radar,track,status,lat_deg,lon_deg,course_deg,speed_kn,range_nm,bearing_deg,cpa_nm,"
      "tcpa_min,place_sigma_m,hits,looks,by_hand,own_lat_deg,own_lon_deg\n");
}

void TrackCsv::row(const TrackRow& row) {
  sink_(fmt::format(
      "{},{},{},{},{:.7f},{:.7f},{},{},{:.4f},{},{},{},{:.1f},{},{},{},{:.7f},{:.7f}\n",
      time_text(row.since), radar_, row.number, word_of(row.status), row.place.latitude_deg,
      row.place.longitude_deg, row.course_deg ? degrees_text(*row.course_deg) : "",
      row.speed_kn ? fmt::format("{:.2f}", *row.speed_kn) : "", row.range_m / kMile_m,
      degrees_text(row.bearing_deg), row.cpa_nm ? fmt::format("{:.4f}", *row.cpa_nm) : "",
      row.tcpa_min ? minutes_text(*row.tcpa_min) : "", row.place_sigma_m, row.hits, row.looks,
      row.by_hand ? 1 : 0, row.own_ship.latitude_deg, row.own_ship.longitude_deg));
}

PlotCsv::PlotCsv(std::uint32_t radar, TextSink sink) : radar_(radar), sink_(std::move(sink)) {
  sink_(
      "utc_s,radar,lat_deg,lon_deg,range_nm,bearing_deg,range_sigma_m,bearing_sigma_deg,length_m,"
      "width_m,level,cells,extended,own_lat_deg,own_lon_deg\n");
}

void PlotCsv::add(const Plot& plot) {
  const double bearing_rad = plot.bearing.in_radians();
  const GeoPoint place =
      echo::LocalPlane(plot.own_ship)
          .to_geo({plot.range_m * std::sin(bearing_rad), plot.range_m * std::cos(bearing_rad)});
  sink_(fmt::format(
      "{},{},{:.7f},{:.7f},{:.4f},{},{:.1f},{:.3f},{:.1f},{:.1f},{},{},{},{:.7f},"
      "{:.7f}\n",
      time_text(plot.utc, plot.time), radar_, place.latitude_deg, place.longitude_deg,
      plot.range_m / kMile_m, degrees_text(plot.bearing.in_degrees()), plot.range_sigma_m,
      radians(plot.bearing_sigma_rad).in_degrees(), plot.length_m, plot.width_m, plot.greatest,
      plot.cells, plot.extended ? 1 : 0, plot.own_ship.latitude_deg, plot.own_ship.longitude_deg));
}

}  // namespace skerry::server
