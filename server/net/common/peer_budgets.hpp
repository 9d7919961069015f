// PeerBudgets: how often a peer may still ask for something, such as a change.
#pragma once

#include <chrono>
#include <cstddef>
#include <map>
#include <string>
#include <utility>

#include "server/net/common/peer_limits.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {

// A token bucket a peer: a burst at once, then as many a second as its rule says.  Bounded by
// PeerLimits::most_budgets.  Time is passed in and does not go back.  Thread: net-0.
class PeerBudgets {
 public:
  using Time = std::chrono::steady_clock::time_point;

  struct Rule {
    double per_second, burst;
  };
  struct Rules {
    std::string what;  // "changes": for refusals
    Rule own_host, others;
    std::size_t most;  // peers that are kept apart
  };
  explicit PeerBudgets(Rules rules) : rules_(std::move(rules)) {}
  static PeerBudgets of_changes(const PeerLimits& limits);
  static PeerBudgets of_sign_ins(const PeerLimits& limits);
  static PeerBudgets of_handshakes(const PeerLimits& limits);

  // False: this is one too many.
  bool take(const TcpPeer& peer, Time now);
  // Which limit that was, and what to do.
  std::string refusal(const TcpPeer& peer) const;
  std::size_t size() const { return budgets_.size(); }

 private:
  struct Budget {
    double left = 0.0;
    Time at{};
  };
  const Rule& rule_of(bool on_own_host) const;
  static double left_at(const Budget& budget, const Rule& rule, Time now);
  void make_room(Time now);

  Rules rules_;
  std::map<PeerNet, Budget> budgets_;
};

}  // namespace skerry::server
