// Debrief: what happened in a recorded exercise, as values.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/recording/recording.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// A moment of the recording.  All lists below are by `at_s`: a restored snapshot sets the
// exercise's clock back, and a frozen one stands.
struct Moment {
  double at_s = 0.0;        // since the server's start, on the air
  double exercise_s = 0.0;  // on the exercise's clock
};

struct TrackPoint {
  Moment when;
  GeoPoint position;
  double heading_deg = 0.0, course_over_ground_deg = 0.0;  // true
  double speed_kn = 0.0;                                   // over ground, astern negative
  double turn_deg_min = 0.0;
  // Of an own ship that has a class.
  std::optional<double> rudder_deg, shaft_rpm, engine_percent;
  bool jumped = false;  // she did not sail here from the point before: she was put here
};

struct ShipTrack {
  std::string name, ship_class;
  bool own = false;
  std::size_t number = 0;  // in its list
  double length_m = 0.0, beam_m = 0.0;
  std::vector<TrackPoint> points;
};

// Two ships, the first an own ship.  Ranges are between their middles.
struct ShipPassing {
  struct Range {
    double at_s = 0.0, range_nm = 0.0;
  };
  std::size_t own_ship = 0;
  bool other_own = false;
  std::size_t other = 0;
  std::string own_name, other_name;
  double closest_m = 0.0;
  Moment when;                                      // they were closest
  double bearing_deg = 0.0;                         // true, of the other from the own ship, then
  double own_side_deg = 0.0, other_side_deg = 0.0;  // bearing of each from the other's bow, +-180
  // While the CPA was forecast to be less than the limit, within the time limit.
  double under_limit_s = 0.0;
  std::optional<Moment> first_under;
  double least_forecast_m = 0.0;  // least CPA forecast meanwhile
  std::vector<Range> ranges;      // while they were near
};

// A line of the time line.
struct HappenedLine {
  Moment when;
  // "event", "text", "mark", "fault", "alarm", "collision", "grounding"; "order" of an instructor,
  // "clock", "helm", "engine", "weather", "setting".
  std::string kind;
  std::string who;  // a ship, a radar, an instructor; empty: the exercise
  std::string text;
  std::optional<std::size_t> own_ship;  // whom it is about; nothing: all
};

// What a trainee did after something that called for it.
struct Reaction {
  Moment when;
  std::string stimulus;  // in words
  std::size_t own_ship = 0;
  std::string own_name;
  // Seconds on the air until her next order of that kind, if it came within kLongest_s.
  static constexpr double kLongest_s = 900.0;
  std::optional<double> helm_s, engine_s, setting_s;
};

struct JudgedCheck {
  Moment when;
  std::string says;
  bool reached = true, passed = false;
  std::vector<std::pair<bool, std::string>> lines;
};

// A target that a set told of.
struct KnownTarget {
  std::uint32_t number = 0;
  std::string name;  // by AIS; empty: none was taken to be the same
  bool by_hand = false;
  Moment first, last;  // it was told
  bool lost = false;   // the set lost it, at `last`; else it was let go, or told to the end
  bool to_the_end = false;
  // The least CPA that was told while it lay ahead, and the TCPA then.
  std::optional<double> least_cpa_nm, tcpa_min;
  Moment least_when;
  std::vector<GeoPoint> way;  // a place each 10 s
};

// An alert of a set.  Times are those of lists, once a second.
struct KnownAlert {
  std::uint32_t number = 0, instance = 0;
  std::string priority, title, text;
  Moment raised;
  std::optional<Moment> acknowledged;
  std::optional<Moment> ended;  // without being acknowledged
  std::optional<double> reaction_s() const {
    if (!acknowledged) return std::nullopt;
    return acknowledged->at_s - raised.at_s;
  }
};

// What a view's plotter told, as the recording has it: not the truth.
struct KnownView {
  std::optional<std::size_t> own_ship;
  std::string own_name, radar;
  std::uint32_t view = 0;
  std::vector<KnownTarget> targets;  // by the time that they were told first
  std::vector<KnownAlert> alerts;    // by the time that they were raised
  std::size_t left_out = 0;          // targets and alerts beyond what is kept
};

// An entry of the audit that was recorded: who did what.
struct Deed {
  Moment when;
  recording::AuditEntry entry;
};

struct DebriefLimits {
  double every_s = 1.0;    // between the points of tracks
  double near_nm = 3.0;    // ships that came no nearer are left out
  double cpa_nm = 0.5;     // a forecast CPA below it counts as close
  double tcpa_min = 12.0;  // if it is so soon
};

struct Debrief {
  std::string exercise, goal, briefing, server;
  std::string chart;  // on which it is drawn; left to the caller
  std::vector<std::string> answers;
  UtcTime began{};
  Moment end;
  bool incomplete = false;             // inputs are missing at the end
  std::optional<std::string> differs;  // the world refused an input: not what was sailed
  DebriefLimits limits;
  std::vector<ShipTrack> own_ships, targets;  // targets: those that came near
  std::vector<ShipPassing> passings;          // nearest first
  std::vector<Contact> contacts;
  std::vector<Moment> contact_moments;  // of each of them
  std::vector<HappenedLine> happened;
  std::vector<Reaction> reactions;
  std::vector<JudgedCheck> checks;
  std::vector<KnownView> known;
  std::vector<Deed> deeds;
  std::size_t deeds_left_out = 0;  // beyond what is kept
  bool has_one_clock = true;       // the exercise's clock is that on the air
};

}  // namespace skerry::server
