#include "protocol/nmea/rudder_sentences.hpp"

#include "protocol/nmea/ranged_fields.hpp"

namespace skerry::nmea {
namespace {

void add_rudder(SentenceWriter& out, std::optional<double> degrees, Range range) {
  add_number(out, degrees, 1, range);
  add_status(out, within(degrees, range).has_value());
}

std::optional<double> read_rudder(FieldReader& in, std::size_t index, Range range) {
  const auto degrees = read_number(in, index, range);
  return read_status(in, index + 1) ? degrees : std::nullopt;
}

}  // namespace

std::string encode(const Rsa& rsa, std::string_view talker) {
  SentenceWriter out('$', talker, "RSA");
  add_rudder(out, rsa.starboard_deg, kRudderAngle);
  add_rudder(out, rsa.port_deg, kRudderAngle);
  return out.finish();
}

Result<Rsa, WireError> decode_rsa(const Sentence& sentence) {
  FieldReader in(sentence);
  Rsa rsa;
  rsa.starboard_deg = read_rudder(in, 0, kRudderAngle);
  rsa.port_deg = read_rudder(in, 2, kRudderAngle);
  return answer(in, rsa);
}

std::string encode(const Ror& ror, std::string_view talker) {
  SentenceWriter out('$', talker, "ROR");
  add_rudder(out, ror.starboard_deg, kRudderOrder);
  add_rudder(out, ror.port_deg, kRudderOrder);
  return add_enum(out, ror.place).finish();
}

Result<Ror, WireError> decode_ror(const Sentence& sentence) {
  FieldReader in(sentence);
  Ror ror;
  ror.starboard_deg = read_rudder(in, 0, kRudderOrder);
  ror.port_deg = read_rudder(in, 2, kRudderOrder);
  ror.place = read_enum<CommandPlace>(in, 4, kCommandPlaces);
  return answer(in, ror);
}

}  // namespace skerry::nmea
