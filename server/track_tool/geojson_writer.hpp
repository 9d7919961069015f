// TrackGeoJson: tracks as lines on a map (RFC 7946).
#pragma once

#include <map>
#include <vector>

#include "server/track_tool/track_writer.hpp"

namespace skerry::server {

// A FeatureCollection with a LineString for each track: a point for each turn.  Its properties are
// radar, track, status ("tracked": until the end; "lost"), course_deg and speed_kn of the last
// turn (null: not known), begin_utc_s, end_utc_s, and times_utc_s, the time of each point.  A line
// over the 180th meridian is a MultiLineString, cut there (RFC 7946, 3.1.9), and so are its times;
// a track of one turn is a Point.  Coordinates are longitude and latitude, degrees.
//
// Features stand in the order in which their tracks ended.  Memory: 24 octets for each turn of the
// tracks that have not ended.
class TrackGeoJson final : public TableWriter {
 public:
  TrackGeoJson(std::uint32_t radar, TextSink sink);
  void row(const TrackRow& row) override;
  void finish() override;

 private:
  struct Point {
    GeoPoint place;
    Duration since;  // 1970, or the scenario's begin
  };
  struct Line {
    TrackRow last;
    std::vector<Point> points;
  };
  void end(const Line& line);

  std::uint32_t radar_;
  TextSink sink_;
  std::map<std::uint32_t, Line> lines_;  // by number
  bool any_ = false;
};

}  // namespace skerry::server
