// GNS and DTM: a position from several satellite systems, and the datum of positions.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

struct Gns {
  std::optional<Duration> time_of_day = {};
  std::optional<GeoPoint> position = {};
  // One letter for each system, GPS first, at most 6: those of Rmc, and F float, P precise, R
  // real-time kinematic.
  std::string modes = "A";
  unsigned satellites = 12;               // 0 .. 99
  std::optional<double> dilution = {};    // of precision, horizontal; 0 .. 99.9
  std::optional<double> altitude_m = {};  // above mean sea level; -999.9 .. 99999.9
  std::optional<double> geoid_m = {};     // mean sea level above the ellipsoid; within 999.9
  char navigation_status = 'V';           // S safe, C caution, U unsafe, V not said
};
std::string encode(const Gns& gns, std::string_view talker = "GN");
Result<Gns, WireError> decode_gns(const Sentence& sentence);

// Positions of the talker are of `local`; adding the offsets to one of `reference` gives it.
// "W84" is WGS-84, "999" the user's own.
struct Dtm {
  std::string local = "W84";  // at most 3 characters
  char subdivision = '\0';
  std::optional<double> north_min = 0.0;  // minutes of arc, within 59.9999; south negative
  std::optional<double> east_min = 0.0;   // west negative
  std::optional<double> up_m = 0.0;       // within 9999.9
  std::string reference = "W84";
};
std::string encode(const Dtm& dtm, std::string_view talker = "GP");
Result<Dtm, WireError> decode_dtm(const Sentence& sentence);

}  // namespace skerry::nmea
