// Ipv4Endpoint: an IPv4 address and a port, as numbers.
#pragma once

#include <charconv>
#include <compare>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

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

// The endpoint that a text is, as text_of() writes it; nothing if it is none.
inline std::optional<Ipv4Endpoint> ipv4_endpoint(std::string_view text) {
  Ipv4Endpoint out;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (const char then : {'.', '.', '.', ':', '\0'}) {
    unsigned value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    const bool closed = then == '\0' ? next == end : next != end && *next == then;
    if (error != std::errc{} || value > (then == '\0' ? 65'535u : 255u) || !closed) {
      return std::nullopt;
    }
    if (then == '\0') {
      out.port = static_cast<std::uint16_t>(value);
    } else {
      out.address = out.address << 8 | value;
      at = next + 1;
    }
  }
  return out;
}

}  // namespace skerry
