// Ipv4Endpoint: an IPv4 address and a port, as numbers.
#pragma once

#include <compare>
#include <cstdint>
#include <string>

namespace skerry {

// Both in host order: 236.6.7.8 is 0xEC060708.
struct Ipv4Endpoint {
  std::uint32_t address = 0;
  std::uint16_t port = 0;
  friend constexpr auto operator<=>(const Ipv4Endpoint&, const Ipv4Endpoint&) = default;

  constexpr bool is_multicast() const { return address >> 28 == 0xE; }
};

constexpr std::uint32_t ipv4(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t d) {
  return a << 24 | b << 16 | c << 8 | d;
}

// "236.6.7.8:6678".
inline std::string text_of(const Ipv4Endpoint& endpoint) {
  std::string text;
  for (int shift = 24; shift >= 0; shift -= 8) {
    text += std::to_string(endpoint.address >> shift & 0xFF);
    text += shift > 0 ? '.' : ':';
  }
  return text + std::to_string(endpoint.port);
}

}  // namespace skerry
