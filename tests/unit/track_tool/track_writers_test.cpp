#include "server/track_tool/track_writer.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "server/track_tool/geojson_writer.hpp"
#include "server/track_tool/track_recording.hpp"

namespace skerry::server {
namespace {

constexpr UtcTime kBegin{std::chrono::seconds(1'795'341'600)};

// East of own ship, 2 NM off, steering north at 10 kn; own ship lies still.
PlottedTrack northbound(std::uint32_t number, Duration since = {}) {
  PlottedTrack track;
  track.number = number;
  track.status = TrackStatus::tracked;
  track.time = ScenarioTime(since + std::chrono::seconds(100));
  track.utc = kBegin + since;
  track.place = {60.0, 5.0};
  track.velocity_mps = track.relative_velocity_mps = {0.0, 10.0 * 1852.0 / 3600.0};
  track.own_ship = {60.0, 4.9332846};
  track.range_m = 2.0 * 1852.0;
  track.bearing = TrueBearing::from(degrees(90.0));
  track.place_sigma_m = 12.34;
  track.hits = 8;
  track.looks = 10;
  return track;
}

struct Text {
  std::string text;
  TextSink sink() {
    return [this](std::string_view more) { text += more; };
  }
  // Without the first line.
  std::string rows() const { return text.substr(text.find('\n') + 1); }
};

TEST(TrackCsv, HasARowForEachTrackAndTurn) {
  Text out;
  TrackCsv csv(3, out.sink());
  const PlottedTrack first = northbound(1);
  PlottedTrack second = northbound(7, std::chrono::milliseconds(2500));
  second.by_hand = true;
  csv.turn({&first, 1}, {});
  csv.turn({&second, 1}, {});
  csv.finish();
  EXPECT_EQ(out.text,
            "utc_s,radar,track,status,lat_deg,lon_deg,course_deg,speed_kn,range_nm,bearing_deg,"
            "cpa_nm,tcpa_min,place_sigma_m,hits,looks,by_hand,own_lat_deg,own_lon_deg\n"
            "1795341600.000,3,1,tracked,60.0000000,5.0000000,0.00,10.00,2.0000,90.00,2.0000,0.00,"
            "12.3,8,10,0,60.0000000,4.9332846\n"
            "1795341602.500,3,7,tracked,60.0000000,5.0000000,0.00,10.00,2.0000,90.00,2.0000,0.00,"
            "12.3,8,10,1,60.0000000,4.9332846\n");
}

TEST(TrackCsv, TellsTheClosestApproach) {
  Text out;
  TrackCsv csv(0, out.sink());
  PlottedTrack track = northbound(1);
  track.relative_velocity_mps = {-20.0 * 1852.0 / 3600.0, 0.0};  // towards us, 20 kn: 6 min
  csv.turn({&track, 1}, {});
  EXPECT_NE(out.rows().find(",90.00,0.0000,6.00,"), std::string::npos) << out.rows();
}

TEST(TrackCsv, WithoutRelativeMotionHasNoTimeOfTheClosestApproach) {
  Text out;
  TrackCsv csv(0, out.sink());
  PlottedTrack track = northbound(1);
  track.relative_velocity_mps = {};
  csv.turn({&track, 1}, {});
  EXPECT_NE(out.rows().find(",90.00,2.0000,,12.3,"), std::string::npos) << out.rows();
}

TEST(TrackCsv, PutsThoseLostBehindThoseTracked) {
  Text out;
  TrackCsv csv(0, out.sink());
  const PlottedTrack tracked = northbound(2);
  PlottedTrack lost = northbound(1);
  lost.status = TrackStatus::lost;
  csv.turn({&tracked, 1}, {&lost, 1});
  EXPECT_EQ(out.rows().find("1795341600.000,0,2,tracked,"), 0u) << out.rows();
  EXPECT_NE(out.rows().find("\n1795341600.000,0,1,lost,"), std::string::npos) << out.rows();
}

TEST(TrackTexts, TimesAreUtcOrElseTheScenarios) {
  using std::chrono::milliseconds, std::chrono::nanoseconds;
  EXPECT_EQ(time_text(kBegin + milliseconds(1), ScenarioTime(milliseconds(5))), "1795341600.001");
  EXPECT_EQ(time_text(UtcTime{}, ScenarioTime(milliseconds(12'345))), "12.345");
  EXPECT_EQ(time_text(UtcTime{}, ScenarioTime(nanoseconds(999'999'600))), "1.000");
  EXPECT_EQ(time_text(UtcTime{}, ScenarioTime(-milliseconds(1'500))), "-1.500");
}

TEST(TrackTexts, DegreesAreOfATurn) {
  EXPECT_EQ(degrees_text(0.0), "0.00");
  EXPECT_EQ(degrees_text(-90.0), "270.00");
  EXPECT_EQ(degrees_text(359.994), "359.99");
  EXPECT_EQ(degrees_text(359.996), "0.00");
  EXPECT_EQ(degrees_text(-1e-9), "0.00");
  EXPECT_EQ(degrees_text(725.5), "5.50");
}

TEST(PlotCsv, HasThePlaceOfEachPlot) {
  Text out;
  PlotCsv csv(1, out.sink());
  Plot plot;
  plot.utc = kBegin + std::chrono::milliseconds(250);
  plot.own_ship = {0.0, -30.0};
  plot.bearing = TrueBearing::from(degrees(90.0));
  plot.range_m = 1852.0;
  plot.range_sigma_m = 5.0;
  plot.bearing_sigma_rad = 0.0087266463;  // half a degree
  plot.length_m = 60.0;
  plot.width_m = 20.25;
  plot.greatest = 200;
  plot.cells = 17;
  plot.extended = true;
  csv.add(plot);
  // A mile along the equator is 1852 / 111319.4908 deg.
  EXPECT_EQ(out.text,
            "utc_s,radar,lat_deg,lon_deg,range_nm,bearing_deg,range_sigma_m,bearing_sigma_deg,"
            "length_m,width_m,level,cells,extended,own_lat_deg,own_lon_deg\n"
            "1795341600.250,1,0.0000000,-29.9833632,1.0000,90.00,5.0,0.500,60.0,20.2,200,17,1,"
            "0.0000000,-30.0000000\n");
}

TEST(TrackGeoJson, HasALineForEachTrackWithItsTimes) {
  Text out;
  TrackGeoJson json(2, out.sink());
  PlottedTrack one = northbound(1), two = northbound(2);
  json.turn(std::vector{one, two}, {});
  one = northbound(1, std::chrono::milliseconds(2500));
  one.place.latitude_deg = 60.0001;
  PlottedTrack lost = two;
  lost.status = TrackStatus::lost;
  json.turn({&one, 1}, {&lost, 1});
  json.finish();
  EXPECT_EQ(out.text,
            "{\"type\":\"FeatureCollection\",\"features\":[\n"
            "{\"type\":\"Feature\",\"geometry\":{\"type\":\"Point\",\"coordinates\":"
            "[5.0000000,60.0000000]},\"properties\":{\"radar\":2,\"track\":2,\"status\":\"lost\","
            "\"course_deg\":0.00,\"speed_kn\":10.00,\"begin_utc_s\":1795341600.000,"
            "\"end_utc_s\":1795341600.000,\"times_utc_s\":[1795341600.000]}},\n"
            "{\"type\":\"Feature\",\"geometry\":{\"type\":\"LineString\",\"coordinates\":"
            "[[5.0000000,60.0000000],[5.0000000,60.0001000]]},\"properties\":{\"radar\":2,"
            "\"track\":1,\"status\":\"tracked\",\"course_deg\":0.00,\"speed_kn\":10.00,"
            "\"begin_utc_s\":1795341600.000,\"end_utc_s\":1795341602.500,\"times_utc_s\":"
            "[1795341600.000,1795341602.500]}}\n"
            "]}\n");
}

TEST(TrackGeoJson, WhatIsNotKnownIsNull) {
  Text out;
  TrackGeoJson json(0, out.sink());
  json.row({});
  json.finish();
  EXPECT_NE(out.text.find("\"course_deg\":null,\"speed_kn\":null,"), std::string::npos) << out.text;
}

TEST(TrackGeoJson, OfNothingIsAnEmptyCollection) {
  Text out;
  TrackGeoJson json(0, out.sink());
  json.turn({}, {});
  json.finish();
  EXPECT_EQ(out.text, "{\"type\":\"FeatureCollection\",\"features\":[\n]}\n");
}

TEST(TrackGeoJson, IsCutAtTheMeridianOf180) {
  for (const bool east : {true, false}) {
    Text out;
    TrackGeoJson json(0, out.sink());
    PlottedTrack track = northbound(1);
    track.place = {10.0, east ? 179.99 : -179.99};
    json.turn({&track, 1}, {});
    track = northbound(1, std::chrono::seconds(4));
    track.place = {10.4, east ? -179.97 : 179.97};
    json.turn({&track, 1}, {});
    json.finish();
    const std::string side = east ? "" : "-", other = east ? "-" : "";
    EXPECT_NE(
        out.text.find("{\"type\":\"MultiLineString\",\"coordinates\":[[[" + side +
                      "179.9900000,10.0000000],[" + side + "180.0000000,10.1000000]],[[" + other +
                      "180.0000000,10.1000000],[" + other + "179.9700000,10.4000000]]]}"),
        std::string::npos)
        << out.text;
    EXPECT_NE(out.text.find("\"times_utc_s\":[[1795341600.000,1795341601.000],[1795341601.000,"
                            "1795341604.000]]"),
              std::string::npos)
        << out.text;
  }
}

TEST(TrackWriterFor, GoesByTheEnding) {
  Text out;
  EXPECT_NE(dynamic_cast<TrackCsv*>(track_writer_for("a.csv", {}, out.sink()).get()), nullptr);
  EXPECT_NE(dynamic_cast<TrackGeoJson*>(track_writer_for("a.geojson", {}, out.sink()).get()),
            nullptr);
  EXPECT_NE(dynamic_cast<TrackRecording*>(track_writer_for("a.mcap", {}, out.sink()).get()),
            nullptr);
  EXPECT_EQ(track_table_for("a.mcap", 0, out.sink()), nullptr) << "it is no table";
  for (const char* other : {"a.json", "csv", "a.csv.gz", ""}) {
    EXPECT_EQ(track_writer_for(other, {}, out.sink()), nullptr) << other;
  }
}

}  // namespace
}  // namespace skerry::server
