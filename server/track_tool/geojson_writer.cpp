#include "server/track_tool/geojson_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace skerry::server {
namespace {

// Coordinates and times of a line that does not cross the 180th meridian.
struct Part {
  std::string places, times;
  std::size_t points = 0;

  void add(GeoPoint place, Duration since) {
    const char* comma = points++ == 0 ? "" : ",";
    places += fmt::format("{}[{:.7f},{:.7f}]", comma, place.longitude_deg, place.latitude_deg);
    times += fmt::format("{}{}", comma, time_text(since));
  }
};

}  // namespace

TrackGeoJson::TrackGeoJson(std::uint32_t radar, TextSink sink)
    : radar_(radar), sink_(std::move(sink)) {
  sink_("{\"type\":\"FeatureCollection\",\"features\":[");
}

void TrackGeoJson::row(const TrackRow& row) {
  Line& line = lines_[row.number];
  // A lost one's last place may be that of a turn before.
  if (line.points.empty() || row.since > line.points.back().since) {
    line.points.push_back({row.place, row.since});
  }
  line.last = row;
  if (row.status != TrackStatus::lost) return;
  end(line);
  lines_.erase(row.number);
}

void TrackGeoJson::finish() {
  for (const auto& [number, line] : lines_) end(line);
  lines_.clear();
  sink_("\n]}\n");
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
  const TrackRow& last = line.last;
  sink_(fmt::format(
      "{}\n{{\"type\":\"Feature\",\"geometry\":{{\"type\":\"{}\",\"coordinates\":{}}},"
      "\"properties\":{{\"radar\":{},\"track\":{},\"status\":\"{}\","
      "\"course_deg\":{},\"speed_kn\":{},\"begin_utc_s\":{},\"end_utc_s\":{},"
      "\"times_utc_s\":[{}]}}}}",
      std::exchange(any_, true) ? "," : "", type, places, radar_, last.number,
      last.status == TrackStatus::lost ? "lost" : "tracked",
      last.course_deg ? degrees_text(*last.course_deg) : "null",
      last.speed_kn ? fmt::format("{:.2f}", *last.speed_kn) : "null",
      time_text(line.points.front().since), time_text(line.points.back().since), times));
}

}  // namespace skerry::server
