// Fields whose values have a range, a side beside them, or are one of some letters.  Writer and
// reader share the range, so that what is written can be read.
#pragma once

#include <optional>
#include <string_view>

#include "protocol/nmea/field_reader.hpp"

namespace skerry::nmea {

// Both ends belong to it.
struct Range {
  double min = 0.0;
  double max = 0.0;
};

inline constexpr Range kAnyBearing{0.0, 360.0};        // degrees
inline constexpr Range kPerCent{-100.0, 100.0};        // of a lever, propeller or thruster
inline constexpr Range kRudderAngle{-180.0, 180.0};    // degrees, as sensors say it
inline constexpr Range kRudderOrder{-90.0, 90.0};      // degrees
inline constexpr Range kRevolutions{-9999.9, 9999.9};  // a minute

// Nothing for what is not finite or outside of the range.
std::optional<double> within(std::optional<double> value, Range range);

// Writes within(value), otherwise an empty field.
SentenceWriter& add_number(SentenceWriter& out, std::optional<double> value, int decimals,
                           Range range);
std::optional<double> read_number(FieldReader& in, std::size_t index, Range range);

// Two fields: the amount, up to `most`, and a letter for its sign; both empty without a value.
SentenceWriter& add_sided(SentenceWriter& out, std::optional<double> value, int decimals,
                          double most, char positive, char negative);
// An amount above 0 needs its letter.
std::optional<double> read_sided(FieldReader& in, std::size_t index, double most, char positive,
                                 char negative);

// Status fields: 'A' valid, 'V' not.  Empty is not valid.
SentenceWriter& add_status(SentenceWriter& out, bool valid);
bool read_status(FieldReader& in, std::size_t index);

// One of the letters, or nothing if the field is empty.
std::optional<char> read_one_of(FieldReader& in, std::size_t index, std::string_view letters);

// An enumeration whose values are the letters of the field.
template <typename Enum>
SentenceWriter& add_enum(SentenceWriter& out, std::optional<Enum> value) {
  return value ? out.letter(static_cast<char>(*value)) : out.empty();
}
template <typename Enum>
std::optional<Enum> read_enum(FieldReader& in, std::size_t index, std::string_view letters) {
  const auto letter = read_one_of(in, index, letters);
  if (!letter) return std::nullopt;
  return static_cast<Enum>(*letter);
}

// The sentence status flag: 'C' a command, 'R' a report of what is set.  Older editions have no
// such field, and their sentences are commands: so is one where it is missing.
bool read_is_command(FieldReader& in, std::size_t index);

// How a position was come by (position_sentences.hpp).  Before NMEA 2.3 there was no such field:
// 'A'.
char read_mode(FieldReader& in, std::size_t index);

}  // namespace skerry::nmea
