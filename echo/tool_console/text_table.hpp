// TextTable: cells in columns as wide as they need.
#pragma once

#include <string>
#include <vector>

namespace skerry::echo {

// The first column stands to the left, the others to the right.
class TextTable {
 public:
  void begin(std::string first) { rows_.push_back({std::move(first)}); }
  void add(std::string text) { rows_.back().push_back(std::move(text)); }  // after begin()
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace skerry::echo
