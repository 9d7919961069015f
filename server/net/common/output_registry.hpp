// OutputRegistry: what the emulated radars send and are told, for the status message.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// One emulated radar's counters.  Thread: written by net-0, read by any.
struct OutputCounters {
  explicit OutputCounters(wire::OutputStatus what) : fixed(std::move(what)) {}

  const wire::OutputStatus fixed;  // name, radar, views, addresses
  std::atomic<std::uint64_t> datagrams{0}, reports{0}, bytes{0};
  std::atomic<std::uint64_t> spokes_lost{0}, datagrams_unsent{0};
  std::atomic<std::uint64_t> commands{0}, commands_refused{0}, commands_dropped{0};

  void set_last_display(const std::string& address);
  std::string last_display() const;

 private:
  mutable std::mutex mutex_;
  std::string last_display_;
};
using OutputPtr = std::shared_ptr<OutputCounters>;

// Knows each output for as long as somebody holds its counters.  Thread: any.
class OutputRegistry {
 public:
  OutputPtr add(wire::OutputStatus what);
  void append_to(wire::Status& status) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<OutputCounters>> outputs_;
};

}  // namespace skerry::server
