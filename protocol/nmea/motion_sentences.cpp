#include "protocol/nmea/motion_sentences.hpp"

#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/position_sentences.hpp"

namespace skerry::nmea {
namespace {

void add_speed(SentenceWriter& out, std::optional<double> ahead, std::optional<double> starboard) {
  if (ahead) {
    out.number(*ahead, 2).number(starboard.value_or(0.0), 2).letter('A');
  } else {
    out.empty().empty().letter('V');
  }
}

}  // namespace

std::string encode(const Hdt& hdt, std::string_view talker) {
  SentenceWriter out('$', talker, "HDT");
  return optional_angle(out, hdt.heading_deg, 2).letter('T').finish();
}

Result<Hdt, WireError> decode_hdt(const Sentence& sentence) {
  FieldReader in(sentence);
  return answer(in, Hdt{in.number(0, 0, 360)});
}

std::string encode(const Ths& ths, std::string_view talker) {
  SentenceWriter out('$', talker, "THS");
  return optional_angle(out, ths.heading_deg, 2).letter(ths.mode).finish();
}

Result<Ths, WireError> decode_ths(const Sentence& sentence) {
  FieldReader in(sentence);
  Ths ths;
  ths.heading_deg = in.number(0, 0, 360);
  ths.mode = in.letter(1);
  if (ths.mode == '\0') ths.mode = 'V';  // it may not be empty
  return answer(in, ths);
}

std::string encode(const Rot& rot, std::string_view talker) {
  SentenceWriter out('$', talker, "ROT");
  if (rot.rate_deg_min) {
    out.number(*rot.rate_deg_min, 1);
  } else {
    out.empty();
  }
  return out.letter(rot.valid ? 'A' : 'V').finish();
}

Result<Rot, WireError> decode_rot(const Sentence& sentence) {
  FieldReader in(sentence);
  Rot rot;
  rot.rate_deg_min = in.number(0, -10'000, 10'000);
  rot.valid = in.letter(1) == 'A';
  return answer(in, rot);
}

std::string encode(const Vhw& vhw, std::string_view talker) {
  SentenceWriter out('$', talker, "VHW");
  optional_angle(out, vhw.heading_deg, 2).letter('T').empty().letter('M');
  if (vhw.speed_kn) {
    out.number(*vhw.speed_kn, 2).letter('N').number(*vhw.speed_kn * kKmhPerKnot, 2).letter('K');
  } else {
    out.empty().letter('N').empty().letter('K');
  }
  return out.finish();
}

Result<Vhw, WireError> decode_vhw(const Sentence& sentence) {
  FieldReader in(sentence);
  Vhw vhw;
  vhw.heading_deg = in.number_in(0, 'T', 0, 360);
  vhw.speed_kn = in.number_in(4, 'N', -kMostSpeedKn, kMostSpeedKn);
  return answer(in, vhw);
}

std::string encode(const Vbw& vbw, std::string_view talker) {
  SentenceWriter out('$', talker, "VBW");
  add_speed(out, vbw.water_ahead_kn, vbw.water_starboard_kn);
  add_speed(out, vbw.ground_ahead_kn, vbw.ground_starboard_kn);
  // No transverse speed at the stern.
  return out.empty().letter('V').empty().letter('V').finish();
}

Result<Vbw, WireError> decode_vbw(const Sentence& sentence) {
  FieldReader in(sentence);
  Vbw vbw;
  const auto speed = [&](std::size_t index) {
    return in.number(index, -kMostSpeedKn, kMostSpeedKn);
  };
  vbw.water_ahead_kn = speed(0);
  vbw.water_starboard_kn = speed(1);
  if (in.letter(2) != 'A') vbw.water_ahead_kn = vbw.water_starboard_kn = std::nullopt;
  vbw.ground_ahead_kn = speed(3);
  vbw.ground_starboard_kn = speed(4);
  if (in.letter(5) != 'A') vbw.ground_ahead_kn = vbw.ground_starboard_kn = std::nullopt;
  return answer(in, vbw);
}

}  // namespace skerry::nmea
