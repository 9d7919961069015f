#include "server/board/fault_log.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>

#include "protocol/board/registers.hpp"

namespace skerry::server {

void FaultLog::look_at(const BoardBatch& batch, const std::function<std::string()>& reason,
                       std::chrono::steady_clock::time_point now) {
  room_ =
      std::min<std::chrono::steady_clock::duration>(room_ + (now - last_), kMostLines * kLineTime);
  last_ = now;
  if (left_out_ > 0 && take_room()) tell_left_out();
  for (const auto& [raised, cleared] : batch.fault_changes) {
    for (const bool is_raised : {true, false}) {
      const std::uint32_t faults = is_raised ? raised : cleared;
      if (faults == 0) continue;
      if (take_room()) {
        tell(is_raised, faults, reason);
      } else {
        ++left_out_;
      }
    }
  }
}

bool FaultLog::take_room() {
  if (room_ < kLineTime) return false;
  room_ -= kLineTime;
  return true;
}

void FaultLog::tell_left_out() {
  spdlog::warn("board of {}: {} more faults raised or cleared", name_, left_out_);
  left_out_ = 0;
}

void FaultLog::tell(bool is_raised, std::uint32_t faults,
                    const std::function<std::string()>& reason) {
  const std::string names = board::fault_names(faults);
  if (!is_raised) {
    spdlog::info("board of {}: fault cleared: {}", name_, names);
    return;
  }
  // Empty where the settings have been put right meanwhile.
  std::string why = (faults & board::fault::config) != 0 ? reason() : "";
  if (!why.empty()) why.insert(0, ": ");
  spdlog::warn("board of {}: fault raised: {}{}", name_, names, why);
}

}  // namespace skerry::server
