// XTE and APB: how far a ship is off her track, and what a track pilot needs to know.
// All bearings are written as true.  A bearing that is magnetic, or a distance in other units than
// nautical miles, is read as absent.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// Characters of a waypoint's name that are written, if there is room for them.
inline constexpr std::size_t kMostWaypointName = 15;

struct Xte {
  bool valid = true;                        // both status fields
  std::optional<double> off_track_nm = {};  // the ship is so far to starboard of it; within 99.999
  char mode = 'A';                          // as in Rmc
};
std::string encode(const Xte& xte, std::string_view talker = "II");
Result<Xte, WireError> decode_xte(const Sentence& sentence);

struct Apb {
  bool valid = true;                        // both status fields
  std::optional<double> off_track_nm = {};  // as in Xte
  bool arrival_circle_entered = false;
  bool perpendicular_passed = false;
  std::optional<double> track_deg = {};    // from the last waypoint to the next, [0, 360]
  std::string waypoint = {};               // the next
  std::optional<double> bearing_deg = {};  // of the next waypoint from the ship
  std::optional<double> heading_deg = {};  // to steer
  char mode = 'A';
};
std::string encode(const Apb& apb, std::string_view talker = "II");
Result<Apb, WireError> decode_apb(const Sentence& sentence);

}  // namespace skerry::nmea
