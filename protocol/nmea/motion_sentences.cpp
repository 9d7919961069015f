#include "protocol/nmea/motion_sentences.hpp"

#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr Range kShipSpeed{-kMostSpeedKn, kMostSpeedKn};
constexpr Range kTurnRate{-10'000.0, 10'000.0};

void add_speed(SentenceWriter& out, std::optional<double> ahead, std::optional<double> starboard) {
  const auto known_ahead = within(ahead, kShipSpeed);
  add_number(out, known_ahead, 2, kShipSpeed);
  add_number(out, known_ahead ? starboard : std::nullopt, 2, kShipSpeed);
  add_status(out, known_ahead.has_value());
}

void add_stern_speed(SentenceWriter& out, std::optional<double> starboard) {
  add_number(out, starboard, 2, kShipSpeed);
  add_status(out, within(starboard, kShipSpeed).has_value());
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

std::string encode(const Hdg& hdg, std::string_view talker) {
  SentenceWriter out('$', talker, "HDG");
  optional_angle(out, hdg.sensor_deg, 1);
  add_sided(out, hdg.deviation_deg, 1, 180.0, 'E', 'W');
  return add_sided(out, hdg.variation_deg, 1, 180.0, 'E', 'W').finish();
}

Result<Hdg, WireError> decode_hdg(const Sentence& sentence) {
  FieldReader in(sentence);
  Hdg hdg;
  hdg.sensor_deg = read_number(in, 0, kAnyBearing);
  hdg.deviation_deg = read_sided(in, 1, 180.0, 'E', 'W');
  hdg.variation_deg = read_sided(in, 3, 180.0, 'E', 'W');
  return answer(in, hdg);
}

std::string encode(const Rot& rot, std::string_view talker) {
  SentenceWriter out('$', talker, "ROT");
  return add_number(out, rot.rate_deg_min, 1, kTurnRate).letter(rot.valid ? 'A' : 'V').finish();
}

Result<Rot, WireError> decode_rot(const Sentence& sentence) {
  FieldReader in(sentence);
  Rot rot;
  rot.rate_deg_min = read_number(in, 0, kTurnRate);
  rot.valid = in.letter(1) == 'A';
  return answer(in, rot);
}

std::string encode(const Vhw& vhw, std::string_view talker) {
  SentenceWriter out('$', talker, "VHW");
  optional_angle(out, vhw.heading_deg, 2).letter('T').empty().letter('M');
  if (const auto speed_kn = within(vhw.speed_kn, kShipSpeed)) {
    out.number(*speed_kn, 2).letter('N').number(*speed_kn * kKmhPerKnot, 2).letter('K');
  } else {
    out.empty().letter('N').empty().letter('K');
  }
  return out.finish();
}

Result<Vhw, WireError> decode_vhw(const Sentence& sentence) {
  FieldReader in(sentence);
  Vhw vhw;
  vhw.heading_deg = in.number_in(0, 'T', 0, 360);
  vhw.speed_kn = in.number_in(4, 'N', kShipSpeed.min, kShipSpeed.max);
  return answer(in, vhw);
}

std::string encode(const Vbw& vbw, std::string_view talker) {
  SentenceWriter out('$', talker, "VBW");
  add_speed(out, vbw.water_ahead_kn, vbw.water_starboard_kn);
  add_speed(out, vbw.ground_ahead_kn, vbw.ground_starboard_kn);
  add_stern_speed(out, vbw.water_stern_starboard_kn);
  add_stern_speed(out, vbw.ground_stern_starboard_kn);
  return out.finish();
}

Result<Vbw, WireError> decode_vbw(const Sentence& sentence) {
  FieldReader in(sentence);
  Vbw vbw;
  const auto speed = [&](std::size_t index) { return read_number(in, index, kShipSpeed); };
  vbw.water_ahead_kn = speed(0);
  vbw.water_starboard_kn = speed(1);
  if (in.letter(2) != 'A') vbw.water_ahead_kn = vbw.water_starboard_kn = std::nullopt;
  vbw.ground_ahead_kn = speed(3);
  vbw.ground_starboard_kn = speed(4);
  if (in.letter(5) != 'A') vbw.ground_ahead_kn = vbw.ground_starboard_kn = std::nullopt;
  vbw.water_stern_starboard_kn = speed(6);
  if (in.letter(7) != 'A') vbw.water_stern_starboard_kn = std::nullopt;
  vbw.ground_stern_starboard_kn = speed(8);
  if (in.letter(9) != 'A') vbw.ground_stern_starboard_kn = std::nullopt;
  return answer(in, vbw);
}

}  // namespace skerry::nmea
