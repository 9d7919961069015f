#include "server/track_tool/geojson_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

std::string since_text(Duration since) { return time_text(UtcTime(since), ScenarioTime(since)); }

// Coordinates and times of a line that does not cross the 180th meridian.
struct Part {
  std::string places, times;
  std::size_t points = 0;

  void add(GeoPoint place, Duration since) {
    const char* comma = points++ == 0 ? "" : ",";
    places += fmt::format("{}[{:.7f},{:.7f}]", comma, place.longitude_deg, place.latitude_deg);
    times += fmt::format("{}{}", comma, since_text(since));
  }
};

}  // namespace

TrackGeoJson::TrackGeoJson(std::uint32_t radar, TextSink sink)
    : radar_(radar), sink_(std::move(sink)) {
  sink_("{\"type\":\"FeatureCollection\",\"features\":[");
}

void TrackGeoJson::turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) {
  for (const PlottedTrack& track : tracked) add(track);
  for (const PlottedTrack& track : lost) {
    add(track);
    end(lines_[track.number]);
    lines_.erase(track.number);
  }
}

void TrackGeoJson::finish() {
  for (const auto& [number, line] : lines_) end(line);
  lines_.clear();
  sink_("\n]}\n");
}

void TrackGeoJson::add(const PlottedTrack& track) {
  Line& line = lines_[track.number];
  const Point point{track.place, track.utc.time_since_epoch().count() != 0
                                     ? track.utc.time_since_epoch()
                                     : track.time.time_since_epoch()};
  // A lost one's last place may be that of a turn before.
  if (line.points.empty() || point.since > line.points.back().since) line.points.push_back(point);
  line.last = track;
}

void TrackGeoJson::end(const Line& line) {
  std::vector<Part> parts(1);
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    const Point& point = line.points[i];
    if (i > 0) {
      const Point& before = line.points[i - 1];
      const double way_deg = point.place.longitude_deg - before.place.longitude_deg;
      if (std::fabs(way_deg) > 180.0) {
        // Eastwards from 179 to -179 the way is 2.
        const double side_deg = way_deg < 0.0 ? 180.0 : -180.0;
        const double share = (side_deg - before.place.longitude_deg) / (way_deg + 2.0 * side_deg);
        const double latitude_deg = before.place.latitude_deg +
                                    share * (point.place.latitude_deg - before.place.latitude_deg);
        const Duration since =
            before.since + seconds_as_duration(share * in_seconds(point.since - before.since));
        parts.back().add({latitude_deg, side_deg}, since);
        parts.emplace_back().add({latitude_deg, -side_deg}, since);
      }
    }
    parts.back().add(point.place, point.since);
  }
  std::string type, places, times;
  if (parts.size() > 1) {
    type = "MultiLineString";
    for (const Part& part : parts) {
      const char* comma = places.empty() ? "" : ",";
      places += fmt::format("{}[{}]", comma, part.places);
      times += fmt::format("{}[{}]", comma, part.times);
    }
    places = fmt::format("[{}]", places);
  } else {
    type = parts[0].points > 1 ? "LineString" : "Point";
    places = parts[0].points > 1 ? fmt::format("[{}]", parts[0].places) : parts[0].places;
    times = parts[0].times;
  }
  const PlottedTrack& last = line.last;
  const double course_rad = std::atan2(last.velocity_mps.east_m, last.velocity_mps.north_m);
  sink_(fmt::format(
      "{}\n{{\"type\":\"Feature\",\"geometry\":{{\"type\":\"{}\",\"coordinates\":{}}},"
      "\"properties\":{{\"radar\":{},\"track\":{},\"status\":\"{}\","
      "\"course_deg\":{},\"speed_kn\":{:.2f},\"begin_utc_s\":{},\"end_utc_s\":{},"
      "\"times_utc_s\":[{}]}}}}",
      std::exchange(any_, true) ? "," : "", type, places, radar_, last.number,
      last.status == TrackStatus::lost ? "lost" : "tracked",
      degrees_text(radians(course_rad).in_degrees()), length_of(last.velocity_mps) / kKnot,
      since_text(line.points.front().since), since_text(line.points.back().since), times));
}

}  // namespace skerry::server
