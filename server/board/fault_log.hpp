// FaultLog: a board's faults in the server's log, as they come and go.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "server/board/board.hpp"

namespace skerry::server {

// "acp_missing, stalled" of FaultBit.
std::string fault_names(std::uint32_t faults);

// One line for every fault raised or cleared, at most kMostLines in a second: what is beyond is
// counted in a line of its own, so that no client can fill a disk by injecting faults.
// Thread: one at a time.
class FaultLog {
 public:
  static constexpr int kMostLines = 20;

  explicit FaultLog(std::string name) : name_(std::move(name)) {}

  // Looks for events in `signals`; `reason`: why the fault `config` is set.
  void look_at(const BoardBatch& batch, const std::function<std::string()>& reason,
               std::chrono::steady_clock::time_point now);

 private:
  bool has_room(std::chrono::steady_clock::time_point now);
  void tell_left_out();
  void tell(const board::Event& event, const std::function<std::string()>& reason);

  std::string name_;
  std::chrono::steady_clock::time_point second_begun_{};
  int lines_ = 0;
  std::uint64_t left_out_ = 0;
};

}  // namespace skerry::server
