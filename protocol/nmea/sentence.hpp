// Sentence: the frame of NMEA 0183 and IEC 61162-1: "$GPRMC,...*hh" and "!AIVDM,...*hh".
// Source: IEC 61162-1:2010 clause 7; nmea/README.md.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::nmea {

// Characters of a sentence from its start to its CR LF.
inline constexpr std::size_t kMaxSentence = 82;
// The longest sentence that is read: some equipment sends more than the standard allows.
inline constexpr std::size_t kMaxReadSentence = 256;

// Exclusive or of the characters between the start and the '*'.
std::uint8_t checksum_of(std::string_view between);
// Two hexadecimal digits, upper case.
std::string checksum_text(std::string_view between);

// Views into the line that was read.
struct Sentence {
  char start = '$';                 // '$' or '!'
  std::string_view talker = {};     // "GP"; "P" of a proprietary sentence
  std::string_view formatter = {};  // "RMC"
  std::vector<std::string_view> fields = {};
};

// One line; CR, LF and spaces at its end fall away.  Error: no start, no or a wrong checksum, a
// character that may not be there, more than kMaxReadSentence characters.
Result<Sentence, WireError> parse_sentence(std::string_view line);

// Writes a sentence field by field.  What is not finite becomes an empty field.
class SentenceWriter {
 public:
  // Requires a talker of two and a formatter of three letters.
  SentenceWriter(char start, std::string_view talker, std::string_view formatter);

  SentenceWriter& empty();
  SentenceWriter& letter(char letter);  // '\0': empty
  // Characters that a sentence may not have become spaces; at most `most` are kept.
  SentenceWriter& text(std::string_view text, std::size_t most = kMaxSentence);
  // Never "-0.0".
  SentenceWriter& number(double value, int decimals);
  SentenceWriter& whole(std::uint64_t value, int digits = 1);  // with leading zeros
  // [0, 360) after rounding: 359.96 is "0.0".
  SentenceWriter& angle(double degrees, int decimals);
  // Four fields: ddmm.mmmmm,N,dddmm.mmmmm,E; minutes never reach 60.  `decimals` of the minute, 1
  // to
  // 5.  Error: 0.93 cm with 5, 0.93 m with 3.
  SentenceWriter& position(GeoPoint point, int decimals = 5);
  // hhmmss.ss of the day, truncated: it is never 60.00 s.
  SentenceWriter& time(Duration of_day);

  // Characters that may still be written before kMaxSentence, if `after` characters follow this
  // field.
  std::size_t room(std::size_t after) const;

  // With checksum, CR and LF.
  std::string finish() const;

 private:
  std::string between_ = {};
  char start_;
};

}  // namespace skerry::nmea
