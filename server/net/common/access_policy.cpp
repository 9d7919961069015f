#include "server/net/common/access_policy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "server/net/common/asio.hpp"
#include "server/net/common/tcp_peer.hpp"

namespace skerry::server {
namespace {

std::string lower(std::string_view text) {
  std::string out(text);
  std::transform(out.begin(), out.end(), out.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return out;
}

// Takes as long for a nearly right token as for a wrong one.
bool equal_in_constant_time(std::string_view a, std::string_view b) {
  unsigned difference = a.size() == b.size() ? 0 : 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const char other = b.empty() ? '\0' : b[i % b.size()];
    difference |= static_cast<unsigned char>(a[i]) ^ static_cast<unsigned char>(other);
  }
  return difference == 0;
}

// Text from outside, fit for a reply or a log line.
std::string printable(std::string_view text) {
  std::string out(text.substr(0, 100));
  std::replace_if(
      out.begin(), out.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return out;
}

}  // namespace

std::optional<std::string> control_refusal(bool peer_is_loopback, std::string_view token,
                                           std::string_view control_token) {
  if (peer_is_loopback) return std::nullopt;
  if (control_token.empty()) {
    return "control is only accepted from the server's own host; to allow it from elsewhere, start "
           "the server with a control token and put that in Set.token";
  }
  if (token.empty())
    return "control from another host needs the server's control token in Set.token";
  if (!equal_in_constant_time(token, control_token)) {
    return "Set.token is not the server's control token";
  }
  return std::nullopt;
}

std::string host_name(std::string_view authority) {
  if (authority.starts_with('[')) {
    const auto end = authority.find(']');
    if (end == std::string_view::npos) return {};
    const auto rest = authority.substr(end + 1);
    if (!rest.empty() && rest.front() != ':') return {};
    return lower(authority.substr(1, end - 1));
  }
  const auto colon = authority.find(':');
  if (colon != std::string_view::npos && authority.find(':', colon + 1) != std::string_view::npos) {
    return {};
  }
  return lower(authority.substr(0, colon));
}

std::optional<std::string> host_refusal(std::string_view host, const HostPolicy& policy) {
  const std::string name = host_name(host);
  if (name == "localhost") return std::nullopt;
  error_code error;
  const auto address = asio::ip::make_address(name, error);
  if (!error && (policy.any_ip_literal || is_loopback(address))) return std::nullopt;
  const auto same_name = [&name](const std::string& allowed) { return lower(allowed) == name; };
  if (!name.empty() &&
      std::any_of(policy.allowed_hosts.begin(), policy.allowed_hosts.end(), same_name)) {
    return std::nullopt;
  }
  return fmt::format(
      "Host '{}' is not a name of this server; use localhost, or add the name to "
      "the allowed hosts",
      printable(host));
}

std::optional<std::string> origin_refusal(std::optional<std::string_view> origin,
                                          std::string_view host) {
  if (!origin) return std::nullopt;
  const std::string from = lower(*origin);
  const std::string here = lower(host);
  // Some clients say the scheme of the WebSocket itself.
  for (const char* scheme : {"http://", "https://", "ws://", "wss://"}) {
    if (from == scheme + here) return std::nullopt;
  }
  return fmt::format("a page from '{}' may not connect to '{}'; open the console from this server",
                     printable(*origin), printable(host));
}

}  // namespace skerry::server
