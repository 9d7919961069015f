// ConnectionTable: bounds the number of connections and ends them all when the server stops.
#pragma once

#include <cstddef>
#include <memory>
#include <vector>

namespace skerry::server {

// Anything that holds a socket of a client.
class Connection {
 public:
  virtual ~Connection() = default;
  // Ends it at once: all its operations end with an error and let it go.
  virtual void close() = 0;
};

// A place at the table, held by the connection that owns the socket and handed on when HTTP becomes
// WebSocket.
struct ConnectionSlot {
  bool over_limit = false;  // admitted only to be told that the server is full
  std::weak_ptr<Connection> owner;
};
using ConnectionSlotPtr = std::shared_ptr<ConnectionSlot>;

// Thread: net-0.
class ConnectionTable {
 public:
  // So many more than `limit` are let in to be refused with a reply; beyond, sockets are just
  // closed.
  static constexpr std::size_t kRefusals = 32;

  explicit ConnectionTable(std::size_t limit) : limit_(limit) {}

  // nullptr if not even a refusal can be afforded.
  ConnectionSlotPtr try_enter();
  void close_all();

  std::size_t limit() const { return limit_; }

 private:
  std::size_t limit_;
  std::vector<std::weak_ptr<ConnectionSlot>> slots_;
};

}  // namespace skerry::server
