// TTD: many tracked targets in few sentences, as six-bit payload.
// Source: IEC 61162-1:2010 8.3.88 as recalled: the standard could not be read and no free decoder
// of the payload was found, so the layout below has no independent reader to hold it.
//   2 protocol version 0 | 10 target number | 12 true bearing 0.1 deg | 12 speed 0.1 kn |
//   12 course 0.1 deg | 12 AIS heading 0.1 deg | 3 status | 1 test target | 14 distance 0.01 NM |
//   1 relative speed | 1 through the water | 2 reserved | 8 correlation: 90 bits, 15 characters.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

inline constexpr std::size_t kTtdTargetsPerSentence = 4;

enum class TtdStatus : std::uint8_t {
  not_tracking = 0,
  acquiring = 1,
  lost = 2,
  tracking = 4,            // no alarm
  tracking_alarm = 6,      // CPA and TCPA below their limits
  tracking_confirmed = 7,  // the same, acknowledged
};

// A value that is absent or out of range is sent as not available.
struct TtdTarget {
  unsigned number = 0;                     // 1 .. 1023
  std::optional<double> bearing_deg = {};  // true
  std::optional<double> speed_kn = {};     // over ground, below 409.4
  std::optional<double> course_deg = {};   // true
  std::optional<double> heading_deg = {};  // true, as AIS has it
  std::optional<double> range_nm = {};     // below 163.83
  TtdStatus status = TtdStatus::tracking;
};

// Returns as many sentences as needed, with one sequential identifier, 0 .. 9.  At most 1020
// targets.
std::vector<std::string> encode_ttd(std::span<const TtdTarget> targets, unsigned identifier,
                                    std::string_view talker = "RA");
// The targets of one sentence.
Result<std::vector<TtdTarget>, WireError> decode_ttd(const Sentence& sentence);

}  // namespace skerry::nmea
