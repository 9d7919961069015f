// Positions in a recording as people write them: `90`, `1:30`, `0:01:30.5`, or a mark's name.
#pragma once

#include <charconv>
#include <string>
#include <string_view>
#include <system_error>

#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::recording {

struct Position {
  Duration since_begin{};  // where it is a time, 0 .. kMaxPosition
  std::string mark;        // where it is a mark: its name; else empty
  bool is_mark() const { return !mark.empty(); }
};
inline constexpr Duration kMaxPosition = std::chrono::hours(24 * 365);

// A time is seconds, minutes:seconds or hours:minutes:seconds; seconds may have a fraction, and
// only the first part may reach 60.  Anything that has other characters than digits, colon and
// point is a mark's name; so is all behind `mark:`, for marks that look like times.
// Error: what was expected, in one sentence.
inline Result<Position, std::string> parse_position(std::string_view text) {
  constexpr std::string_view kMark = "mark:";
  const auto wrong = [&](std::string_view why) {
    return Failure<std::string>{"position \"" + std::string(text) + "\": " + std::string(why) +
                                "; expected seconds (90.5), minutes:seconds (1:30), "
                                "hours:minutes:seconds (0:01:30) or the name of a mark"};
  };
  if (text.starts_with(kMark)) {
    if (text.size() == kMark.size()) return wrong("the mark has no name");
    return Position{.since_begin = {}, .mark = std::string(text.substr(kMark.size()))};
  }
  if (text.empty()) return wrong("it is empty");
  if (text.find_first_not_of("0123456789:.") != std::string_view::npos) {
    return Position{.since_begin = {}, .mark = std::string(text)};
  }
  double seconds = 0.0;
  int parts = 0;
  for (std::string_view rest = text;; ++parts) {
    const std::size_t colon = rest.find(':');
    const bool last = colon == std::string_view::npos;
    const std::string_view part = rest.substr(0, colon);
    double value = 0.0;
    const auto [end, error] = std::from_chars(part.data(), part.data() + part.size(), value);
    const bool whole = error == std::errc() && end == part.data() + part.size();
    if (!whole || (!last && part.find('.') != std::string_view::npos)) return wrong("no number");
    if (parts > 0 && !(value < 60.0)) return wrong("minutes and seconds end at 59");
    if (parts > 2) return wrong("too many colons");
    seconds = seconds * 60.0 + value;
    if (!(seconds <= in_seconds(kMaxPosition))) return wrong("that is more than a year");
    if (last) break;
    rest.remove_prefix(colon + 1);
  }
  return Position{.since_begin = seconds_as_duration(seconds), .mark = {}};
}

}  // namespace skerry::recording
