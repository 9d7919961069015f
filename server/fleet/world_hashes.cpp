#include "server/fleet/world_hashes.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <utility>

namespace skerry::fleet {

std::optional<WorldHashes::Difference> WorldHashes::add(const std::string& host, Tick tick,
                                                        const WorldDigest& digest) {
  if (table_.size() >= kMostTicks && tick < table_.begin()->first) return std::nullopt;
  auto& row = table_[tick];
  if (row.size() < kMostHosts || row.contains(host)) row[host] = digest;
  while (table_.size() > kMostTicks) table_.erase(table_.begin());
  return at(tick);
}

std::optional<WorldHashes::Difference> WorldHashes::at(Tick tick) const {
  const auto row = table_.find(tick);
  if (row == table_.end()) return std::nullopt;
  std::map<WorldDigest, std::vector<std::string>> groups;
  for (const auto& [host, digest] : row->second) groups[digest].push_back(host);
  if (groups.size() < 2) return std::nullopt;
  std::size_t most = 0, with_most = 0;
  for (const auto& [digest, hosts] : groups) {
    if (hosts.size() > most) with_most = 0;
    most = std::max(most, hosts.size());
    if (hosts.size() == most) ++with_most;
  }
  Difference difference{tick, {}, with_most == 1, {}};
  for (const auto& [digest, hosts] : groups) {
    if (difference.is_certain && hosts.size() == most) continue;
    difference.hosts.insert(difference.hosts.end(), hosts.begin(), hosts.end());
  }
  std::sort(difference.hosts.begin(), difference.hosts.end());
  difference.text =
      difference.is_certain
          ? fmt::format(
                "at tick {} the world of {} differs from that of {} other hosts: it must "
                "come back",
                tick, fmt::join(difference.hosts, ", "), most)
          : fmt::format(
                "at tick {} the worlds of {} differ, and none has more hosts than the "
                "others: play the log anew to see which is right",
                tick, fmt::join(difference.hosts, ", "));
  return difference;
}

}  // namespace skerry::fleet
