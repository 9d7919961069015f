// CsvTable: a table for other programs, cell by cell.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace skerry::server {

// RFC 4180, rows end with CR LF.  Numbers have ten digits; an empty optional is an empty cell.
class CsvTable {
 public:
  // Of the columns, with commas between them.
  explicit CsvTable(std::string_view names) : text_(names) { text_ += "\r\n"; }
  CsvTable& operator<<(std::string_view text);  // csv_cell.hpp
  CsvTable& operator<<(const char* text) { return *this << std::string_view(text); }
  CsvTable& operator<<(double value);
  CsvTable& operator<<(std::size_t value);
  CsvTable& operator<<(const std::optional<double>& value) {
    return value ? *this << *value : put("");
  }
  // With so many digits behind the point.
  CsvTable& fixed(double value, int digits);
  void end() {
    text_ += "\r\n";
    first_ = true;
  }
  std::string take() { return std::move(text_); }

 private:
  CsvTable& put(std::string_view cell);

  std::string text_;
  bool first_ = true;
};

}  // namespace skerry::server
