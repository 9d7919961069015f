// ConSharing: which of a relay's consoles has the con that the relay has at the other server.
#pragma once

#include <chrono>
#include <map>
#include <optional>
#include <set>
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
  // It has answered, or has not in time.  Once for each asked().
  // True: it has granted the con, but nobody here has it, so that it is to be given back.
  bool answered(const std::string& ship, const wire::Set& set, const std::string& origin,
                bool is_granted, Time now);
  // It has granted the con after answered() was told that it had not.  True: to be given back now;
  // otherwise somebody here has it or is just asking for it, whom giving it back would take it
  // from.
  bool granted_late(const std::string& ship);
  // The connection of `origin` has ended; the ships whose con it had, which is to be given back.
  std::vector<std::string> leave(const std::string& origin);

  // As consoles here are to see it: `you` is the relay at the other server.
  void tell(const std::string& ship, const std::string& you, Time now, wire::ConState& con);
  // The other server is another one, or has been started again: nobody has any.
  void begin_anew() {  // what is asked will be answered
    holders_.clear();
    ownerless_.clear();
  }

 private:
  struct Holder {
    std::string origin;
    Time since;
  };
  std::map<std::string, Holder> holders_;      // by ship
  std::map<std::string, std::string> takers_;  // by ship: who has asked for it and is not answered
  std::set<std::string> ownerless_;  // ships whose con was granted late, while a taker asked for it
};

}  // namespace skerry::server
