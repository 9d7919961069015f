// HTC, HTD and HSC: what a heading or track controller is told to do, and what it does.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// The letters are those of the field.
enum class SelectedSteering : char {
  main = 'M',         // by hand: the main steering system
  stand_alone = 'S',  // a controller that keeps its own heading, and takes none from outside
  heading = 'H',      // a controller that keeps the heading it is told
  track = 'T',        // a controller that keeps the track it is told
  rudder = 'R',       // the rudder goes where it is told
};
enum class TurnMode : char {
  radius = 'R',  // a turn of the radius it is told
  rate = 'T',    // of the rate
  free = 'N',    // as the ship turns
};

// The fields that HTC and HTD have in common.
struct SteeringFields {
  // Steering is for now by other means, as if by hand; `steering` and `turn` do not count.
  bool is_overridden = false;
  std::optional<double> rudder_deg = {};  // within 90, to starboard positive
  std::optional<SelectedSteering> steering = {};
  std::optional<TurnMode> turn = {};
  std::optional<double> rudder_limit_deg = {};       // 0 .. 90
  std::optional<double> off_heading_limit_deg = {};  // 0 .. 180
  std::optional<double> turn_radius_nm = {};         // 0 .. 99.999
  std::optional<double> turn_rate_deg_min = {};      // 0 .. 999.9
  std::optional<double> heading_deg = {};            // to steer, [0, 360]
  std::optional<double> off_track_limit_nm = {};     // 0 .. 99.999
  std::optional<double> track_deg = {};              // [0, 360]
  char reference = 'T';  // of all headings and tracks: T true, M magnetic, '\0' not said
};

struct Htc {
  SteeringFields fields = {};
  bool is_command = true;  // otherwise it reports what is set
};
std::string encode(const Htc& htc, std::string_view talker = "AG");
Result<Htc, WireError> decode_htc(const Sentence& sentence);

struct Htd {
  SteeringFields fields = {};
  // False: the limit is reached or exceeded.
  std::optional<bool> rudder_within_limit = {};
  std::optional<bool> heading_within_limit = {};
  std::optional<bool> track_within_limit = {};
  std::optional<double> ship_heading_deg = {};  // [0, 360]
};
std::string encode(const Htd& htd, std::string_view talker = "AG");
Result<Htd, WireError> decode_htd(const Sentence& sentence);

// A heading to steer.
struct Hsc {
  std::optional<double> true_deg = {};      // [0, 360]
  std::optional<double> magnetic_deg = {};  // [0, 360]
  bool is_command = true;                   // otherwise it reports what is set
};
std::string encode(const Hsc& hsc, std::string_view talker = "AG");
Result<Hsc, WireError> decode_hsc(const Sentence& sentence);

}  // namespace skerry::nmea
