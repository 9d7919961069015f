// Which pages of browsers are heard: pure decisions, no sockets.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace skerry::server {

// The host of a Host header or an origin's authority: lower case, without port and brackets.
// Empty if it is none.
std::string host_name(std::string_view authority);

// The Host headers that browsers may send.  A page of another site whose name was made to resolve
// to this server (DNS rebinding) still sends that name and is refused; an IP literal cannot be
// rebound.
struct HostPolicy {
  std::span<const std::string> allowed_hosts;
  bool any_ip_literal = false;  // as the server is bound to more than loopback
};

// Why a request with this Host header is refused, if it is.
std::optional<std::string> host_refusal(std::string_view host, const HostPolicy& policy);

// Why a WebSocket upgrade is refused, if it is.  No origin: the client is no browser.  Otherwise
// the page must have come from this server: WebSockets are exempt from the same-origin policy, so
// any page the user looks at could otherwise steer the own ship.
std::optional<std::string> origin_refusal(std::optional<std::string_view> origin,
                                          std::string_view host);

}  // namespace skerry::server
