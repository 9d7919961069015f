#include "protocol/nmea/thruster_sentences.hpp"

#include <algorithm>

#include "protocol/nmea/optional_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr unsigned kMostThrusters = 99;

// The fields both sentences begin with.
template <typename Thruster>
SentenceWriter thruster_writer(const Thruster& thruster, std::string_view talker,
                               std::string_view formatter) {
  SentenceWriter out('$', talker, formatter);
  out.whole(std::clamp(thruster.number, 1u, kMostThrusters));
  add_demand(out, thruster.speed, kSpeedUnit);
  add_demand(out, thruster.pitch, kPitchUnit);
  optional_angle(out, thruster.azimuth_deg, 1);
  return out;
}

template <typename Thruster>
void read_thruster(FieldReader& in, Thruster& thruster) {
  const auto number = in.whole(0, 1, kMostThrusters);
  if (!number) in.fail(0, "the number of a thruster");
  thruster.number = number.value_or(1);
  thruster.speed = read_demand(in, 1, kSpeedUnit);
  thruster.pitch = read_demand(in, 3, kPitchUnit);
  thruster.azimuth_deg = read_number(in, 5, kAnyBearing);
}

}  // namespace

std::string encode(const Trc& trc, std::string_view talker) {
  SentenceWriter out = thruster_writer(trc, talker, "TRC");
  return add_enum(out, trc.place).letter(trc.is_command ? 'C' : 'R').finish();
}

Result<Trc, WireError> decode_trc(const Sentence& sentence) {
  FieldReader in(sentence);
  Trc trc;
  read_thruster(in, trc);
  trc.place = read_enum<CommandPlace>(in, 6, kCommandPlaces);
  trc.is_command = read_is_command(in, 7);
  return answer(in, trc);
}

std::string encode(const Trd& trd, std::string_view talker) {
  return thruster_writer(trd, talker, "TRD").finish();
}

Result<Trd, WireError> decode_trd(const Sentence& sentence) {
  FieldReader in(sentence);
  Trd trd;
  read_thruster(in, trd);
  return answer(in, trd);
}

}  // namespace skerry::nmea
