// Tracks and plots as files: what the writers share.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>

#include "server/plotter/plots/plot.hpp"
#include "server/plotter/tracks/track.hpp"

namespace skerry::server {

using TextSink = std::function<void(std::string_view)>;

// Takes tracks turn by turn.  The text is a function of what it was given.
// Thread: one at a time.
class TrackWriter {
 public:
  virtual ~TrackWriter() = default;
  // At the end of a turn: those tracked then, by number, and those lost in it.
  virtual void turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) = 0;
  // No turn follows.
  virtual void finish() = 0;
};

// The writer that a file's ending asks for; null: there is none.
std::unique_ptr<TrackWriter> track_writer_for(std::string_view file, std::uint32_t radar,
                                              TextSink sink);
inline constexpr const char* kTrackEndings = ".csv or .geojson";

// A row for each track and turn, under a line of names:
// utc_s,radar,track,status,lat_deg,lon_deg,course_deg,speed_kn,range_nm,bearing_deg,cpa_nm,tcpa_min,
// place_sigma_m,hits,looks,by_hand,own_lat_deg,own_lon_deg.  Lost ones have one row more, `lost`,
// with their last place.  Without relative motion cpa_nm is the range and tcpa_min is empty.
class TrackCsv final : public TrackWriter {
 public:
  TrackCsv(std::uint32_t radar, TextSink sink);
  void turn(std::span<const PlottedTrack> tracked, std::span<const PlottedTrack> lost) override;
  void finish() override {}

 private:
  void row(const PlottedTrack& track);

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

// Seconds since 1970 to the millisecond: "1795341600.125".  Without UTC the scenario's time.
std::string time_text(UtcTime utc, ScenarioTime scenario);
// In [0, 360) with two decimals; what rounds to 360 is "0.00".
std::string degrees_text(double degrees);

}  // namespace skerry::server
