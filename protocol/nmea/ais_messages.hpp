// AIS messages 1 (2, 3), 5, 18, 19, 21 and 24 as bits.
// Source: ITU-R M.1371-5 annex 8.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <variant>

#include "protocol/nmea/six_bit.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::nmea {

// From the reference point of reported positions, whole metres: bow and stern up to 511, sides up
// to 63; longer is said as that.
struct AisSize {
  unsigned to_bow_m = 0;
  unsigned to_stern_m = 0;
  unsigned to_port_m = 0;
  unsigned to_starboard_m = 0;
  friend bool operator==(const AisSize&, const AisSize&) = default;
};
// The reference point amidships.  Lengths are rounded up: the ship is not smaller than she says.
AisSize ais_size(double length_m, double beam_m);

// Message 1, 2 or 3 (class A), or 18 (class B), which has neither status nor rate of turn.
struct AisPosition {
  std::uint32_t mmsi = 0;
  bool class_b = false;
  unsigned status = 15;                             // 0 under way, 1 at anchor, .. 15 not defined
  std::optional<double> rate_of_turn_deg_min = {};  // starboard positive; from a sensor
  std::optional<double> speed_kn = {};              // over ground; from 102.2 on said as that
  std::optional<GeoPoint> position = {};            // 1e-4 minute
  std::optional<double> course_deg = {};            // over ground, 0.1 deg
  std::optional<double> heading_deg = {};           // true, whole degrees
  unsigned utc_second = 60;                         // 0 .. 59; 60: not known
};

// Message 5.
struct AisVoyage {
  std::uint32_t mmsi = 0;
  std::uint32_t imo = 0;
  std::string call_sign = {};  // 7 characters
  std::string name = {};       // 20
  unsigned ship_type = 0;
  AisSize size = {};
  double draught_m = 0.0;        // 0: not known
  std::string destination = {};  // 20
};

// Message 24, part A (the name) or B (all else).
struct AisStatic {
  std::uint32_t mmsi = 0;
  bool part_b = false;
  std::string name = {};  // 20
  unsigned ship_type = 0;
  std::string call_sign = {};  // 7
  AisSize size = {};
};

// Message 19: what 18 and 24 say, in one.
struct AisExtended {
  AisPosition position = {.class_b = true};
  std::string name = {};  // 20
  unsigned ship_type = 0;
  AisSize size = {};
};

// Message 21.
struct AisAid {
  std::uint32_t mmsi = 0;
  unsigned type = 0;      // 0 .. 31
  std::string name = {};  // 34: 20 and an extension of 14
  std::optional<GeoPoint> position = {};
  AisSize size = {};
  unsigned utc_second = 60;
  bool off_position = false;
  bool is_virtual = false;
};

using AisMessage = std::variant<AisPosition, AisVoyage, AisStatic, AisAid, AisExtended>;

SixBitWriter encode(const AisMessage& message);
// Error, without a place: unknown_kind of other messages, truncated if too short for its kind.
Result<AisMessage, WireError> decode_ais(SixBitReader bits);

}  // namespace skerry::nmea
