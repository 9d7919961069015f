// ASTERIX category 010 (monosensor surface movement data): plots and tracks of a shore radar.
// Source: EUROCONTROL-SPEC-0149-7, edition 1.1.  The standard was not at hand: items, bits and
// units are those of the transcriptions asterix-specs (cat-1.1.ast) and CroatiaControlLtd/asterix,
// and of Wireshark, which reads ours (track_reports_tshark_test).  In items 202 and 210
// asterix-specs has a unit of 1/16 beside a range of 1/4; here it is 1/4, as the other has it.
// SPEC.md "Plots and tracks" says which items are sent.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/asterix/report_parts.hpp"
#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry {

// Item 000.
enum class Cat010Kind : std::uint8_t {
  target = 1,
  turn = 2,  // an update cycle begins
  periodic_status = 3,
  event_status = 4,
};

// TYP of item 020.
enum class Cat010Sensor : std::uint8_t {
  secondary_multilateration = 0,
  mode_s_multilateration = 1,
  ads_b = 2,
  primary_radar = 3,
  magnetic_loop = 4,
  hf_multilateration = 5,
  undefined = 6,
  other = 7,
};

// CST of item 170.
enum class Cat010Extrapolation : std::uint8_t {
  none = 0,
  not_scanned = 1,  // foreseen: the sensor has not been there
  masked = 2,       // foreseen: it cannot see there
  missed = 3,       // unforeseen
};

struct Cat010TrackStatus {
  bool is_tentative = false;  // CNF
  bool is_ended = false;      // TRE: the last report of the track
  Cat010Extrapolation extrapolation = Cat010Extrapolation::none;
  bool is_manoeuvring = false;  // MAH
  bool is_smoothed = true;      // STH: the position; otherwise it is as measured
  bool is_ghost = false;        // GHO
  friend bool operator==(const Cat010TrackStatus&, const Cat010TrackStatus&) = default;
};

// Item 550.
struct Cat010SystemStatus {
  std::uint8_t release =
      0;  // 0 works, 1 degraded, 2 not to be used, 3 undefined; more is sent as 3
  bool is_overloaded = false;
  bool is_time_invalid = false;
  friend bool operator==(const Cat010SystemStatus&, const Cat010SystemStatus&) = default;
};

// Standard deviations, each sent as the nearest that there is.
struct Cat010Deviation {
  double east_m = 0.0;        // 0.25 m, up to 63.75
  double north_m = 0.0;       // the same
  double covariance_m = 0.0;  // 0.25 m
  friend bool operator==(const Cat010Deviation&, const Cat010Deviation&) = default;
};

// A message that is no target report has no items but 010, 000, 140 and 550; a target report has no
// 550.  What such a report has beside is not sent.
struct Cat010Report {
  AsterixSource source = {};                             // 010
  Cat010Kind kind = Cat010Kind::target;                  // 000
  Cat010Sensor sensor = Cat010Sensor::primary_radar;     // 020
  bool is_simulated = false;                             // 020 SIM
  bool is_test = false;                                  // 020 TST
  std::optional<Duration> time_of_day = {};              // 140, 1/128 s, truncated; it is wanted
  std::optional<GeoPoint> place = {};                    // 041: 180/2^31 deg, 9 mm
  std::optional<AsterixPolar> measured = {};             // 040: 1 m, to 65,535; 360/65536 deg
  std::optional<PlanePoint> position = {};               // 042: 1 m, -32,768 to 32,767
  std::optional<AsterixVelocity> velocity = {};          // 200: 2^-14 NM/s, below 7408 m/s
  std::optional<AsterixVector> plane_velocity = {};      // 202: 0.25 m/s, -8192 to below 8192
  std::optional<unsigned> track_number = {};             // 161: 0 to 4095
  std::optional<Cat010TrackStatus> status = {};          // 170
  std::optional<AsterixSize> size = {};                  // 270
  std::optional<Cat010SystemStatus> system_status = {};  // 550
  std::optional<Cat010Deviation> deviation = {};         // 500
  std::optional<std::uint8_t> amplitude = {};            // 131: 0 is the least that is detected
  // 210: 0.25 m/s2; what is beyond -32 to 31.75 is sent as the nearest of these.
  std::optional<AsterixVector> acceleration = {};
  friend bool operator==(const Cat010Report&, const Cat010Report&) = default;
};

// As encode_cat048() and decode_cat048(); items 010 and 000 are needed.
std::vector<Bytes> encode_cat010(std::span<const Cat010Report> reports,
                                 std::size_t most = kAsterixDatagram);
Result<std::vector<Cat010Report>, WireError> decode_cat010(std::span<const std::uint8_t> datagram);

}  // namespace skerry
