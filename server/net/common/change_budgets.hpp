// ChangeBudgets: how many changes a peer may still ask for.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>

#include "server/net/common/peer_limits.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {

// A token bucket a peer: a burst at once, then as many a second as PeerLimits says.  Bounded by
// PeerLimits::most_budgets.  Time is passed in and does not go back.  Thread: net-0.
class ChangeBudgets {
 public:
  using Time = std::chrono::steady_clock::time_point;

  explicit ChangeBudgets(const PeerLimits& limits) : limits_(limits) {}

  // False: this change is one too many.
  bool take(const TcpPeer& peer, Time now);
  // Which limit that was, and what to do.
  std::string refusal(const TcpPeer& peer) const;
  std::size_t size() const { return budgets_.size(); }

 private:
  struct Budget {
    double left = 0.0;
    Time at{};
  };
  struct Rule {
    double per_second, burst;
  };
  Rule rule_of(bool on_own_host) const;
  static double left_at(const Budget& budget, const Rule& rule, Time now);
  void make_room(Time now);

  PeerLimits limits_;
  std::map<PeerNet, Budget> budgets_;
};

}  // namespace skerry::server
