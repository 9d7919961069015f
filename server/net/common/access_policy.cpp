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

// Text from outside, fit for a reply or a log line.
std::string printable(std::string_view text) {
  std::string out(text.substr(0, 100));
  std::replace_if(
      out.begin(), out.end(), [](unsigned char c) { return c < 0x20 || c > 0x7e; }, '?');
  return out;
}

}  // namespace

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
