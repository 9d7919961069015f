#include "server/relay/upstream_place.hpp"

#include <fmt/format.h>

#include <charconv>

#include "clients/common/client_socket.hpp"
#include "clients/common/message_stream.hpp"
#include "protocol/wire/host_and_port.hpp"
#include "protocol/wire/printable_text.hpp"
#include "server/relay/host_lookup.hpp"
#include "server/relay/radars_told.hpp"
#include "server/relay/waiting_room.hpp"

namespace skerry::server {
namespace {

constexpr std::string_view kByTls = "tls://";
constexpr std::chrono::milliseconds kBetweenTries{500};
constexpr std::chrono::seconds kBetweenLines{5}, kHelloPatience{3};

Failure<std::string> no_place(std::string_view text) {
  return Failure{fmt::format(
      "'{}' is no server; expected HOST:PORT or tls://HOST:PORT, such as 192.0.2.7:7410", text)};
}

// The others in a loop would wait for a server that has ended, and never know why.
void let_others_know(const std::function<bool(std::chrono::milliseconds)>& pause) {
  const auto until = std::chrono::steady_clock::now() + 4 * kBetweenTries;
  while (std::chrono::steady_clock::now() < until && !pause(kBetweenTries)) {
  }
}

}  // namespace

std::string UpstreamPlace::name() const { return host_and_port(client::HostName(host).name, port); }

Result<UpstreamPlace, std::string> upstream_place(std::string_view text) {
  const bool secure = text.starts_with(kByTls);
  const std::string_view rest = secure ? text.substr(kByTls.size()) : text;
  const std::size_t colon = rest.rfind(':');
  if (colon == std::string_view::npos || colon == 0) return no_place(text);
  std::string_view host = rest.substr(0, colon);
  const std::string_view digits = rest.substr(colon + 1);
  const bool bracketed = host.starts_with('[') && host.ends_with(']');
  if (bracketed) host = host.substr(1, host.size() - 2);
  if (host.empty() || (!bracketed && host.find(':') != std::string_view::npos) ||
      host.find('/') != std::string_view::npos) {
    return no_place(text);
  }
  unsigned port = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), port);
  if (error != std::errc{} || end != digits.data() + digits.size() || port == 0 || port > 65'535) {
    return no_place(text);
  }
  return UpstreamPlace{(secure ? std::string(kByTls) : std::string()) + std::string(host),
                       static_cast<std::uint16_t>(port)};
}

std::optional<wire::Hello> first_hello(const UpstreamPlace& place, Tries tries,
                                       const std::function<bool(std::chrono::milliseconds)>& pause,
                                       const std::function<void(const std::string&)>& tell,
                                       WaitingRoom* room) {
  std::optional<std::chrono::steady_clock::time_point> told;
  for (;;) {
    std::string why;
    // Opening looks the name up again, which nothing can end: not before it is known to be found.
    const auto found =
        find_host(client::HostName(place.host).name, place.port, kHelloPatience, pause);
    if (found.error == boost::asio::error::operation_aborted) return std::nullopt;
    if (found.error) {
      why = fmt::format("cannot connect to {}: {}", place.name(), printable(found.error.message()));
    } else {
      client::MessageStream stream(place.host, place.port);
      const auto hello = stream.open(place.host, place.port, kHelloPatience);
      const bool is_loop = hello && room != nullptr && is_in_loop(*hello, room->identity());
      if (hello && (room == nullptr || !is_waiting(*hello))) return *hello;
      if (is_loop) {
        room->set_before(&*hello);
        let_others_know(pause);
        return *hello;
      }
      if (room != nullptr) room->set_before(hello ? &*hello : nullptr);
      why = hello ? *why_not_relayed(*hello, room->identity(), place.name()) : hello.error().text;
    }
    const auto now = std::chrono::steady_clock::now();
    if (!told || now - *told >= kBetweenLines) {
      told = now;
      tell(why);
    }
    if (tries == Tries::one || pause(kBetweenTries)) return std::nullopt;
  }
}

}  // namespace skerry::server
