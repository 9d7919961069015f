// ConSharing: which of a relay's consoles has the con that the relay has at the other server.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// To the other server all consoles here are one client, so that it cannot tell them apart.
// Thread: one at a time.  Time is passed in.
class ConSharing {
 public:
  using Time = std::chrono::steady_clock::time_point;
  // What was told before this long after a change may be from before it.
  static constexpr std::chrono::seconds kSettling{3};

  // Why `origin` may not give this order to the ship.
  std::optional<std::string> refusal(const std::string& ship, const wire::Set& set,
                                     const std::string& origin) const;
  // Such an order goes to the other server; nobody else may take the con until it has answered.
  void asked(const std::string& ship, const wire::Set& set, const std::string& origin);
  // It has answered.  Once for each asked().
  void answered(const std::string& ship, const wire::Set& set, const std::string& origin,
                bool is_granted, Time now);
  // The connection of `origin` has ended; the ships whose con it had, which is to be given back.
  std::vector<std::string> leave(const std::string& origin);

  // As consoles here are to see it: `you` is the relay at the other server.
  void tell(const std::string& ship, const std::string& you, Time now, wire::ConState& con);
  // The other server is another one, or has been started again: nobody has any.
  void begin_anew() { holders_.clear(); }  // what is asked will be answered

 private:
  struct Holder {
    std::string origin;
    Time since;
  };
  std::map<std::string, Holder> holders_;      // by ship
  std::map<std::string, std::string> takers_;  // by ship: who has asked for it and is not answered
};

}  // namespace skerry::server
