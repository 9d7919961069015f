#include "server/net/common/peer_budgets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skerry::server {

PeerBudgets PeerBudgets::of_changes(const PeerLimits& limits) {
  return PeerBudgets({.what = "changes",
                      .own_host = {limits.own_changes_per_second, limits.own_changes_burst},
                      .others = {limits.changes_per_second, limits.changes_burst},
                      .most = limits.most_budgets});
}

PeerBudgets PeerBudgets::of_sign_ins(const PeerLimits& limits) {
  const Rule rule{limits.sign_ins_per_second, limits.sign_ins_burst};
  return PeerBudgets(
      {.what = "sign-ins", .own_host = rule, .others = rule, .most = limits.most_budgets});
}

PeerBudgets PeerBudgets::of_handshakes(const PeerLimits& limits) {
  return PeerBudgets({.what = "TLS handshakes",
                      .own_host = {limits.own_handshakes_per_second, limits.own_handshakes_burst},
                      .others = {limits.handshakes_per_second, limits.handshakes_burst},
                      .most = limits.most_budgets});
}

const PeerBudgets::Rule& PeerBudgets::rule_of(bool on_own_host) const {
  return on_own_host ? rules_.own_host : rules_.others;
}

double PeerBudgets::left_at(const Budget& budget, const Rule& rule, Time now) {
  const std::chrono::duration<double> passed = now - budget.at;
  return std::min(rule.burst, budget.left + passed.count() * rule.per_second);
}

bool PeerBudgets::take(const TcpPeer& peer, Time now) {
  const Rule rule = rule_of(peer.on_own_host);
  auto known = budgets_.find(peer.net);
  if (known == budgets_.end()) {
    if (budgets_.size() >= rules_.most) make_room(now);
    known = budgets_.emplace(peer.net, Budget{rule.burst, now}).first;
  }
  Budget& budget = known->second;
  budget = {left_at(budget, rule, now), now};
  if (budget.left < 1.0) return false;
  budget.left -= 1.0;
  return true;
}

// A budget that is full again need not be known; if all are being used, the one that was so longest
// ago is given up.
void PeerBudgets::make_room(Time now) {
  std::erase_if(budgets_, [&](const auto& each) {
    const Rule rule = rule_of(each.first == PeerNet::own_host());
    return left_at(each.second, rule, now) >= rule.burst;
  });
  if (budgets_.size() < rules_.most) return;
  const auto oldest =
      std::min_element(budgets_.begin(), budgets_.end(),
                       [](const auto& a, const auto& b) { return a.second.at < b.second.at; });
  if (oldest != budgets_.end()) budgets_.erase(oldest);
}

std::string PeerBudgets::refusal(const TcpPeer& peer) const {
  return fmt::format(
      "too many {} from {}: the limit is {:.6g} a second for all its connections together; send "
      "fewer",
      rules_.what, peer.net.text(), rule_of(peer.on_own_host).per_second);
}

}  // namespace skerry::server
