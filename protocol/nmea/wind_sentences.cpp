#include "protocol/nmea/wind_sentences.hpp"

#include <algorithm>

#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::nmea {
namespace {

constexpr Range kWindSpeed{0.0, 400.0};  // knots

// Knots in one of the unit.
double knots_per(char unit) {
  switch (unit) {
    case 'K':
      return 1000.0 / 3600.0 / kKnot;
    case 'M':
      return 1.0 / kKnot;
    case 'S':
      return 1609.344 / 3600.0 / kKnot;
  }
  return 1.0;
}

std::optional<double> wind_speed_in(FieldReader& in, std::size_t index, char unit) {
  const double knots = knots_per(unit);
  const auto speed = in.number(index, kWindSpeed.min, kWindSpeed.max / knots + 0.1);
  if (!speed) return std::nullopt;
  return std::min(*speed * knots, kWindSpeed.max);
}

}  // namespace

std::string encode(const Mwv& mwv, std::string_view talker) {
  SentenceWriter out('$', talker, "MWV");
  optional_angle(out, mwv.angle_deg, 1).letter(static_cast<char>(mwv.reference));
  add_number(out, mwv.speed_kn, 1, kWindSpeed).letter('N');
  return add_status(out, mwv.angle_deg || within(mwv.speed_kn, kWindSpeed)).finish();
}

Result<Mwv, WireError> decode_mwv(const Sentence& sentence) {
  FieldReader in(sentence);
  Mwv mwv;
  mwv.angle_deg = read_number(in, 0, kAnyBearing);
  const auto reference = read_enum<WindReference>(in, 1, "RT");
  if (!reference) in.fail(1, "R or T");
  mwv.reference = reference.value_or(WindReference::relative);
  const auto unit = read_one_of(in, 3, "KMNS");
  if (unit) {
    mwv.speed_kn = wind_speed_in(in, 2, *unit);
  } else if (!in.text(2).empty()) {
    in.fail(3, "K, M, N or S");
  }
  if (!read_status(in, 4)) mwv.angle_deg = mwv.speed_kn = std::nullopt;
  return answer(in, mwv);
}

std::string encode(const Mwd& mwd, std::string_view talker) {
  SentenceWriter out('$', talker, "MWD");
  optional_angle(out, mwd.from_deg, 1).letter('T').empty().letter('M');
  const auto speed_kn = within(mwd.speed_kn, kWindSpeed);
  optional_number(out, speed_kn, 1).letter('N');
  optional_number(out, speed_kn ? std::optional(*speed_kn * kKnot) : std::nullopt, 1).letter('M');
  return out.finish();
}

Result<Mwd, WireError> decode_mwd(const Sentence& sentence) {
  FieldReader in(sentence);
  Mwd mwd;
  mwd.from_deg = in.number_in(0, 'T', kAnyBearing.min, kAnyBearing.max);
  const bool in_knots = read_one_of(in, 5, "N").has_value();
  const bool in_metres = read_one_of(in, 7, "M").has_value();
  if (in_knots) mwd.speed_kn = wind_speed_in(in, 4, 'N');
  if (in_metres && !mwd.speed_kn) mwd.speed_kn = wind_speed_in(in, 6, 'M');
  return answer(in, mwd);
}

}  // namespace skerry::nmea
