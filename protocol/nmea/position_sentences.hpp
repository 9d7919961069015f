// RMC, GGA, GLL, VTG and ZDA: position, course and speed over ground, and time.
// Source: IEC 61162-1:2010 clause 8; nmea/README.md "Sources".  The date of RMC is ddmmyy.
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

inline constexpr double kMostSpeedKn = 1000.0;
inline constexpr double kKmhPerKnot = 1.852;

// How a position was come by: 'A' autonomous, 'D' differential, 'E' estimated, 'M' by hand, 'S'
// simulated, 'N' none.
struct Rmc {
  std::optional<UtcTime> utc = {};  // whole only if the date is there; years 1980 .. 2079
  std::optional<GeoPoint> position = {};
  std::optional<double> speed_kn = {};    // over ground, 0 .. kMostSpeedKn
  std::optional<double> course_deg = {};  // over ground, true, [0, 360]
  char mode = 'A';
  bool valid = true;  // status A; what is written is A for the modes A and D and V for all others
};
std::string encode(const Rmc& rmc, std::string_view talker = "GP");
Result<Rmc, WireError> decode_rmc(const Sentence& sentence);

struct Gga {
  std::optional<Duration> time_of_day = {};
  std::optional<GeoPoint> position = {};
  unsigned quality = 1;  // 0 none, 1 GPS, 2 differential, .. 8 simulated
  unsigned satellites = 12;
  double dilution = 0.8;    // of precision, horizontal; 0 .. 99.9
  double altitude_m = 0.0;  // above mean sea level; -9999.9 .. 99999.9
};
std::string encode(const Gga& gga, std::string_view talker = "GP");
Result<Gga, WireError> decode_gga(const Sentence& sentence);

struct Gll {
  std::optional<GeoPoint> position = {};
  std::optional<Duration> time_of_day = {};
  char mode = 'A';
  bool valid = true;  // as in Rmc
};
std::string encode(const Gll& gll, std::string_view talker = "GP");
Result<Gll, WireError> decode_gll(const Sentence& sentence);

struct Vtg {
  std::optional<double> course_deg = {};  // over ground, true
  std::optional<double> speed_kn = {};    // over ground
  char mode = 'A';
};
std::string encode(const Vtg& vtg, std::string_view talker = "GP");
Result<Vtg, WireError> decode_vtg(const Sentence& sentence);

struct Zda {
  std::optional<UtcTime> utc = {};
};
std::string encode(const Zda& zda, std::string_view talker = "GP");
Result<Zda, WireError> decode_zda(const Sentence& sentence);

// Since midnight.
Duration time_of_day(UtcTime utc);

}  // namespace skerry::nmea
