#include "protocol/nmea/heading_control_sentences.hpp"

#include "protocol/nmea/optional_fields.hpp"
#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr double kMostRudderDeg = 90.0;
constexpr Range kRudderLimit{0.0, kMostRudderDeg};
constexpr Range kOffHeadingLimit{0.0, 180.0};
constexpr Range kTurnRadius{0.0, 99.999};
constexpr Range kCommandedTurnRate{0.0, 999.9};
constexpr Range kOffTrackLimit{0.0, 99.999};
// Behind the fields in common.
constexpr std::size_t kFieldsInCommon = 13;

void add_steering(SentenceWriter& out, const SteeringFields& fields) {
  add_status(out, fields.is_overridden);
  add_sided(out, fields.rudder_deg, 1, kMostRudderDeg, 'R', 'L');
  add_enum(out, fields.steering);
  add_enum(out, fields.turn);
  add_number(out, fields.rudder_limit_deg, 1, kRudderLimit);
  add_number(out, fields.off_heading_limit_deg, 1, kOffHeadingLimit);
  add_number(out, fields.turn_radius_nm, 3, kTurnRadius);
  add_number(out, fields.turn_rate_deg_min, 1, kCommandedTurnRate);
  optional_angle(out, fields.heading_deg, 1);
  add_number(out, fields.off_track_limit_nm, 3, kOffTrackLimit);
  optional_angle(out, fields.track_deg, 1).letter(fields.reference);
}

SteeringFields read_steering(FieldReader& in) {
  SteeringFields fields;
  fields.is_overridden = read_status(in, 0);
  fields.rudder_deg = read_sided(in, 1, kMostRudderDeg, 'R', 'L');
  fields.steering = read_enum<SelectedSteering>(in, 3, "MSHTR");
  fields.turn = read_enum<TurnMode>(in, 4, "RTN");
  fields.rudder_limit_deg = read_number(in, 5, kRudderLimit);
  fields.off_heading_limit_deg = read_number(in, 6, kOffHeadingLimit);
  fields.turn_radius_nm = read_number(in, 7, kTurnRadius);
  fields.turn_rate_deg_min = read_number(in, 8, kCommandedTurnRate);
  fields.heading_deg = read_number(in, 9, kAnyBearing);
  fields.off_track_limit_nm = read_number(in, 10, kOffTrackLimit);
  fields.track_deg = read_number(in, 11, kAnyBearing);
  fields.reference = read_one_of(in, 12, "TM").value_or('\0');
  return fields;
}

void add_limit(SentenceWriter& out, std::optional<bool> is_within) {
  if (is_within) {
    add_status(out, *is_within);
  } else {
    out.empty();
  }
}

std::optional<bool> read_limit(FieldReader& in, std::size_t index) {
  const auto status = read_one_of(in, index, "AV");
  if (!status) return std::nullopt;
  return status == 'A';
}

}  // namespace

std::string encode(const Htc& htc, std::string_view talker) {
  SentenceWriter out('$', talker, "HTC");
  add_steering(out, htc.fields);
  return out.letter(htc.is_command ? 'C' : 'R').finish();
}

Result<Htc, WireError> decode_htc(const Sentence& sentence) {
  FieldReader in(sentence);
  Htc htc;
  htc.fields = read_steering(in);
  htc.is_command = read_is_command(in, kFieldsInCommon);
  return answer(in, htc);
}

std::string encode(const Htd& htd, std::string_view talker) {
  SentenceWriter out('$', talker, "HTD");
  add_steering(out, htd.fields);
  add_limit(out, htd.rudder_within_limit);
  add_limit(out, htd.heading_within_limit);
  add_limit(out, htd.track_within_limit);
  return optional_angle(out, htd.ship_heading_deg, 1).finish();
}

Result<Htd, WireError> decode_htd(const Sentence& sentence) {
  FieldReader in(sentence);
  Htd htd;
  htd.fields = read_steering(in);
  htd.rudder_within_limit = read_limit(in, kFieldsInCommon);
  htd.heading_within_limit = read_limit(in, kFieldsInCommon + 1);
  htd.track_within_limit = read_limit(in, kFieldsInCommon + 2);
  htd.ship_heading_deg = read_number(in, kFieldsInCommon + 3, kAnyBearing);
  return answer(in, htd);
}

std::string encode(const Hsc& hsc, std::string_view talker) {
  SentenceWriter out('$', talker, "HSC");
  optional_angle(out, hsc.true_deg, 1).letter('T');
  return optional_angle(out, hsc.magnetic_deg, 1)
      .letter('M')
      .letter(hsc.is_command ? 'C' : 'R')
      .finish();
}

Result<Hsc, WireError> decode_hsc(const Sentence& sentence) {
  FieldReader in(sentence);
  Hsc hsc;
  hsc.true_deg = in.number_in(0, 'T', kAnyBearing.min, kAnyBearing.max);
  hsc.magnetic_deg = in.number_in(2, 'M', kAnyBearing.min, kAnyBearing.max);
  hsc.is_command = read_is_command(in, 4);
  return answer(in, hsc);
}

}  // namespace skerry::nmea
