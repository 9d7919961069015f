// Tables as text: rows whose cells go by the names in the first line.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace skerry::server {

// RFC 4180, but that no cell goes on in the next line.  `text` must outlive it.
class CsvRows {
 public:
  // Errors: std::runtime_error with file, line and what was expected, if there is no first line or
  // it lacks a required column.
  CsvRows(std::string_view text, std::string_view file, std::span<const std::string_view> required);

  static constexpr std::size_t kNone = static_cast<std::size_t>(-1);
  std::size_t column(std::string_view name) const;  // kNone if it is not there

  // Goes to the next row that is not empty; false behind the last.
  bool next();
  std::size_t line() const { return line_; }
  std::string_view cell(std::size_t column) const;  // empty if it is not there

  // A cell that is empty is absent.  One that is no number in [min, max] is absent too, and
  // remembered until the next row: "lat_deg: expected -90 to 90, found 91".
  std::optional<double> number(std::size_t column, double min, double max);
  // Seconds since 1970, or a time as protocol/nmea/log_time.hpp reads it.
  std::optional<double> time(std::size_t column);
  const std::string& wrong() const { return wrong_; }

 private:
  bool take_line(std::string_view& line);
  void split(std::string_view line);
  void remember(std::size_t column, const std::string& expected);

  std::string_view text_;
  std::size_t line_ = 0;
  std::vector<std::string> names_, cells_;
  std::string wrong_;
};

// A finite number and nothing else.
std::optional<double> number_of_text(std::string_view text);

}  // namespace skerry::server
