// BoardPlaceName: where a board is, as a program writes it.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "clients/common/client_error.hpp"

namespace skerry::client {

struct BoardPlaceName {
  bool shared_memory = false;
  std::string host;
  std::uint16_t port = kDefaultTcpPort;
  std::uint32_t radar = 0;
};

// "tcp://host:port/radar" or "shm://host:port/radar"; an IPv6 address stands in brackets; ":port"
// and "/radar" may be left out.
// Error: what is wrong with it and what is expected.
Result<BoardPlaceName, std::string> parse_board_place(std::string_view text);

}  // namespace skerry::client
