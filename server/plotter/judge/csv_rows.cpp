#include "server/plotter/judge/csv_rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <utility>

#include "protocol/nmea/log_time.hpp"
#include "server/plotter/judge/read_notes.hpp"

namespace skerry::server {
namespace {

constexpr std::size_t kMostColumns = 256;

std::string_view without_blanks(std::string_view text) {
  while (!text.empty() && (text.front() == ' ' || text.front() == '\t')) text.remove_prefix(1);
  while (!text.empty() && (text.back() == ' ' || text.back() == '\t')) text.remove_suffix(1);
  return text;
}

}  // namespace

std::optional<double> number_of_text(std::string_view text) {
  text = without_blanks(text);
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || text.empty()) return std::nullopt;
  return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

CsvRows::CsvRows(std::string_view text, std::string_view file,
                 std::span<const std::string_view> required)
    : text_(text) {
  if (text_.starts_with("\xEF\xBB\xBF")) text_.remove_prefix(3);
  std::string_view line;
  const bool begun = take_line(line);
  if (begun) split(line);
  names_ = std::exchange(cells_, {});
  for (const std::string_view name : required) {
    if (column(name) != kNone) continue;
    throw std::runtime_error(fmt::format(
        "{}:{}: no column {}; expected a first line that names the columns {}, found {}", file,
        std::max<std::size_t>(line_, 1), name, fmt::join(required, ","),
        begun ? "\"" + shown_text(line, 120) + "\"" : "an empty file"));
  }
}

std::size_t CsvRows::column(std::string_view name) const {
  const auto found = std::find(names_.begin(), names_.end(), name);
  return found == names_.end() ? kNone : static_cast<std::size_t>(found - names_.begin());
}

bool CsvRows::take_line(std::string_view& line) {
  while (!text_.empty()) {
    ++line_;
    const std::size_t end = text_.find('\n');
    line = text_.substr(0, end);
    text_.remove_prefix(end == std::string_view::npos ? text_.size() : end + 1);
    line = without_blanks(line.ends_with('\r') ? line.substr(0, line.size() - 1) : line);
    line = line.substr(0, kMostLine);
    if (!line.empty()) return true;
  }
  return false;
}

void CsvRows::split(std::string_view line) {
  cells_.clear();
  std::string cell;
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cell += line[++i];
    } else if (c == '"') {
      quoted = !quoted;
    } else if (c == ',' && !quoted) {
      cells_.emplace_back(without_blanks(cell));
      if (cells_.size() == kMostColumns) return;
      cell.clear();
    } else {
      cell += c;
    }
  }
  cells_.emplace_back(without_blanks(cell));
}

bool CsvRows::next() {
  wrong_.clear();
  std::string_view line;
  if (!take_line(line)) return false;
  split(line);
  return true;
}

std::string_view CsvRows::cell(std::size_t column) const {
  return column < cells_.size() ? std::string_view(cells_[column]) : std::string_view();
}

void CsvRows::remember(std::size_t column, const std::string& expected) {
  if (!wrong_.empty()) return;
  wrong_ = fmt::format("{}: expected {}, found {}", names_[column], expected,
                       shown_text(cell(column), 40));
}

std::optional<double> CsvRows::number(std::size_t column, double min, double max) {
  if (cell(column).empty()) return std::nullopt;
  const auto value = number_of_text(cell(column));
  if (value && *value >= min && *value <= max) return value;
  remember(column, fmt::format("a number from {:g} to {:g}", min, max));
  return std::nullopt;
}

std::optional<double> CsvRows::time(std::size_t column) {
  if (cell(column).empty()) return std::nullopt;
  if (const auto value = number_of_text(cell(column)); value && std::fabs(*value) < 1e11)
    return value;
  if (const auto utc = nmea::log_time_of(cell(column))) return in_seconds(utc->time_since_epoch());
  remember(column, "seconds since 1970, or a time like 2026-05-04T07:54:53.25Z");
  return std::nullopt;
}

}  // namespace skerry::server
