// Tracks and plots as files: what the writers share.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/wire/radar.pb.h"
#include "server/plotter/plots/plot.hpp"
#include "server/plotter/tracks/track.hpp"

namespace skerry::server {

// Takes the octets of a file in their order.
using TextSink = std::function<void(std::string_view)>;

// Takes tracks turn by turn.  What is written is a function of what was given.
// Thread: one at a time.
class TrackWriter {
 public:
  virtual ~TrackWriter() = default;
  virtual void plot(const Plot& /*plot*/) {}
  // At the end of a turn: those tracked then, by number, and those lost in it.
  virtual void turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) = 0;
  // No turn follows.
  virtual void finish() = 0;
};

// A target at a moment: a row of a table, a point of a line.
struct TrackRow {
  Duration since{};  // 1970; without UTC since the scenario's begin
  std::uint32_t number = 0;
  TrackStatus status = TrackStatus::tracked;
  GeoPoint place;
  // Over ground, true.  Absent here and below: it is not known.
  std::optional<double> course_deg, speed_kn;
  double range_m = 0.0, bearing_deg = 0.0;  // from own ship, true
  // tcpa_min is absent without relative motion, too.
  std::optional<double> cpa_nm, tcpa_min;
  double place_sigma_m = 0.0;
  std::uint32_t hits = 0, looks = 0;
  bool by_hand = false;
  GeoPoint own_ship;
};

// Writes rows.
class TableWriter : public TrackWriter {
 public:
  virtual void row(const TrackRow& row) = 0;
  void turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) final;
};

// Whose tracks they are.
struct TrackedView {
  std::uint32_t radar = 0, view = 0;
  wire::Hello hello;  // with that radar alone
};

// The writer that a file's ending asks for; null: there is none.
std::unique_ptr<TableWriter> track_table_for(std::string_view file, std::uint32_t radar,
                                             const TextSink& sink);
inline constexpr const char* kTableEndings = ".csv or .geojson";
// The same, and recordings.
std::unique_ptr<TrackWriter> track_writer_for(std::string_view file, const TrackedView& of,
                                              const TextSink& sink);
inline constexpr const char* kTrackEndings = ".csv, .geojson or .mcap";

// A row for each track and turn, under a line of names:
// utc_s,radar,track,status,lat_deg,lon_deg,course_deg,speed_kn,range_nm,bearing_deg,cpa_nm,tcpa_min,
// place_sigma_m,hits,looks,by_hand,own_lat_deg,own_lon_deg.  Lost ones have one row more, `lost`,
// with their last place.  Without relative motion cpa_nm is the range and tcpa_min is empty.
class TrackCsv final : public TableWriter {
 public:
  TrackCsv(std::uint32_t radar, TextSink sink);
  void row(const TrackRow& row) override;
  void finish() override {}

 private:
  std::uint32_t radar_;
  TextSink sink_;
};

// A row for each plot: utc_s,radar,lat_deg,lon_deg,range_nm,bearing_deg,range_sigma_m,
// bearing_sigma_deg,length_m,width_m,level,cells,extended,own_lat_deg,own_lon_deg.
class PlotCsv {
 public:
  PlotCsv(std::uint32_t radar, TextSink sink);
  void add(const Plot& plot);

 private:
  std::uint32_t radar_;
  TextSink sink_;
};

// Since 1970; without UTC since the scenario's begin.
Duration since_of(UtcTime utc, ScenarioTime scenario);
// Seconds to the millisecond: "1795341600.125".
std::string time_text(Duration since);
inline std::string time_text(UtcTime utc, ScenarioTime scenario) {
  return time_text(since_of(utc, scenario));
}
// In [0, 360) with two decimals; what rounds to 360 is "0.00".
std::string degrees_text(double degrees);

}  // namespace skerry::server
