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

}  // namespace skerry::nmea
