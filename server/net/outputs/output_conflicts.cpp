#include "server/net/outputs/output_conflicts.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace skerry::server {
namespace {

bool has(const std::vector<Ipv4Endpoint>& all, const Ipv4Endpoint& one) {
  return std::find(all.begin(), all.end(), one) != all.end();
}

std::optional<std::string> conflict_of(const OutputClaim& a, const OutputClaim& b) {
  for (const Ipv4Endpoint& shared : a.identity.fixed_addresses) {
    if (!has(b.identity.fixed_addresses, shared)) continue;
    if (a.interface_address == b.interface_address) {
      return fmt::format(
          "{} and {} would both be a {} at {} on {}, which displays take for one radar; give one "
          "of them an interface address of its own (interface_address: 127.0.0.2, say), or leave "
          "it out",
          a.name, b.name,
          a.identity.family == b.identity.family ? a.identity.family
                                                 : a.identity.family + " or " + b.identity.family,
          text_of(shared), a.interface_address);
    }
    if (a.interface != 0 && a.interface == b.interface && has(a.groups, shared) &&
        has(b.groups, shared)) {
      return fmt::format(
          "{} and {} would both obey what displays send to {}: {} and {} are addresses of one "
          "interface; put one of the radars on another interface, or leave it out",
          a.name, b.name, text_of(shared), a.interface_address, b.interface_address);
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<std::string> conflict_among(std::span<const OutputClaim> claims) {
  for (std::size_t i = 0; i < claims.size(); ++i) {
    for (std::size_t j = i + 1; j < claims.size(); ++j) {
      if (const auto conflict = conflict_of(claims[i], claims[j])) return conflict;
    }
  }
  return std::nullopt;
}

}  // namespace skerry::server
