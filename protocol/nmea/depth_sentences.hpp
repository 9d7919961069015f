// DPT and DBT: the depth of water that an echo sounder measures.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <string>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

// Metres.
struct Dpt {
  std::optional<double> depth_m = {};  // below the transducer, 0 .. 12000
  // Within 100.  Positive: the water line is so far above the transducer.  Negative: the keel is so
  // far below it, which is what ships say; depth and offset add up to the water below the keel.
  std::optional<double> offset_m = {};
  std::optional<double> range_m = {};  // the range scale in use, 0 .. 12000
};
std::string encode(const Dpt& dpt, std::string_view talker = "SD");
Result<Dpt, WireError> decode_dpt(const Sentence& sentence);

// Below the transducer, 0 .. 12000 m.  Written in feet, metres and fathoms; read as metres, or, if
// there are none, from feet or fathoms.
struct Dbt {
  std::optional<double> depth_m = {};
};
std::string encode(const Dbt& dbt, std::string_view talker = "SD");
Result<Dbt, WireError> decode_dbt(const Sentence& sentence);

}  // namespace skerry::nmea
