// WaitingRoom: what a relay says of itself while it waits for the server that it relays.
#pragma once

#include <cstdint>
#include <memory>
#include <string>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Relays that wait for each other would not know of it: none of them serves.  So each greets who
// comes to its native port meanwhile, with a Hello that has its identity and no radars, and those
// that its own server has told in the same way are in Hello.relays.  Then the connection is closed.
// Who finds its own identity in such a Hello is in a loop (why_not_relayed()).
// In the clear alone.  At most kMost connections at once, of two seconds each; others are closed.
class WaitingRoom {
 public:
  static constexpr std::size_t kMost = 16;

  // `address` and `port`: where the server will be reached.  `port` 0, or one that cannot be had:
  // nobody is greeted.  `hello`: of this server.
  WaitingRoom(const std::string& address, std::uint16_t port, wire::Hello hello);
  // Then the port is free again.
  ~WaitingRoom();
  WaitingRoom(const WaitingRoom&) = delete;
  WaitingRoom& operator=(const WaitingRoom&) = delete;

  bool is_open() const;
  const std::string& identity() const { return hello_.identity(); }
  // What this server's own one has told; nullptr: it has told nothing now.
  void set_before(const wire::Hello* before);

 private:
  class Impl;
  wire::Hello hello_;
  std::unique_ptr<Impl> impl_;  // nullptr: nobody is greeted
};

}  // namespace skerry::server
