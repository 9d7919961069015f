// RMB, BWC and BOD: the way to the next waypoint.
// As in track_sentences.hpp, bearings are true and distances in nautical miles.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

struct Rmb {
  bool valid = true;
  std::optional<double> off_track_nm = {};  // as in Xte; written as 9.99 at most
  std::string origin = {};                  // names of waypoints
  std::string destination = {};
  std::optional<GeoPoint> position = {};   // of the destination
  std::optional<double> range_nm = {};     // to it; written as 999.9 at most
  std::optional<double> bearing_deg = {};  // of it, [0, 360]
  std::optional<double> closing_kn = {};   // towards it, within 999.9
  bool arrived = false;                    // arrival circle entered or perpendicular passed
  char mode = 'A';                         // as in Rmc; what is written is valid for A and D only
};
std::string encode(const Rmb& rmb, std::string_view talker = "GP");
Result<Rmb, WireError> decode_rmb(const Sentence& sentence);

// Along the great circle.
struct Bwc {
  std::optional<Duration> time_of_day = {};
  std::optional<GeoPoint> position = {};   // of the waypoint
  std::optional<double> bearing_deg = {};  // [0, 360]
  std::optional<double> range_nm = {};     // 0 .. 99999.999
  std::string waypoint = {};
  char mode = 'A';
};
std::string encode(const Bwc& bwc, std::string_view talker = "GP");
Result<Bwc, WireError> decode_bwc(const Sentence& sentence);

struct Bod {
  std::optional<double> bearing_deg = {};  // from origin to destination, [0, 360]
  std::string destination = {};
  std::string origin = {};
};
std::string encode(const Bod& bod, std::string_view talker = "GP");
Result<Bod, WireError> decode_bod(const Sentence& sentence);

}  // namespace skerry::nmea
