// How a host and a port are written together.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace skerry {

// A host as it stands in a URL: an IPv6 address in brackets.  Source: RFC 3986, 3.2.2.
inline std::string bracketed(std::string_view host) {
  const bool is_v6 = host.find(':') != std::string_view::npos && !host.starts_with('[');
  std::string out = is_v6 ? "[" : "";
  out.append(host);
  if (is_v6) out += ']';
  return out;
}

// "192.0.2.7:7410", "[2001:db8::7]:7410", "ship.local:7410".
inline std::string host_and_port(std::string_view host, std::uint32_t port) {
  std::string out = bracketed(host);
  out += ':';
  out += std::to_string(port);
  return out;
}

}  // namespace skerry
