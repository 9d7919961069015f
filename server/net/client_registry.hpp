// ClientRegistry: who is being served and how well, for the status message.
#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// One client's counters.  Thread: written by net-0, read by any.
struct ClientCounters {
  ClientCounters(std::string transport_name, std::string peer_name)
      : transport(std::move(transport_name)), peer(std::move(peer_name)) {}

  const std::string transport;  // tcp, websocket, udp, cat240
  const std::string peer;
  std::atomic<std::uint32_t> radar{0};
  std::atomic<std::uint32_t> view{0};
  std::atomic<std::uint64_t> spokes_sent{0};
  std::atomic<std::uint64_t> spokes_lost{0};
  std::atomic<std::uint64_t> bytes_sent{0};
};
using ClientPtr = std::shared_ptr<ClientCounters>;

// Knows each client for as long as somebody holds its counters.  Thread: any.
class ClientRegistry {
 public:
  ClientPtr add(std::string transport, std::string peer);
  void append_to(wire::Status& status) const;

 private:
  mutable std::mutex mutex_;
  std::vector<std::weak_ptr<ClientCounters>> clients_;
};

}  // namespace skerry::server
