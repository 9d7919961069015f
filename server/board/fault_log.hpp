// FaultLog: a board's faults in the server's log, as they come and go.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>

#include "server/board/board.hpp"

namespace skerry::server {

// One line for every fault raised or cleared, kMostLines at once and one every kLineTime on and on:
// what is beyond is counted in a line of its own, so that no client can fill a disk with faults.
// Thread: one at a time.
class FaultLog {
 public:
  static constexpr int kMostLines = 20;
  static constexpr std::chrono::seconds kLineTime{10};

  explicit FaultLog(std::string name) : name_(std::move(name)) {}

  // Takes the fault changes, whatever events are enabled; `reason`: why the fault `config` is set.
  void look_at(const BoardBatch& batch, const std::function<std::string()>& reason,
               std::chrono::steady_clock::time_point now);

 private:
  // Takes a line's room, if there is any.
  bool take_room();
  void tell_left_out();
  void tell(bool is_raised, std::uint32_t faults, const std::function<std::string()>& reason);

  std::string name_;
  std::chrono::steady_clock::time_point last_{};
  std::chrono::steady_clock::duration room_ = kMostLines * kLineTime;
  std::uint64_t left_out_ = 0;
};

}  // namespace skerry::server
