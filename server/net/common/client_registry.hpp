// ClientRegistry: who is being served and how well, for the status message and for monitoring.
#pragma once

#include <atomic>
#include <cstdint>
#include <map>
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

// All clients of a transport since the server started, those that have gone among them: but for
// `connected` none of it ever gets less.
struct ClientTotals {
  std::uint64_t connected = 0;  // now
  std::uint64_t connections = 0;
  std::uint64_t spokes_sent = 0, spokes_lost = 0, bytes_sent = 0;
};
using ClientTotalsByTransport = std::map<std::string, ClientTotals>;

// Knows each client for as long as somebody holds its counters.  Thread: any.
class ClientRegistry {
 public:
  ClientPtr add(std::string transport, std::string peer);
  void append_to(wire::Status& status) const;
  ClientTotalsByTransport totals() const;

 private:
  // Outlives the registry until the last client has gone.
  struct Books {
    void leave(const ClientCounters& client);

    std::mutex mutex;
    std::vector<const ClientCounters*> clients;  // in the order they came
    ClientTotalsByTransport gone;                // `connections` are of all
  };
  std::shared_ptr<Books> books_ = std::make_shared<Books>();
};

}  // namespace skerry::server
