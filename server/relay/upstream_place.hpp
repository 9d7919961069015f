// Where the server is that is relayed, and the wait for it.
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

class WaitingRoom;

struct UpstreamPlace {
  std::string host;  // "192.0.2.7", "tls://bridge"; empty: none
  std::uint16_t port = 0;

  std::string name() const;  // "192.0.2.7:7410"
};

// "HOST:PORT", "[2001:db8::7]:7410", "tls://HOST:PORT".
// Error: what is wrong with it, and what was expected.
Result<UpstreamPlace, std::string> upstream_place(std::string_view text);

// Its Hello, for which this waits.  `pause` waits so long, or less, and is true if it is to be
// given up, which it then is at once, whatever name servers do; `tell` gets a line every few
// seconds.  `room`, if there is one: where this server says meanwhile that it waits.  A Hello of a
// server that waits itself is no answer, and is told there; but where it shows a loop, or without a
// room, it is returned: why_not_relayed() then says what it means.
enum class Tries : std::uint8_t { one, until_it_is_there };
std::optional<wire::Hello> first_hello(const UpstreamPlace& place, Tries tries,
                                       const std::function<bool(std::chrono::milliseconds)>& pause,
                                       const std::function<void(const std::string&)>& tell,
                                       WaitingRoom* room = nullptr);

}  // namespace skerry::server
