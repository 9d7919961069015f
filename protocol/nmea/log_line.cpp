#include "protocol/nmea/log_line.hpp"

#include <algorithm>

#include "protocol/nmea/log_time.hpp"
#include "protocol/nmea/sentence.hpp"

namespace skerry::nmea {
namespace {

// The parameters between the backslashes, with their checksum.
bool take_tag_block(std::string_view block, LogLine& into) {
  const std::size_t star = block.rfind('*');
  if (star == std::string_view::npos || star + 3 != block.size()) return false;
  std::string_view parameters = block.substr(0, star);
  std::string given(block.substr(star + 1));
  for (char& c : given) {
    if (c >= 'a' && c <= 'f') c = static_cast<char>(c - 'a' + 'A');
  }
  if (checksum_text(parameters) != given) return false;
  while (!parameters.empty()) {
    const std::size_t end = std::min(parameters.find(','), parameters.size());
    const std::string_view each = parameters.substr(0, end);
    parameters.remove_prefix(std::min(end + 1, parameters.size()));
    if (each.starts_with("c:")) into.utc = log_time_of(each.substr(2));
    if (each.starts_with("s:")) into.source = each.substr(2);
  }
  return true;
}

std::optional<UtcTime> time_before(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t[(\"',;");
  if (begin == std::string_view::npos) return std::nullopt;
  const auto time = read_log_time(text.substr(begin));
  return time ? std::optional(time->utc) : std::nullopt;
}

std::optional<UtcTime> time_behind(std::string_view text) {
  while (!text.empty()) {
    const std::size_t comma = text.rfind(',');
    if (comma == std::string_view::npos) return std::nullopt;
    if (const auto time = log_time_of(text.substr(comma + 1))) return time;
    text = text.substr(0, comma);
  }
  return std::nullopt;
}

}  // namespace

Result<LogLine, WireError> parse_log_line(std::string_view line) {
  while (!line.empty() && (line.back() == '\r' || line.back() == '\n' || line.back() == ' ')) {
    line.remove_suffix(1);
  }
  LogLine read;
  std::size_t at = 0;
  for (;;) {
    const std::size_t mark = line.find_first_of("!$\\", at);
    if (mark == std::string_view::npos) {
      return failure(WireErrorKind::unknown_kind, line.size(),
                     "no sentence; expected one that begins with '$' or '!'");
    }
    if (!read.utc) read.utc = time_before(line.substr(at, mark - at));
    at = mark;
    if (line[mark] != '\\') break;
    const std::size_t end = line.find('\\', mark + 1);
    if (end == std::string_view::npos) {
      return failure(WireErrorKind::truncated, mark, "a TAG block that does not end");
    }
    if (!take_tag_block(line.substr(mark + 1, end - mark - 1), read)) {
      return failure(WireErrorKind::malformed, mark, "a TAG block with a wrong checksum");
    }
    at = end + 1;
  }
  const std::size_t star = line.find('*', at);
  const std::size_t end =
      star == std::string_view::npos ? line.size() : std::min(star + 3, line.size());
  read.sentence = line.substr(at, end - at);
  if (!read.utc) read.utc = time_behind(line.substr(end));
  return read;
}

}  // namespace skerry::nmea
