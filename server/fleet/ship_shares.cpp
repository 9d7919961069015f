#include "server/fleet/ship_shares.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cstdint>
#include <numeric>

namespace skerry::fleet {
namespace {

constexpr std::string_view kShip = "ship/";

// FNV-1a and a mix, which is the same everywhere.
std::uint64_t hash_of(const std::string& text) {
  std::uint64_t hash = 14695981039346656037u;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211u;
  // Names that differ in one letter get orders that have nothing in common (splitmix64).
  hash = (hash ^ hash >> 30) * 0xBF58476D1CE4E5B9u;
  hash = (hash ^ hash >> 27) * 0x94D049BB133111EBu;
  return hash ^ hash >> 31;
}

}  // namespace

std::string ship_name(std::size_t ship) { return fmt::format("{}{}", kShip, ship); }

std::optional<std::size_t> ship_of(std::string_view name) {
  if (!name.starts_with(kShip)) return std::nullopt;
  name.remove_prefix(kShip.size());
  std::size_t ship = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), ship);
  if (error != std::errc() || end != name.data() + name.size()) return std::nullopt;
  return ship;
}

Shares shares_of(const std::string& host, const std::vector<std::string>& holders,
                 const std::set<std::string>& present) {
  const std::size_t hosts = std::max<std::size_t>(1, present.size());
  const std::size_t most = (holders.size() + hosts - 1) / hosts, least = holders.size() / hosts;
  std::vector<std::size_t> mine, free;
  std::map<std::string, std::size_t> held;
  for (const std::string& each : present) held[each] = 0;
  for (std::size_t ship = 0; ship < holders.size(); ++ship) {
    if (holders[ship].empty()) free.push_back(ship);
    if (holders[ship] == host) mine.push_back(ship);
    ++held[holders[ship]];
  }
  const auto liked = [&](std::size_t ship) { return hash_of(fmt::format("{} {}", ship, host)); };
  const auto by_liking = [&](std::size_t a, std::size_t b) { return liked(a) < liked(b); };
  Shares shares;
  if (mine.size() < most) {
    std::sort(free.begin(), free.end(), by_liking);
    free.resize(std::min(free.size(), most - mine.size()));
    shares.take = std::move(free);
  } else if (free.empty() && !mine.empty()) {
    const auto another_has_less = [&](std::size_t than) {
      return std::any_of(present.begin(), present.end(),
                         [&](const auto& each) { return each != host && held[each] < than; });
    };
    if ((mine.size() > most && another_has_less(most)) ||
        (mine.size() > least && another_has_less(least)))
      shares.give_up = *std::max_element(mine.begin(), mine.end(), by_liking);
  }
  return shares;
}

}  // namespace skerry::fleet
