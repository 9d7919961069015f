// Times as logs of sentences and tables of positions write them.
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <string_view>

#include "protocol/quantity/time.hpp"

namespace skerry::nmea {

// Times of logs are from the one on and before the other; a receiver without a fix tells older
// ones.
inline constexpr UtcTime kFirstLogTime{std::chrono::seconds(631'152'000)};     // 1990
inline constexpr UtcTime kAfterLogTimes{std::chrono::seconds(4'102'444'800)};  // 2100

struct LogTime {
  UtcTime utc{};
  std::size_t length = 0;  // characters that it takes
};

// A time that the text begins with, 1990 to 2099:
// - ISO 8601, "2021-01-05T01:51:55.250Z" or with a space, with "+hh:mm" or without a zone (UTC);
// - "05/01/2021 01:51:55", day first;
// - seconds since 1970, "1609811515" or "1609811515.25", or milliseconds, "1609811515250".
// nullopt if it begins with none.
std::optional<LogTime> read_log_time(std::string_view text);

// The same of a text that is a time and nothing else but spaces at its ends.
std::optional<UtcTime> log_time_of(std::string_view text);

}  // namespace skerry::nmea
