#include "protocol/nmea/radar_sentences.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr double kMostRangeNm = 10'000.0, kMostMinutes = 100'000.0;
// Of what is written: longer ones would leave a sentence no room.
constexpr Range kTargetRangeNm{0.0, 9999.999}, kTargetCpaNm{0.0, 9999.99};
constexpr double kMostWrittenMinutes = 999.9;

SentenceWriter& add_target_number(SentenceWriter& out, unsigned number) {
  return number <= kMostTargetNumber ? out.whole(number, 2) : out.empty();
}

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
  add_target_number(out, ttm.number);
  add_number(out, ttm.range_nm, 3, kTargetRangeNm).angle(ttm.bearing_deg, 1).letter('T');
  add_number(out, ttm.speed_kn, 1, {0.0, kMostSpeedKn});
  optional_angle(out, ttm.course_deg, 1).letter('T');
  add_number(out, ttm.cpa_nm, 2, kTargetCpaNm);
  if (ttm.tcpa_min && std::isfinite(*ttm.tcpa_min)) {
    out.number(std::clamp(*ttm.tcpa_min, -kMostWrittenMinutes, kMostWrittenMinutes), 1);
  } else {
    out.empty();
  }
  out.letter('N');
  // ",T,R,hhmmss.ss,A" follow.
  const std::size_t after =
      4 + (ttm.is_reference ? 1 : 0) + (ttm.time_of_day ? 9 : 0) + (ttm.acquisition ? 2 : 1);
  out.text(ttm.name, out.room(after)).letter(static_cast<char>(ttm.status));
  out.letter(ttm.is_reference ? 'R' : '\0');
  optional_time(out, ttm.time_of_day);
  return add_enum(out, ttm.acquisition).finish();
}

Result<Ttm, WireError> decode_ttm(const Sentence& sentence) {
  FieldReader in(sentence);
  Ttm ttm;
  ttm.number = in.whole(0, 0, kMostTargetNumber).value_or(0);
  ttm.range_nm = needed(in, 1, 0, kMostRangeNm);
  ttm.bearing_deg = needed(in, 2, 0, 360);
  ttm.speed_kn = in.number(4, 0, kMostSpeedKn);
  ttm.course_deg = in.number(5, 0, 360);
  ttm.cpa_nm = in.number(7, 0, kMostRangeNm);
  ttm.tcpa_min = in.number(8, -kMostMinutes, kMostMinutes);
  if (in.letter(3) != 'T') in.fail(3, "T for true");
  if (in.letter(6) == 'R') in.fail(6, "T for true");
  if (in.letter(9) != 'N') in.fail(9, "the unit N");
  ttm.name = in.text(10);
  ttm.status = status_field(in, 11);
  ttm.is_reference = read_one_of(in, 12, "R").has_value();
  ttm.time_of_day = in.time(13);
  ttm.acquisition = read_enum<TargetAcquisition>(in, 14, "AMR");
  return answer(in, ttm);
}

std::string encode(const Tll& tll, std::string_view talker) {
  SentenceWriter out('$', talker, "TLL");
  add_target_number(out, tll.number).position(tll.position);
  // ",hhmmss.ss,T,R" follow.
  const std::size_t after = 4 + (tll.is_reference ? 1 : 0) + (tll.time_of_day ? 9 : 0);
  out.text(tll.name, out.room(after));
  return optional_time(out, tll.time_of_day)
      .letter(static_cast<char>(tll.status))
      .letter(tll.is_reference ? 'R' : '\0')
      .finish();
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
  tll.is_reference = read_one_of(in, 8, "R").has_value();
  return answer(in, tll);
}

std::vector<std::string> encode_tlb(std::span<const TargetLabel> labels, std::string_view talker) {
  std::vector<std::string> lines;
  const SentenceWriter start('$', talker, "TLB");
  SentenceWriter out = start;
  bool is_empty = true;
  for (const TargetLabel& label : labels) {
    if (label.number > kMostTargetNumber) continue;
    const std::string number = fmt::format("{}", label.number);
    if (!is_empty && number.size() + 1 + label.label.size() > out.room(0)) {
      lines.push_back(std::exchange(out, start).finish());
    }
    out.text(number);
    out.text(label.label, out.room(0));
    is_empty = false;
  }
  if (!is_empty) lines.push_back(out.finish());
  return lines;
}

Result<std::vector<TargetLabel>, WireError> decode_tlb(const Sentence& sentence) {
  FieldReader in(sentence);
  std::vector<TargetLabel> labels;
  for (std::size_t at = 0; at < std::max<std::size_t>(sentence.fields.size(), 1); at += 2) {
    const auto number = in.whole(at, 0, kMostTargetNumber);
    if (!number) in.fail(at, "the number of a target");
    labels.push_back({number.value_or(0), std::string(in.text(at + 1))});
  }
  return answer(in, std::move(labels));
}

}  // namespace skerry::nmea
