// ChartWarnings: what of a chart could not be used, by file and object.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace skerry::echo {

// Keeps the first 100 texts and counts the rest, so that a spoilt file cannot flood a log.
class ChartWarnings {
 public:
  static constexpr std::size_t kMost = 100;

  void add(std::string text) {
    if (texts_.size() < kMost)
      texts_.push_back(std::move(text));
    else
      ++more_;
  }
  void add(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) add(text);
  }
  std::vector<std::string> texts() const {
    std::vector<std::string> all = texts_;
    if (more_ > 0) all.push_back("and " + std::to_string(more_) + " more such objects");
    return all;
  }

 private:
  std::vector<std::string> texts_;
  std::size_t more_ = 0;
};

}  // namespace skerry::echo
