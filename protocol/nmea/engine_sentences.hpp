// RPM, PRC and ETL: what an engine does, what its lever asks for, and the engine telegraph.
// Shafts are numbered from the centre line: 0 single or on it, odd to starboard, even to port;
// 0 .. 99.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/demand_fields.hpp"

namespace skerry::nmea {

enum class RevolutionSource : char { shaft = 'S', engine = 'E' };

struct Rpm {
  RevolutionSource source = RevolutionSource::shaft;
  unsigned number = 0;
  std::optional<double> revolutions = {};    // a minute, within 9999.9; negative counter-clockwise
  std::optional<double> pitch_percent = {};  // of the largest, within 100; negative astern
};
std::string encode(const Rpm& rpm, std::string_view talker = "RC");
Result<Rpm, WireError> decode_rpm(const Sentence& sentence);

// A remote control's lever and what follows from it.  What is not valid is absent.
struct Prc {
  std::optional<double> lever_percent = {};  // within 100; negative astern
  std::optional<Demand> speed = {};          // per cent or revolutions a minute; negative astern
  std::optional<Demand> pitch = {};          // per cent or degrees; negative astern
  std::optional<CommandPlace> place = CommandPlace::bridge;
  unsigned shaft = 0;
};
std::string encode(const Prc& prc, std::string_view talker = "RC");
Result<Prc, WireError> decode_prc(const Sentence& sentence);

// The values are those of the field.
enum class EngineOrder : unsigned char {
  stop = 0,
  dead_slow_ahead = 1,
  slow_ahead = 2,
  half_ahead = 3,
  full_ahead = 4,
  navigation_full = 5,
  dead_slow_astern = 11,
  slow_astern = 12,
  half_astern = 13,
  full_astern = 14,
  crash_astern = 15,
};
enum class SubTelegraph : unsigned char { stand_by = 20, full_away = 30, finished = 40 };

struct Etl {
  std::optional<Duration> time_of_day = {};
  bool is_order = true;  // otherwise the engine's answer
  EngineOrder order = EngineOrder::stop;
  std::optional<SubTelegraph> sub = {};
  std::optional<CommandPlace> place = CommandPlace::bridge;
  unsigned shaft = 0;
};
std::string encode(const Etl& etl, std::string_view talker = "RC");
Result<Etl, WireError> decode_etl(const Sentence& sentence);

// The lever's position that a telegraph's order means: steps of 20 %, so that full ahead is 80 and
// navigation full 100.  An assumption: no standard says what a step is.
double lever_percent_of(EngineOrder order);
// The order whose lever_percent_of() is nearest; the smaller one of two.  NaN is stop.
EngineOrder nearest_order(double lever_percent);

}  // namespace skerry::nmea
