#include "protocol/nmea/con_command.hpp"

#include "protocol/nmea/engine_sentences.hpp"
#include "protocol/nmea/field_reader.hpp"
#include "protocol/nmea/heading_control_sentences.hpp"
#include "protocol/nmea/rudder_sentences.hpp"
#include "protocol/nmea/thruster_sentences.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::nmea {
namespace {

std::optional<double> wrapped(std::optional<double> degrees) {
  return degrees ? std::optional(wrapped_degrees(*degrees)) : std::nullopt;
}

std::optional<double> percent_of(const std::optional<Demand>& demand) {
  return demand && demand->in_percent ? std::optional(demand->value) : std::nullopt;
}

void take_turn(const SteeringFields& fields, ConCommand& command) {
  if (fields.turn == TurnMode::radius) command.turn_radius_nm = fields.turn_radius_nm;
  if (fields.turn == TurnMode::rate) command.turn_rate_deg_min = fields.turn_rate_deg_min;
  command.rudder_limit_deg = fields.rudder_limit_deg;
}

Result<ConCommand, WireError> from(const Htc& htc, FieldReader in) {
  const SteeringFields& fields = htc.fields;
  ConCommand command;
  if (!htc.is_command) return command;
  if (fields.is_overridden || fields.steering == SelectedSteering::main ||
      fields.steering == SelectedSteering::rudder) {
    command.mode = SteeringMode::hand;
    command.rudder_deg = fields.rudder_deg;
    return command;
  }
  if (!fields.steering) in.fail(3, "a steering mode");
  take_turn(fields, command);
  command.mode =
      fields.steering == SelectedSteering::track ? SteeringMode::track : SteeringMode::heading;
  if (fields.steering == SelectedSteering::heading) command.heading_deg = fields.heading_deg;
  if (fields.steering == SelectedSteering::track) command.track_deg = fields.track_deg;
  if ((command.heading_deg || command.track_deg) && fields.reference != 'T') {
    in.fail(12, "T for true");
  }
  command.heading_deg = wrapped(command.heading_deg);
  command.track_deg = wrapped(command.track_deg);
  return answer(in, command);
}

Result<ConCommand, WireError> from(const Hsc& hsc, FieldReader in) {
  ConCommand command;
  if (!hsc.is_command) return command;
  if (!hsc.true_deg) {
    if (hsc.magnetic_deg) in.fail(0, "a true heading");
    return answer(in, command);
  }
  command.mode = SteeringMode::heading;
  command.heading_deg = wrapped(hsc.true_deg);
  return command;
}

Result<ConCommand, WireError> from(const Ror& ror, const FieldReader&) {
  ConCommand command;
  command.rudder_deg = ror.starboard_deg ? ror.starboard_deg : ror.port_deg;
  if (command.rudder_deg) command.mode = SteeringMode::hand;
  return command;
}

Result<ConCommand, WireError> from(const Prc& prc, FieldReader in) {
  ConCommand command;
  command.lever_percent = prc.lever_percent ? prc.lever_percent : percent_of(prc.speed);
  if (prc.speed && !prc.speed->in_percent) command.revolutions = prc.speed->value;
  command.pitch_percent = percent_of(prc.pitch);
  if (says_something(command)) {
    command.shaft = prc.shaft;
  } else if (prc.pitch) {
    in.fail(5, "P for per cent");
  }
  return answer(in, command);
}

Result<ConCommand, WireError> from(const Etl& etl, const FieldReader&) {
  ConCommand command;
  if (!etl.is_order) return command;
  command.shaft = etl.shaft;
  command.lever_percent = lever_percent_of(etl.order);
  return command;
}

Result<ConCommand, WireError> from(const Trc& trc, FieldReader in) {
  ConCommand command;
  if (!trc.is_command || (!trc.speed && !trc.pitch)) return command;
  if (trc.azimuth_deg) in.fail(5, "no azimuth, as of a thruster in a tunnel,");
  // A controllable pitch decides; otherwise the speed does.
  const auto pitch = percent_of(trc.pitch), speed = percent_of(trc.speed);
  if (!pitch && !speed) in.fail(trc.pitch ? 4 : 2, "P for per cent");
  (is_bow_thruster(trc.number) ? command.bow_thruster_percent : command.stern_thruster_percent) =
      pitch ? pitch : speed;
  return answer(in, command);
}

template <typename Decode>
Result<ConCommand, WireError> decode_with(Decode decode, const Sentence& sentence) {
  const auto value = decode(sentence);
  if (!value) return Failure{value.error()};
  return from(*value, FieldReader(sentence));
}

}  // namespace

bool says_something(const ConCommand& command) { return command != ConCommand{}; }

Result<ConCommand, WireError> decode_con_command(const Sentence& sentence) {
  const std::string_view kind = sentence.formatter;
  if (sentence.start != '$') return ConCommand{};
  if (kind == "HTC") return decode_with(decode_htc, sentence);
  if (kind == "HSC") return decode_with(decode_hsc, sentence);
  if (kind == "ROR") return decode_with(decode_ror, sentence);
  if (kind == "PRC") return decode_with(decode_prc, sentence);
  if (kind == "ETL") return decode_with(decode_etl, sentence);
  if (kind == "TRC") return decode_with(decode_trc, sentence);
  return ConCommand{};
}

}  // namespace skerry::nmea
