// Fields that a sentence may leave empty.
#pragma once

#include <optional>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// Write as SentenceWriter::number() and angle() do; without a value an empty field.
inline SentenceWriter& optional_number(SentenceWriter& out, std::optional<double> value,
                                       int decimals) {
  return value ? out.number(*value, decimals) : out.empty();
}
inline SentenceWriter& optional_angle(SentenceWriter& out, std::optional<double> value,
                                      int decimals) {
  return value ? out.angle(*value, decimals) : out.empty();
}
// As SentenceWriter::time() and position() do; without a value one or four empty fields.
inline SentenceWriter& optional_time(SentenceWriter& out, std::optional<Duration> of_day) {
  return of_day ? out.time(*of_day) : out.empty();
}
inline SentenceWriter& optional_position(SentenceWriter& out, std::optional<GeoPoint> point,
                                         int decimals = 5) {
  return point ? out.position(*point, decimals) : out.empty().empty().empty().empty();
}

}  // namespace skerry::nmea
