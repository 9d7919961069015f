// MWV and MWD: the wind over the bow and over the compass.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

enum class WindReference : char {
  relative = 'R',     // as it is felt on board
  theoretical = 'T',  // as it would be felt if the ship lay still
};

// Whence the wind comes, from the bow clockwise, [0, 360], with either reference.  Written in
// knots; read also in km/h (K), m/s (M) and statute miles an hour (S).  Not valid: both absent.
struct Mwv {
  std::optional<double> angle_deg = {};
  WindReference reference = WindReference::relative;
  std::optional<double> speed_kn = {};  // 0 .. 400
};
std::string encode(const Mwv& mwv, std::string_view talker = "WI");
Result<Mwv, WireError> decode_mwv(const Sentence& sentence);

// Whence the true wind comes, from true north clockwise.  Written in knots and m/s.
struct Mwd {
  std::optional<double> from_deg = {};  // [0, 360]
  std::optional<double> speed_kn = {};  // 0 .. 400
};
std::string encode(const Mwd& mwd, std::string_view talker = "WI");
Result<Mwd, WireError> decode_mwd(const Sentence& sentence);

}  // namespace skerry::nmea
