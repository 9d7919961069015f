#include "server/relay/con_sharing.hpp"

#include <fmt/format.h>

namespace skerry::server {

std::optional<std::string> ConSharing::refusal(const std::string& ship, const wire::Set& set,
                                               const std::string& origin) const {
  const bool is_order = set.has_con() || set.has_course_deg() || set.has_speed_kn();
  const auto holder = holders_.find(ship);
  if (!is_order || set.instructor()) return std::nullopt;
  if (const auto taker = takers_.find(ship); taker != takers_.end() && set.con().take()) {
    return fmt::format("{} is just taking the con of {}; try again", taker->second, ship);
  }
  if (holder == holders_.end() || holder->second.origin == origin) return std::nullopt;
  return fmt::format("{} has the con of {}; ask for it to be given away, or take it as instructor",
                     holder->second.origin, ship);
}

void ConSharing::asked(const std::string& ship, const wire::Set& set, const std::string& origin) {
  if (set.con().take()) takers_[ship] = origin;
}

bool ConSharing::answered(const std::string& ship, const wire::Set& set, const std::string& origin,
                          bool is_granted, Time now) {
  const auto taker = takers_.find(ship);
  if (set.con().take() && taker != takers_.end() && taker->second == origin) takers_.erase(taker);
  const bool is_order = set.con().take() || set.con().release();
  if (!is_granted) {
    return set.con().take() && ownerless_.erase(ship) > 0 && !holders_.contains(ship);
  }
  if (is_order) ownerless_.erase(ship);
  if (set.con().take()) holders_[ship] = {origin, now};
  if (set.con().release()) holders_.erase(ship);
  return false;
}

bool ConSharing::granted_late(const std::string& ship) {
  if (holders_.contains(ship)) return false;
  if (!takers_.contains(ship)) return true;
  ownerless_.insert(ship);
  return false;
}

std::vector<std::string> ConSharing::leave(const std::string& origin) {
  std::vector<std::string> freed;
  for (auto each = holders_.begin(); each != holders_.end();) {
    if (each->second.origin != origin) {
      ++each;
      continue;
    }
    freed.push_back(each->first);
    each = holders_.erase(each);
  }
  return freed;
}

void ConSharing::tell(const std::string& ship, const std::string& you, Time now,
                      wire::ConState& con) {
  const auto holder = holders_.find(ship);
  if (holder == holders_.end()) return;
  if (con.con() != you && now - holder->second.since > kSettling) {
    holders_.erase(holder);
    return;
  }
  con.set_con(holder->second.origin);
}

}  // namespace skerry::server
