// HDT, THS, HDG, ROT, VHW and VBW: heading, rate of turn and the log.
// Source: IEC 61162-1:2010 clause 8; Furuno GP-170 manual AP-15 (THS, VBW).
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// True, [0, 360].
struct Hdt {
  std::optional<double> heading_deg = {};
};
std::string encode(const Hdt& hdt, std::string_view talker = "HE");
Result<Hdt, WireError> decode_hdt(const Sentence& sentence);

struct Ths {
  std::optional<double> heading_deg = {};
  char mode = 'A';  // A autonomous, E estimated, M by hand, S simulated, V not valid
};
std::string encode(const Ths& ths, std::string_view talker = "HE");
Result<Ths, WireError> decode_ths(const Sentence& sentence);

// A magnetic compass.  True heading is the sum of the three.
struct Hdg {
  std::optional<double> sensor_deg = {};     // [0, 360]
  std::optional<double> deviation_deg = {};  // east positive, within 180
  std::optional<double> variation_deg = {};  // east positive, within 180
};
std::string encode(const Hdg& hdg, std::string_view talker = "HC");
Result<Hdg, WireError> decode_hdg(const Sentence& sentence);

struct Rot {
  std::optional<double> rate_deg_min = {};  // starboard positive, within 10000
  bool valid = true;
};
std::string encode(const Rot& rot, std::string_view talker = "TI");
Result<Rot, WireError> decode_rot(const Sentence& sentence);

struct Vhw {
  std::optional<double> heading_deg = {};  // true
  std::optional<double> speed_kn = {};  // through the water; some equipment says astern as negative
};
std::string encode(const Vhw& vhw, std::string_view talker = "VW");
Result<Vhw, WireError> decode_vhw(const Sentence& sentence);

// Ahead and to starboard positive, within kMostSpeedKn.  What is not valid is absent.
struct Vbw {
  std::optional<double> water_ahead_kn = {};
  std::optional<double> water_starboard_kn = {};
  std::optional<double> ground_ahead_kn = {};
  std::optional<double> ground_starboard_kn = {};
  std::optional<double> water_stern_starboard_kn = {};  // at the stern
  std::optional<double> ground_stern_starboard_kn = {};
};
std::string encode(const Vbw& vbw, std::string_view talker = "VD");
Result<Vbw, WireError> decode_vbw(const Sentence& sentence);

}  // namespace skerry::nmea
