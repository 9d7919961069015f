#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/chart/local_plane.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/track_tool/geojson_writer.hpp"
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

std::string minutes_text(double seconds) {
  std::string text = fmt::format("{:.2f}", seconds / 60.0);
  return text == "-0.00" ? "0.00" : text;
}

}  // namespace

std::string time_text(UtcTime utc, ScenarioTime scenario) {
  const Duration since =
      utc.time_since_epoch().count() != 0 ? utc.time_since_epoch() : scenario.time_since_epoch();
  const auto ms = std::chrono::round<std::chrono::milliseconds>(since).count();
  const auto size = static_cast<std::uint64_t>(ms < 0 ? -ms : ms);
  return fmt::format("{}{}.{:03}", ms < 0 ? "-" : "", size / 1000, size % 1000);
}

std::string degrees_text(double degrees) {
  const double turn = degrees - 360.0 * std::floor(degrees / 360.0);
  std::string text = fmt::format("{:.2f}", turn);
  return text == "360.00" ? "0.00" : text;
}

std::unique_ptr<TrackWriter> track_writer_for(std::string_view file, std::uint32_t radar,
                                              TextSink sink) {
  if (file.ends_with(".csv")) return std::make_unique<TrackCsv>(radar, std::move(sink));
  if (file.ends_with(".geojson")) return std::make_unique<TrackGeoJson>(radar, std::move(sink));
  return nullptr;
}

TrackCsv::TrackCsv(std::uint32_t radar, TextSink sink) : radar_(radar), sink_(std::move(sink)) {
  sink_(
      "utc_s,radar,track,status,lat_deg,lon_deg,course_deg,speed_kn,range_nm,bearing_deg,cpa_nm,"
      "tcpa_min,place_sigma_m,hits,looks,by_hand,own_lat_deg,own_lon_deg\n");
}

void TrackCsv::turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) {
  for (const PlottedTrack& track : tracked) row(track);
  for (const PlottedTrack& track : lost) row(track);
}

void TrackCsv::row(const PlottedTrack& track) {
  const PlottedApproach closest = closest_approach(track);
  const double speed_mps = length_of(track.velocity_mps);
  const double course_rad = std::atan2(track.velocity_mps.east_m, track.velocity_mps.north_m);
  sink_(
      fmt::format("{},{},{},{},{:.7f},{:.7f},{},{:.2f},{:.4f},{},{:.4f},{},{:.1f},{},{},{},{:.7f},"
                  "{:.7f}\n",
                  time_text(track.utc, track.time), radar_, track.number, word_of(track.status),
                  track.place.latitude_deg, track.place.longitude_deg,
                  degrees_text(radians(course_rad).in_degrees()), speed_mps / kKnot,
                  track.range_m / kMile_m, degrees_text(track.bearing.in_degrees()),
                  closest.range_m / kMile_m, closest.moves ? minutes_text(closest.time_s) : "",
                  track.place_sigma_m, track.hits, track.looks, track.by_hand ? 1 : 0,
                  track.own_ship.latitude_deg, track.own_ship.longitude_deg));
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
