#include "server/core/error_counts.hpp"

#include <spdlog/spdlog.h>

namespace skerry::server {

void ErrorCounts::add(std::string_view kind, std::string_view text, std::uint64_t times) {
  {
    const std::lock_guard lock(mutex_);
    auto position = counts_.find(kind);
    if (position == counts_.end() && counts_.size() >= kMaxKinds) {
      kind = kOther;
      position = counts_.find(kind);
    }
    if (position != counts_.end()) {
      position->second += times;
      return;
    }
    counts_.emplace(std::string(kind), times);
  }
  spdlog::warn("{}: {} (further errors of this kind are only counted)", kind, text);
}

std::map<std::string, std::uint64_t> ErrorCounts::counts() const {
  const std::lock_guard lock(mutex_);
  return {counts_.begin(), counts_.end()};
}

}  // namespace skerry::server
