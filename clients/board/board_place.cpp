#include "clients/board/board_place.hpp"

#include <fmt/format.h>

#include <charconv>
#include <optional>

#include "protocol/wire/printable_text.hpp"

namespace skerry::client {
namespace {

constexpr std::size_t kLongestHost = 253;

std::optional<std::uint32_t> parse_number(std::string_view text, std::uint32_t most) {
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || value > most) return std::nullopt;
  return value;
}

}  // namespace

Result<BoardPlaceName, std::string> parse_board_place(std::string_view text) {
  const auto wrong = [&](const char* what) {
    return Failure{fmt::format("'{}': {}; expected tcp://host:port/radar or shm://host:port/radar",
                               printable(text, 100), what)};
  };
  BoardPlaceName place;
  if (text.starts_with("shm://")) {
    place.shared_memory = true;
  } else if (!text.starts_with("tcp://")) {
    return wrong("begins with neither tcp:// nor shm://");
  }
  std::string_view rest = text.substr(6);
  if (const auto slash = rest.find('/'); slash != std::string_view::npos) {
    const auto radar = parse_number(rest.substr(slash + 1), 65535);
    if (!radar) return wrong("the radar is no number up to 65535");
    place.radar = *radar;
    rest = rest.substr(0, slash);
  }
  std::string_view host = rest, port;
  if (rest.starts_with('[')) {
    const auto end = rest.find(']');
    if (end == std::string_view::npos) return wrong("a bracket is not closed");
    host = rest.substr(1, end - 1);
    port = rest.substr(end + 1);
  } else if (const auto colon = rest.find(':'); colon != std::string_view::npos) {
    host = rest.substr(0, colon);
    port = rest.substr(colon);
  }
  if (host.empty() || host.size() > kLongestHost) return wrong("it names no host");
  if (host.find('\0') != std::string_view::npos) return wrong("it names no host");
  if (!port.empty()) {
    const auto number = port.front() == ':' ? parse_number(port.substr(1), 65535) : std::nullopt;
    if (!number || *number == 0) return wrong("the port is no number from 1 to 65535");
    place.port = static_cast<std::uint16_t>(*number);
  }
  place.host = std::string(host);
  return place;
}

}  // namespace skerry::client
