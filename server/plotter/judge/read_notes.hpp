// What of a file was used, and what was not.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace skerry::server {

// Lines that could not be used, counted by kind.  At most kMostKinds kinds; the rest count as one.
class ReadNotes {
 public:
  static constexpr std::size_t kMostKinds = 40;

  void line() { ++lines_; }
  void use() { ++used_; }
  // `detail`: of the first of its kind, for people.
  void leave_out(std::string_view kind, std::size_t line, std::string_view detail = {});

  std::size_t lines() const { return lines_; }
  std::size_t used() const { return used_; }
  std::size_t left_out() const;
  std::size_t left_out(std::string_view kind) const;
  // "812 lines, 800 used; left out: 12 wrong place (first in line 7: lat_deg 91)".
  std::string text() const;

 private:
  struct Kind {
    std::string name;
    std::size_t count = 0, first_line = 0;
    std::string detail;
  };
  std::size_t lines_ = 0, used_ = 0;
  std::vector<Kind> kinds_;
};

// Calls `each` with every line and its number from 1, without CR and LF; one longer than
// kMostLine is given as its beginning.
inline constexpr std::size_t kMostLine = 64 * 1024;
template <typename Each>
void for_each_line(std::string_view text, const Each& each) {
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    each(line.substr(0, kMostLine), number);
  }
}

// As much of a text from outside as fits a message, on one line and printable.
std::string shown_text(std::string_view text, std::size_t most = 60);

}  // namespace skerry::server
