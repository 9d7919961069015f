// VLW and VDR: distance run, and the current that a log and a position make.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// Nautical miles, 0 .. 999999.999.
struct Vlw {
  std::optional<double> water_total_nm = {};
  std::optional<double> water_trip_nm = {};  // since it was reset
  std::optional<double> ground_total_nm = {};
  std::optional<double> ground_trip_nm = {};
};
std::string encode(const Vlw& vlw, std::string_view talker = "VD");
Result<Vlw, WireError> decode_vlw(const Sentence& sentence);

struct Vdr {
  std::optional<double> set_deg = {};   // whither the current sets, true, [0, 360]
  std::optional<double> drift_kn = {};  // how fast, 0 .. 100
};
std::string encode(const Vdr& vdr, std::string_view talker = "II");
Result<Vdr, WireError> decode_vdr(const Sentence& sentence);

}  // namespace skerry::nmea
