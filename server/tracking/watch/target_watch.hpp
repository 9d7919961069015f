// TargetWatch: what a mariner has of a view's targets: zones, alerts, trial, AIS, past positions.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "echo/chart/local_plane.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/targets.pb.h"
#include "server/plotter/plotter.hpp"

namespace skerry::server {

// What is known aboard own ship at a moment, by her sensors; absent: that sensor is lost, or there
// is none.
struct OwnSensors {
  UtcTime utc{};
  std::optional<GeoPoint> place;
  std::optional<double> heading_deg;  // true
  // East and north, m/s: by positions; by heading and log.
  std::optional<PlanePoint> over_ground_mps, through_water_mps;
};

// What AIS last told of a ship, at `utc`.
struct AisContact {
  std::uint32_t mmsi = 0;
  std::string name;
  GeoPoint place;
  std::optional<double> course_deg, speed_mps, heading_deg;  // over ground; true
  UtcTime utc{};
};

// Of one view of one radar, with one plotter, which numbers its tracks.  The same calls make the
// same lists.
//
// Thread: one at a time.
class TargetWatch {
 public:
  TargetWatch(std::uint32_t radar, std::uint32_t view);
  ~TargetWatch();
  TargetWatch(TargetWatch&&) noexcept;
  TargetWatch& operator=(TargetWatch&&) noexcept;

  // What a plotter of this view is to be made with.
  Plotter::Rule plotter_rule() const;

  // Carries out an order, all of it or nothing; Reply.text says what was wrong and what is allowed.
  // An acquisition answers with the target's number; "no echo there" where there is none.
  wire::Reply order(const wire::TargetOrder& order, Plotter& plotter);

  // False while heading or position is lost: the video's bearings or places are then wrong, and
  // spokes must not be given to the plotter.
  static bool can_plot(const OwnSensors& own) { return own.place && own.heading_deg; }

  // Goes on to own.utc: takes the plotter's tracks and those lost, and looks after alerts.  Call it
  // at least twice a second.  A time that goes back, or on by more than three minutes, ends what
  // hangs on time: alerts, past positions, lost targets, AIS targets, a trial.
  void update(const OwnSensors& own, std::span<const AisContact> ais, Plotter& plotter);

  // As of the last update; orders show in the next one.  The caller fills in spokes_lost, and
  // scenario_ns where there are no tracks: here it is theirs.
  const wire::TargetList& list() const;

 private:
  class Desk;
  std::unique_ptr<Desk> desk_;
};

}  // namespace skerry::server
