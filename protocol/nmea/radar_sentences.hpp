// RSD, OSD, TTM and TLL: what a radar says of itself and of the targets it tracks.
// Source: IEC 61162-1:2010 clause 8; Furuno FAR-28x7 manual AP-25 and FAR-21x9 (fields of RSD, OSD,
// TTM); nmea/README.md "Sources".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// Range rings, markers and cursor are the display's, and left empty by who has none.
struct Rsd {
  std::optional<double> cursor_range_nm = {};
  std::optional<double> cursor_bearing_deg = {};
  std::optional<double> range_nm = {};  // the range scale in use
  char unit = 'N';                      // K, N or S
  char rotation = 'H';                  // C course-up, H head-up, N north-up
};
std::string encode(const Rsd& rsd, std::string_view talker = "RA");
Result<Rsd, WireError> decode_rsd(const Sentence& sentence);

struct Osd {
  std::optional<double> heading_deg = {};  // true
  bool heading_valid = true;
  std::optional<double> course_deg = {};  // true
  char course_reference = 'P';  // B bottom track, M by hand, W water, R fixed target, P position
  std::optional<double> speed_kn = {};
  char speed_reference = 'P';
  std::optional<double> set_deg = {};  // whither the stream sets, and how fast: entered by hand
  std::optional<double> drift_kn = {};
};
std::string encode(const Osd& osd, std::string_view talker = "RA");
Result<Osd, WireError> decode_osd(const Sentence& sentence);

enum class TargetStatus : char { lost = 'L', acquiring = 'Q', tracking = 'T' };

// Ranges have three decimals: with one they would be 185 m wrong.
struct Ttm {
  unsigned number = 0;  // 0 .. 99
  double range_nm = 0.0;
  double bearing_deg = 0.0;  // true
  double speed_kn = 0.0;
  double course_deg = 0.0;  // true
  double cpa_nm = 0.0;
  double tcpa_min = 0.0;  // negative: past
  std::string name = {};  // as much of it as fits
  TargetStatus status = TargetStatus::tracking;
  std::optional<Duration> time_of_day = {};
};
std::string encode(const Ttm& ttm, std::string_view talker = "RA");
// Bearing and course must be true, distances in nautical miles.
Result<Ttm, WireError> decode_ttm(const Sentence& sentence);

struct Tll {
  unsigned number = 0;
  GeoPoint position = {};
  std::string name = {};
  std::optional<Duration> time_of_day = {};
  TargetStatus status = TargetStatus::tracking;
};
std::string encode(const Tll& tll, std::string_view talker = "RA");
Result<Tll, WireError> decode_tll(const Sentence& sentence);

}  // namespace skerry::nmea
