// A line of a log of sentences: the sentence, and what its logger wrote round it.
// Source: TAG blocks of NMEA 0183 4.10 as nmea/README.md "Sources" has them; the other forms are
// those of common loggers, as the README lists them.
#pragma once

#include <optional>
#include <string_view>

#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::nmea {

// Views into the line.
struct LogLine {
  std::string_view sentence = {};   // from its start to its checksum; not checked
  std::string_view source = {};     // TAG parameter s
  std::optional<UtcTime> utc = {};  // when it was heard, if the line says it
};

// Before the sentence may stand TAG blocks ("\s:r1,c:1609811515*hh\", c in seconds or
// milliseconds), or a time (log_time.hpp) and anything else; behind its checksum fields after
// commas, of which the last that is a time counts if there was none before.
// Error: unknown_kind if there is no sentence, malformed if a TAG block has a wrong checksum,
// truncated if one does not end.
Result<LogLine, WireError> parse_log_line(std::string_view line);

}  // namespace skerry::nmea
