// ConCommand: what a bridge or an autopilot outside tells the ship to do.
// Source: nmea/README.md "Sentences of the con", which also says how each field is understood.
#pragma once

#include <optional>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

enum class SteeringMode : unsigned char { hand, heading, track };

// What is absent stays as it is.
struct ConCommand {
  std::optional<SteeringMode> mode = {};
  std::optional<double> rudder_deg = {};        // order, within 90, to starboard positive
  std::optional<double> rudder_limit_deg = {};  // of a controller, 0 .. 90
  std::optional<double> heading_deg = {};       // to steer, true, [0, 360)
  std::optional<double> track_deg = {};         // true, [0, 360)
  std::optional<double> turn_radius_nm = {};    // of a controlled turn, 0 .. 99.999; one of the two
  std::optional<double> turn_rate_deg_min = {};  // 0 .. 999.9
  // Of one engine.
  std::optional<unsigned> shaft = {};        // 0 single or on the centre line, odd to starboard
  std::optional<double> lever_percent = {};  // within 100, astern negative
  std::optional<double> revolutions = {};    // demanded of the shaft a minute, astern negative
  std::optional<double> pitch_percent = {};  // demanded of the propeller, within 100
  // Within 100, pushing the ship to starboard positive.
  std::optional<double> bow_thruster_percent = {};
  std::optional<double> stern_thruster_percent = {};

  friend bool operator==(const ConCommand&, const ConCommand&) = default;
};

bool says_something(const ConCommand& command);

// Of HTC, HSC, ROR, PRC, ETL and TRC.  Any other sentence, a report, and an answer command nothing.
// Error: also an order that cannot be obeyed, such as a magnetic heading.
Result<ConCommand, WireError> decode_con_command(const Sentence& sentence);

}  // namespace skerry::nmea
