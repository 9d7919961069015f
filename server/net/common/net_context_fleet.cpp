// What clients are told of the other hosts of a fleet, and what pages of these may.
#include <string>
#include <vector>

#include "server/net/common/encoders.hpp"
#include "server/net/common/net_context.hpp"

namespace skerry::server {

SharedBytes NetContext::fleet_frame() const {
  auto fleet = host.fleet();
  if (!fleet) return nullptr;
  wire::ServerMessage message;
  *message.mutable_fleet() = *std::move(fleet);
  return make_frame(message);
}

std::vector<std::string> NetContext::sisters() const {
  std::vector<std::string> origins;
  const auto fleet = host.fleet();
  if (!fleet) return origins;
  for (const wire::FleetHost& each : fleet->hosts()) {
    const std::string& web = each.web();
    const bool is_page =
        (web.starts_with("http://") || web.starts_with("https://")) && web.ends_with('/');
    // What another host told of itself stands in a header: no more than an origin.
    const bool is_clean = web.find_first_of(" *;,'\"\\\r\n") == std::string::npos;
    if (each.name() != fleet->host() && is_page && is_clean) {
      origins.push_back(web.substr(0, web.size() - 1));
    }
  }
  return origins;
}

}  // namespace skerry::server
