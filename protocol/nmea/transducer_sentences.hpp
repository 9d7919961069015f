// XDR: measurements that have no sentence of their own, such as roll.
// Source: nmea/README.md "Sentences of the con".
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {

struct Transducer {
  char type = 'A';                   // A angle, C temperature, P pressure, T revolutions, ..
  std::optional<double> value = {};  // within 99999999.99; written to 0.01
  char unit = 'D';                   // D degrees, C Celsius, ..; '\0' none
  std::string name = {};             // at most 15 characters
};

// Roll, positive to starboard.  Of an angle the sentence says that negative is anti-clockwise, here
// as seen from astern.
Transducer roll_transducer(double roll_deg);

// As many sentences as needed.
std::vector<std::string> encode_xdr(std::span<const Transducer> transducers,
                                    std::string_view talker = "II");
Result<std::vector<Transducer>, WireError> decode_xdr(const Sentence& sentence);

}  // namespace skerry::nmea
