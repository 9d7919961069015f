// ASTERIX category 062 (system tracks): what a plotter makes of one or several sensors.
// Source: EUROCONTROL-SPEC-0149-9, edition 1.19.  The standard was not at hand: items, bits and
// units are those of the transcription asterix-specs (cat-1.19.ast), and of Wireshark, which reads
// ours (track_reports_tshark_test).  SPEC.md "Plots and tracks" says which items are sent.
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

struct Cat062TrackStatus {
  bool is_monosensor = true;    // MON
  bool is_tentative = false;    // CNF
  bool is_simulated = false;    // SIM
  bool is_ended = false;        // TSE: the last report of the track
  bool is_new = false;          // TSB: the first
  bool is_amalgamated = false;  // AMA
  bool is_coasting = false;     // CST: not updated for longer than usual
  friend bool operator==(const Cat062TrackStatus&, const Cat062TrackStatus&) = default;
};

// TRANS and LONG of item 200.
enum class Cat062Turn : std::uint8_t { none = 0, right = 1, left = 2, undetermined = 3 };
enum class Cat062SpeedChange : std::uint8_t { none = 0, faster = 1, slower = 2, undetermined = 3 };

struct Cat062Movement {
  Cat062Turn turn = Cat062Turn::none;
  Cat062SpeedChange speed = Cat062SpeedChange::none;
  friend bool operator==(const Cat062Movement&, const Cat062Movement&) = default;
};

struct Cat062Report {
  AsterixSource source = {};                   // 010
  std::optional<std::uint8_t> service = {};    // 015
  std::optional<Duration> time_of_day = {};    // 070, 1/128 s, truncated; the edition wants it
  std::optional<GeoPoint> place = {};          // 105: 180/2^25 deg, 0.6 m
  std::optional<PlanePoint> position = {};     // 100: 0.5 m, within 4194 km of the system's centre
  std::optional<AsterixVector> velocity = {};  // 185: 0.25 m/s, -8192 to below 8192
  // 210: 0.25 m/s2; what is beyond -32 to 31.75 is sent as the nearest of these.
  std::optional<AsterixVector> acceleration = {};
  std::uint16_t track_number = 0;  // 040
  Cat062TrackStatus status = {};   // 080
  // 290: 0.25 s; what is older than 63.75 s is sent as that.
  std::optional<double> track_age_s = {};       // TRK: since the track began
  std::optional<double> primary_age_s = {};     // PSR: since the last plot
  std::optional<Cat062Movement> movement = {};  // 200
  std::optional<AsterixSize> size = {};         // 270
  // 500, standard deviations, each sent as the nearest that there is.
  std::optional<AsterixVector> position_deviation = {};  // APC: 0.5 m, up to 32,767.5
  // COV: 0.5 m; the root of the covariance of east and north, with its sign.
  std::optional<double> position_covariance_m = {};
  std::optional<AsterixVector> velocity_deviation = {};  // ATV: 0.25 m/s, up to 63.75
  friend bool operator==(const Cat062Report&, const Cat062Report&) = default;
};

// As encode_cat048() and decode_cat048(); items 010, 040 and 080 are needed.
std::vector<Bytes> encode_cat062(std::span<const Cat062Report> reports,
                                 std::size_t most = kAsterixDatagram);
Result<std::vector<Cat062Report>, WireError> decode_cat062(std::span<const std::uint8_t> datagram);

}  // namespace skerry
