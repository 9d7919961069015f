#include "protocol/nmea/radar_sentences.hpp"

#include <algorithm>

#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/position_sentences.hpp"

namespace skerry::nmea {
namespace {

constexpr double kMostRangeNm = 10'000.0, kMostMinutes = 100'000.0;
constexpr unsigned kMostTargetNumber = 1023;  // some radars count further than 99

TargetStatus status_field(FieldReader& in, std::size_t index) {
  switch (in.letter(index)) {
    case 'L':
      return TargetStatus::lost;
    case 'Q':
      return TargetStatus::acquiring;
    case 'T':
      return TargetStatus::tracking;
  }
  in.fail(index, "L, Q or T");
  return TargetStatus::lost;
}

// A field without which the sentence says nothing.
double needed(FieldReader& in, std::size_t index, double min, double max) {
  const auto value = in.number(index, min, max);
  if (!value) in.fail(index, "a number");
  return value.value_or(0.0);
}

}  // namespace

std::string encode(const Rsd& rsd, std::string_view talker) {
  SentenceWriter out('$', talker, "RSD");
  for (int field = 0; field < 8; ++field) out.empty();
  optional_number(out, rsd.cursor_range_nm, 3);
  optional_angle(out, rsd.cursor_bearing_deg, 1);
  return optional_number(out, rsd.range_nm, 3).letter(rsd.unit).letter(rsd.rotation).finish();
}

Result<Rsd, WireError> decode_rsd(const Sentence& sentence) {
  FieldReader in(sentence);
  Rsd rsd;
  rsd.cursor_range_nm = in.number(8, 0, kMostRangeNm);
  rsd.cursor_bearing_deg = in.number(9, 0, 360);
  rsd.range_nm = in.number(10, 0, kMostRangeNm);
  rsd.unit = in.letter(11);
  rsd.rotation = in.letter(12);
  return answer(in, rsd);
}

std::string encode(const Osd& osd, std::string_view talker) {
  SentenceWriter out('$', talker, "OSD");
  optional_angle(out, osd.heading_deg, 1).letter(osd.heading_valid ? 'A' : 'V');
  optional_angle(out, osd.course_deg, 1).letter(osd.course_reference);
  optional_number(out, osd.speed_kn, 2).letter(osd.speed_reference);
  optional_angle(out, osd.set_deg, 1);
  return optional_number(out, osd.drift_kn, 2).letter('N').finish();
}

Result<Osd, WireError> decode_osd(const Sentence& sentence) {
  FieldReader in(sentence);
  Osd osd;
  osd.heading_deg = in.number(0, 0, 360);
  osd.heading_valid = in.letter(1) == 'A';
  osd.course_deg = in.number(2, 0, 360);
  osd.course_reference = in.letter(3);
  osd.speed_kn = in.number(4, -kMostSpeedKn, kMostSpeedKn);
  osd.speed_reference = in.letter(5);
  osd.set_deg = in.number(6, 0, 360);
  osd.drift_kn = in.number(7, 0, kMostSpeedKn);
  if (in.letter(8) != 'N') in.fail(8, "the unit N");
  return answer(in, osd);
}

std::string encode(const Ttm& ttm, std::string_view talker) {
  SentenceWriter out('$', talker, "TTM");
  out.whole(ttm.number, 2).number(ttm.range_nm, 3).angle(ttm.bearing_deg, 1).letter('T');
  out.number(ttm.speed_kn, 1).angle(ttm.course_deg, 1).letter('T').number(ttm.cpa_nm, 2);
  out.number(std::clamp(ttm.tcpa_min, -999.9, 999.9), 1).letter('N');
  // ",T,,hhmmss.ss,A" follow.
  out.text(ttm.name, out.room(ttm.time_of_day ? 15 : 6));
  out.letter(static_cast<char>(ttm.status)).empty();
  return optional_time(out, ttm.time_of_day).letter('A').finish();
}

Result<Ttm, WireError> decode_ttm(const Sentence& sentence) {
  FieldReader in(sentence);
  Ttm ttm;
  ttm.number = in.whole(0, 0, kMostTargetNumber).value_or(0);
  ttm.range_nm = needed(in, 1, 0, kMostRangeNm);
  ttm.bearing_deg = needed(in, 2, 0, 360);
  ttm.speed_kn = in.number(4, 0, kMostSpeedKn).value_or(0.0);
  ttm.course_deg = in.number(5, 0, 360).value_or(0.0);
  ttm.cpa_nm = in.number(7, 0, kMostRangeNm).value_or(0.0);
  ttm.tcpa_min = in.number(8, -kMostMinutes, kMostMinutes).value_or(0.0);
  if (in.letter(3) != 'T') in.fail(3, "T for true");
  if (in.letter(6) == 'R') in.fail(6, "T for true");
  if (in.letter(9) != 'N') in.fail(9, "the unit N");
  ttm.name = in.text(10);
  ttm.status = status_field(in, 11);
  ttm.time_of_day = in.time(13);
  return answer(in, ttm);
}

std::string encode(const Tll& tll, std::string_view talker) {
  SentenceWriter out('$', talker, "TLL");
  out.whole(tll.number, 2).position(tll.position);
  // ",hhmmss.ss,T," follow.
  out.text(tll.name, out.room(tll.time_of_day ? 13 : 4));
  return optional_time(out, tll.time_of_day).letter(static_cast<char>(tll.status)).empty().finish();
}

Result<Tll, WireError> decode_tll(const Sentence& sentence) {
  FieldReader in(sentence);
  Tll tll;
  tll.number = in.whole(0, 0, kMostTargetNumber).value_or(0);
  const auto position = in.position(1);
  if (!position) in.fail(1, "a position");
  tll.position = position.value_or(GeoPoint{});
  tll.name = in.text(5);
  tll.time_of_day = in.time(6);
  tll.status = status_field(in, 7);
  return answer(in, tll);
}

}  // namespace skerry::nmea
