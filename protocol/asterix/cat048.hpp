// ASTERIX category 048 (monoradar target reports): plots and tracks of one radar.
// Source: EUROCONTROL-SPEC-0149-4, edition 1.31.  The standard was not at hand: items, bits and
// units are those of the transcription asterix-specs (cat-1.31.ast), and of Wireshark, which reads
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

// What detected the target in this turn: TYP of item 020.
enum class Cat048Detection : std::uint8_t {
  none = 0,  // the position is extrapolated
  primary = 1,
  secondary = 2,
  both = 3,
  all_call = 4,
  roll_call = 5,
  all_call_and_primary = 6,
  roll_call_and_primary = 7,
};

// RAD of item 170.
enum class Cat048Sensors : std::uint8_t { combined = 0, primary = 1, secondary = 2, invalid = 3 };

struct Cat048TrackStatus {
  bool is_tentative = false;  // CNF
  Cat048Sensors sensors = Cat048Sensors::primary;
  bool is_doubtful = false;     // DOU: whether the plot is that of the track
  bool is_manoeuvring = false;  // MAH
  bool is_ended = false;        // TRE: the last report of the track
  bool is_ghost = false;        // GHO
  friend bool operator==(const Cat048TrackStatus&, const Cat048TrackStatus&) = default;
};

// Standard deviations, each sent as the nearest that there is.
struct Cat048Quality {
  double east_m = 0.0;      // 1/128 NM, up to 1.99 NM
  double north_m = 0.0;     // the same
  double speed_mps = 0.0;   // 2^-14 NM/s, up to 28.8 m/s
  double course_deg = 0.0;  // 360/4096 deg, up to 22.4
  friend bool operator==(const Cat048Quality&, const Cat048Quality&) = default;
};

// A plot, or a track if it has a number.
struct Cat048Report {
  AsterixSource source = {};                             // 010
  std::optional<Duration> time_of_day = {};              // 140, 1/128 s, truncated
  Cat048Detection detection = Cat048Detection::primary;  // 020
  bool is_simulated = false;                             // 020 SIM
  bool is_test = false;                                  // 020 TST
  std::optional<AsterixPolar> measured = {};  // 040: 1/256 NM, below 256 NM; 360/65536 deg
  // 130: each sent as the nearest that there is.
  std::optional<double> run_length_deg = {};  // PRL: 360/8192 deg, up to 11.2: the plot's width
  std::optional<double> amplitude_dbm = {};   // PAM: 1 dBm, -128 to 127
  std::optional<unsigned> track_number = {};  // 161: 0 to 4095
  std::optional<PlanePoint> position = {};    // 042, from the radar: 1/128 NM, -256 NM to below 256
  std::optional<AsterixVelocity> velocity = {};  // 200: 2^-14 NM/s, below 7408 m/s; 360/65536 deg
  std::optional<Cat048TrackStatus> status = {};  // 170
  std::optional<Cat048Quality> quality = {};     // 210
  friend bool operator==(const Cat048Report&, const Cat048Report&) = default;
};

// Datagrams of one data block each, of `most` octets at most; a record alone may be longer.  Error:
// half a unit of each value.
std::vector<Bytes> encode_cat048(std::span<const Cat048Report> reports,
                                 std::size_t most = kAsterixDatagram);

// Reads all records of one datagram.  Items that the report does not have, and blocks of other
// categories, are passed over.
// Error: truncated, oversized (above 65,535 bytes), malformed (a wrong length, no item 010),
// out_of_range or unknown_kind, with the byte offset; nothing is believed of a datagram that lies
// about a length.  The result is at most a fixed multiple of the datagram's length.  Thread: any.
Result<std::vector<Cat048Report>, WireError> decode_cat048(std::span<const std::uint8_t> datagram);

}  // namespace skerry
