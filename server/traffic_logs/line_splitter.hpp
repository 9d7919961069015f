// LineSplitter: lines out of a stream of bytes, each at most so long.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>

namespace skerry::server {

// A longer line is passed over to its end, and told once.  Memory: one line.
class LineSplitter {
 public:
  explicit LineSplitter(std::size_t longest) : longest_(longest) {}

  // Calls `line` with each whole line, without its LF, and `too_long` for each that is.
  template <typename Line, typename TooLong>
  void feed(std::string_view bytes, const Line& line, const TooLong& too_long) {
    while (!bytes.empty()) {
      const std::size_t end = std::min(bytes.find('\n'), bytes.size());
      const bool whole = end < bytes.size();
      if (!over_ && begun_.size() + end > longest_) {
        over_ = true;
        begun_.clear();
        too_long();
      }
      if (!over_ && whole && begun_.empty()) {
        line(bytes.substr(0, end));
      } else if (!over_) {
        begun_.append(bytes.substr(0, end));
        if (whole) line(std::string_view(begun_));
      }
      if (whole) {
        begun_.clear();
        over_ = false;
      }
      bytes.remove_prefix(whole ? end + 1 : end);
    }
  }
  // The last line, if it has no LF.
  template <typename Line>
  void finish(const Line& line) {
    const std::string last = std::exchange(begun_, {});
    if (!over_ && !last.empty()) line(std::string_view(last));
    over_ = false;
  }

 private:
  std::size_t longest_;
  std::string begun_;
  bool over_ = false;
};

}  // namespace skerry::server
