// Text of a page: whatever comes from outside is escaped here.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skerry::server {

// For text and for attributes in quotes.  Control characters and broken UTF-8 become U+FFFD.
std::string escaped(std::string_view text);

// "12:05", "1:02:05".
std::string clock_text(double seconds);
// "045°"
std::string bearing_text(double degrees);

// A table of cells that are escaped as they are added.
class HtmlTable {
 public:
  // Columns whose name begins with '#' hold numbers.
  explicit HtmlTable(const std::vector<std::string>& columns, std::string_view id = {});
  // `kind`: a class of the row, of letters only.
  void begin_row(std::string_view kind = {});
  void add(std::string_view text) { add_html(escaped(text)); }
  void add_html(std::string_view html);
  bool is_empty() const { return rows_ == 0; }
  std::string html() const;

 private:
  std::string text_;
  std::vector<bool> numbers_;
  std::size_t column_ = 0, rows_ = 0;
};

}  // namespace skerry::server
