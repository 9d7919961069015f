#include "protocol/nmea/engine_sentences.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/nmea/optional_fields.hpp"

namespace skerry::nmea {
namespace {

constexpr unsigned kMostShafts = 99;
constexpr unsigned kFirstAstern = 10;  // added to the step
constexpr double kStepPercent = 20.0;

unsigned shaft_field(FieldReader& in, std::size_t index) {
  return in.whole(index, 0, kMostShafts).value_or(0);
}

EngineOrder order_field(FieldReader& in, std::size_t index) {
  const auto order = in.whole(index, 0, 15);
  if (!order || (*order > 5 && *order < 11)) in.fail(index, "00 to 05 or 11 to 15");
  return static_cast<EngineOrder>(order.value_or(0));
}

std::optional<SubTelegraph> sub_field(FieldReader& in, std::size_t index) {
  const auto sub = in.whole(index, 20, 40);
  if (!sub) return std::nullopt;
  if (*sub % 10 != 0) in.fail(index, "20, 30 or 40");
  return static_cast<SubTelegraph>(*sub);
}

}  // namespace

std::string encode(const Rpm& rpm, std::string_view talker) {
  SentenceWriter out('$', talker, "RPM");
  out.letter(static_cast<char>(rpm.source)).whole(std::min(rpm.number, kMostShafts));
  add_number(out, rpm.revolutions, 1, kRevolutions);
  add_number(out, rpm.pitch_percent, 1, kPerCent);
  return add_status(out,
                    within(rpm.revolutions, kRevolutions) || within(rpm.pitch_percent, kPerCent))
      .finish();
}

Result<Rpm, WireError> decode_rpm(const Sentence& sentence) {
  FieldReader in(sentence);
  Rpm rpm;
  const auto source = read_enum<RevolutionSource>(in, 0, "SE");
  if (!source) in.fail(0, "S or E");
  rpm.source = source.value_or(RevolutionSource::shaft);
  rpm.number = shaft_field(in, 1);
  rpm.revolutions = read_number(in, 2, kRevolutions);
  rpm.pitch_percent = read_number(in, 3, kPerCent);
  if (!read_status(in, 4)) rpm.revolutions = rpm.pitch_percent = std::nullopt;
  return answer(in, rpm);
}

std::string encode(const Prc& prc, std::string_view talker) {
  SentenceWriter out('$', talker, "PRC");
  add_number(out, prc.lever_percent, 1, kPerCent);
  add_status(out, within(prc.lever_percent, kPerCent).has_value());
  add_demand(out, prc.speed, kSpeedUnit);
  add_demand(out, prc.pitch, kPitchUnit);
  return add_enum(out, prc.place).whole(std::min(prc.shaft, kMostShafts)).finish();
}

Result<Prc, WireError> decode_prc(const Sentence& sentence) {
  FieldReader in(sentence);
  Prc prc;
  prc.lever_percent = read_number(in, 0, kPerCent);
  if (!read_status(in, 1)) prc.lever_percent = std::nullopt;
  prc.speed = read_demand(in, 2, kSpeedUnit);
  prc.pitch = read_demand(in, 4, kPitchUnit);
  prc.place = read_enum<CommandPlace>(in, 6, kCommandPlaces);
  prc.shaft = shaft_field(in, 7);
  return answer(in, prc);
}

std::string encode(const Etl& etl, std::string_view talker) {
  SentenceWriter out('$', talker, "ETL");
  optional_time(out, etl.time_of_day).letter(etl.is_order ? 'O' : 'A');
  out.whole(static_cast<unsigned>(etl.order), 2);
  if (etl.sub) {
    out.whole(static_cast<unsigned>(*etl.sub), 2);
  } else {
    out.empty();
  }
  return add_enum(out, etl.place).whole(std::min(etl.shaft, kMostShafts)).finish();
}

Result<Etl, WireError> decode_etl(const Sentence& sentence) {
  FieldReader in(sentence);
  Etl etl;
  etl.time_of_day = in.time(0);
  const auto kind = read_one_of(in, 1, "OA");
  if (!kind) in.fail(1, "O or A");
  etl.is_order = kind == 'O';
  etl.order = order_field(in, 2);
  etl.sub = sub_field(in, 3);
  etl.place = read_enum<CommandPlace>(in, 4, kCommandPlaces);
  etl.shaft = shaft_field(in, 5);
  return answer(in, etl);
}

double lever_percent_of(EngineOrder order) {
  const auto step = static_cast<unsigned>(order);
  return step < kFirstAstern ? kStepPercent * step : -kStepPercent * (step - kFirstAstern);
}

EngineOrder nearest_order(double lever_percent) {
  if (std::isnan(lever_percent)) return EngineOrder::stop;
  const double steps = std::ceil(std::min(std::abs(lever_percent), 100.0) / kStepPercent - 0.5);
  const auto step = static_cast<unsigned>(std::max(steps, 0.0));
  return static_cast<EngineOrder>(step > 0 && lever_percent < 0.0 ? step + kFirstAstern : step);
}

}  // namespace skerry::nmea
