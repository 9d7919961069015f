// WorldState: where everything is and how it moves, at one instant.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/exercise.pb.h"
#include "server/world/environment.hpp"
#include "server/world/handling/helmsman.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/sensors/fault_state.hpp"

namespace skerry::server {

using RadarSetPtr = std::shared_ptr<const echo::RadarSet>;

// An own ship that has a class, as her con shows her.  Angles in degrees.
struct ConState {
  const ShipClass* ship_class = nullptr;  // never null
  SteeringMode steering = SteeringMode::hand;
  BodyMotion motion;  // through the water
  double rudder_deg = 0.0, rudder_order_deg = 0.0;
  double shaft_rps = 0.0;
  double engine_percent = 0.0;  // as ordered
  bool keeps_speed = false;
  double bow_percent = 0.0, stern_percent = 0.0;
  double heading_order_deg = 0.0, turn_rate_deg_min = 0.0;
  double depth_below_keel_m = 0.0;
  double wind_from_deg = 0.0, wind_mps = 0.0;
  double current_set_deg = 0.0, current_mps = 0.0;
  std::uint32_t waypoint = 0, waypoints = 0;  // makes for, from 1; 0: none
  double waypoint_m = 0.0, cross_track_m = 0.0;
};

// Motion is straight or a steady turn from `time` of the WorldState on: good for one tick.
struct ShipState {
  std::string name;
  GeoPoint position;
  double heading_deg = 0.0;             // true, [0, 360)
  double course_over_ground_deg = 0.0;  // true, [0, 360)
  double speed_mps = 0.0;               // over ground, along the course; astern negative
  double rate_of_turn_deg_s = 0.0;      // starboard positive
  double ordered_course_deg = 0.0;
  double ordered_speed_mps = 0.0;
  double length_m = 0.0;
  double beam_m = 0.0;
  double height_m = 0.0;          // of the echoing hull and superstructure above the water
  double cross_section_m2 = 0.0;  // median at X band, bow aspect; 0: from her size
  bool wake = false;
  bool driven = false;   // an own ship whose motion comes from outside
  bool aground = false;  // an own ship: she lies still until she is put elsewhere
  bool sart = false;     // carries one that is on
  std::uint32_t mmsi = 0;
  // Faults of a target's AIS: it is silent, adds to the heading, tells a place so far ahead.
  bool ais_off = false;
  double ais_heading_error_deg = 0.0;
  double ais_position_error_m = 0.0;
  std::size_t number = 0;            // in the scenario's list of own ships or targets
  RadarSetPtr radar = nullptr;       // of a target that has one on, else null
  std::optional<ConState> con = {};  // of an own ship that has a class
  // Seconds of the exercise a second on the air: 0 while it is frozen.  Speeds and rates of turn
  // are those of the exercise.
  double pace = 1.0;
  std::shared_ptr<const FaultState> faults = nullptr;  // of an own ship that has any, else null
};

// A target other than a ship: smaller than a radar can resolve.
struct SmallTargetState {
  std::size_t number = 0;  // in the scenario's list of targets
  GeoPoint position;
  double course_over_ground_deg = 0.0;  // true
  double speed_mps = 0.0;
  double pace = 1.0;  // as ShipState has it
};

struct SartState {
  GeoPoint position;
  double course_over_ground_deg = 0.0;  // true
  double speed_mps = 0.0;
  double height_m = 1.0;
  double pace = 1.0;
};

// A rain cell where it is now.
struct RainState {
  const RainCloud* cloud;  // of the state's environment
  GeoPoint centre;
};

// An own ship that touched another ship, or the ground.
struct Contact {
  enum class Kind { collision, grounding };
  Kind kind = Kind::collision;
  Duration when{};  // on the exercise's clock
  std::size_t own_ship = 0;
  bool other_own = false;  // of a collision: the other is an own ship
  std::size_t other = 0;   // her number in its list
  std::string own_name, other_name;
  GeoPoint position;          // of the own ship's middle
  double relative_mps = 0.0;  // of a collision: of one seen from the other; else over ground
  std::string why;            // of a grounding: "the shore", "5 m of water, draught 6.5 m"
};

// What has happened in an exercise beside the motion of ships.  Copied when it changes.
struct ExerciseLog {
  static constexpr std::size_t kMaxMarks = 1000;  // the oldest go
  struct Text {
    std::string text;
    std::uint64_t count = 0;  // of texts so far
  };
  std::vector<wire::ExerciseMark> marks;
  std::vector<Contact> contacts;       // as many at most
  std::vector<Text> texts;             // to the con of each own ship
  std::vector<std::string> snapshots;  // names, oldest first
  std::string can_undo;                // empty: nothing
  std::string last_by, last_order;
  std::uint64_t orders = 0;
};

struct WorldState {
  ScenarioTime time{};  // on the air
  Duration exercise{};  // on the exercise's clock
  double pace = 1.0;    // of that clock, as ShipState has it
  bool frozen = false;
  double rate = 1.0;                       // its pace when it is not frozen
  std::shared_ptr<const ExerciseLog> log;  // never null
  std::vector<ShipState> own_ships;
  std::vector<ShipState> targets;  // the ships among them
  double water_level_m = 0.0;      // over the charted coastline, -17 to 15

  EnvironmentPtr environment;  // never null
  std::vector<RainState> rain;
  std::vector<SmallTargetState> adrift;  // small targets that make way
  std::vector<SartState> sarts;          // not those that ships carry
  std::size_t scripted_targets = 0;      // those that the scenario had; the others were added
  // The source of everything that neither moves nor changes: small targets without way, turbines,
  // cables, racons.  Never null.
  std::shared_ptr<const scenario::Scenario> scenario;
};
using WorldStatePtr = std::shared_ptr<const WorldState>;

}  // namespace skerry::server
