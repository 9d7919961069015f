#include "server/net/common/change_budgets.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skerry::server {

ChangeBudgets::Rule ChangeBudgets::rule_of(bool on_own_host) const {
  if (on_own_host) return {limits_.own_changes_per_second, limits_.own_changes_burst};
  return {limits_.changes_per_second, limits_.changes_burst};
}

double ChangeBudgets::left_at(const Budget& budget, const Rule& rule, Time now) {
  const std::chrono::duration<double> passed = now - budget.at;
  return std::min(rule.burst, budget.left + passed.count() * rule.per_second);
}

bool ChangeBudgets::take(const TcpPeer& peer, Time now) {
  const Rule rule = rule_of(peer.on_own_host);
  auto known = budgets_.find(peer.net);
  if (known == budgets_.end()) {
    if (budgets_.size() >= limits_.most_budgets) make_room(now);
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
void ChangeBudgets::make_room(Time now) {
  std::erase_if(budgets_, [&](const auto& each) {
    const Rule rule = rule_of(each.first == PeerNet::own_host());
    return left_at(each.second, rule, now) >= rule.burst;
  });
  if (budgets_.size() < limits_.most_budgets) return;
  const auto oldest =
      std::min_element(budgets_.begin(), budgets_.end(),
                       [](const auto& a, const auto& b) { return a.second.at < b.second.at; });
  if (oldest != budgets_.end()) budgets_.erase(oldest);
}

std::string ChangeBudgets::refusal(const TcpPeer& peer) const {
  return fmt::format(
      "too many changes from {}: the limit is {} a second for all its connections together; send "
      "fewer",
      peer.net.text(), rule_of(peer.on_own_host).per_second);
}

}  // namespace skerry::server
