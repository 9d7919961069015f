// RSD, OSD, TTM, TLL and TLB: what a radar says of itself and of the targets it tracks.
// Source: IEC 61162-1:2010 clause 8; Furuno FAR-28x7 manual AP-25 and FAR-21x9 (fields of RSD, OSD,
// TTM); nmea/README.md "Sources".
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

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
enum class TargetAcquisition : char { automatic = 'A', manual = 'M', reported = 'R' };

// The highest number of a target.  Edition 4 (2010) of IEC 61162-1 has 00 to 99 in TTM and TLL;
// newer radars, TTD and TLB count to 1023, and such numbers are read and written as they are.  An
// older reader wants 99 at most.
inline constexpr unsigned kMostTargetNumber = 1023;

// Ranges have three decimals: with one they would be 185 m wrong.  What is absent, not finite or
// out of range is an empty field: so a target is sent that is still being acquired.
struct Ttm {
  unsigned number = 0;                    // 0 .. kMostTargetNumber
  double range_nm = 0.0;                  // 0 .. 9999.999; without it the sentence is refused
  double bearing_deg = 0.0;               // true
  std::optional<double> speed_kn = {};    // 0 .. 1000
  std::optional<double> course_deg = {};  // true
  std::optional<double> cpa_nm = {};      // 0 .. 9999.99
  std::optional<double> tcpa_min = {};    // negative: past; what is beyond 999.9 becomes 999.9
  std::string name = {};                  // as much of it as fits
  TargetStatus status = TargetStatus::tracking;
  std::optional<Duration> time_of_day = {};
  // The reference target, by whose motion own ship's speed is found.
  bool is_reference = false;
  std::optional<TargetAcquisition> acquisition = TargetAcquisition::automatic;
};
std::string encode(const Ttm& ttm, std::string_view talker = "RA");
// Bearing and course must be true, distances in nautical miles.
Result<Ttm, WireError> decode_ttm(const Sentence& sentence);

struct Tll {
  unsigned number = 0;  // 0 .. kMostTargetNumber
  GeoPoint position = {};
  std::string name = {};
  std::optional<Duration> time_of_day = {};
  TargetStatus status = TargetStatus::tracking;
  bool is_reference = false;
};
std::string encode(const Tll& tll, std::string_view talker = "RA");
Result<Tll, WireError> decode_tll(const Sentence& sentence);

// One pair of a TLB: what all displays shall call a target.
struct TargetLabel {
  unsigned number = 0;     // 0 .. kMostTargetNumber; others are left out
  std::string label = {};  // empty: none is specified
  friend bool operator==(const TargetLabel&, const TargetLabel&) = default;
};
// As many sentences as needed; a label that is longer than a sentence is cut.
std::vector<std::string> encode_tlb(std::span<const TargetLabel> labels,
                                    std::string_view talker = "RA");
// The pairs of one sentence, at least one.
Result<std::vector<TargetLabel>, WireError> decode_tlb(const Sentence& sentence);

}  // namespace skerry::nmea
