// RSA and ROR: the rudder's angle, and the order it was given.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/demand_fields.hpp"

namespace skerry::nmea {

// Degrees, within 180; positive turns the bow to starboard.  A ship with one rudder says it as the
// starboard one.  The standard gives no unit and lets a sensor be off by a factor; degrees are what
// equipment sends.  What is not valid is absent.
struct Rsa {
  std::optional<double> starboard_deg = {};
  std::optional<double> port_deg = {};
};
std::string encode(const Rsa& rsa, std::string_view talker = "AG");
Result<Rsa, WireError> decode_rsa(const Sentence& sentence);

// Degrees, within 90; positive turns the bow to starboard.  As in Rsa.
struct Ror {
  std::optional<double> starboard_deg = {};
  std::optional<double> port_deg = {};
  std::optional<CommandPlace> place = CommandPlace::bridge;
};
std::string encode(const Ror& ror, std::string_view talker = "RC");
Result<Ror, WireError> decode_ror(const Sentence& sentence);

}  // namespace skerry::nmea
