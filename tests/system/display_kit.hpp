// The screen of a radar display, and whether it shows the server's own picture.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/video/scan.hpp"
#include "tests/unit/net/display_socket.hpp"

namespace skerry::system_test {

using server::DisplaySocket;

// Little-endian numbers of a datagram, as the protocol pages give them.  Error: std::out_of_range.
std::uint32_t u16(const Bytes& bytes, std::size_t at);
std::uint32_t u32(const Bytes& bytes, std::size_t at);
Bytes hex(const std::string& text);  // "03C1 16120000"

// One spoke on the screen.
struct SeenSpoke {
  double turn = 0.0;                // clockwise from the bow, [0, 1)
  double reach_m = 0.0;             // where the last cell ends
  std::vector<std::uint8_t> cells;  // 0..255
};

// The next datagram that `reads` makes something of, from that address; others are passed over.
// Error: std::runtime_error with `what` if none comes for a minute.
Bytes await_datagram(DisplaySocket& socket, std::uint32_t from, const std::string& what,
                     const std::function<bool(const Bytes&)>& reads);

// How many of the strong cells that a display sees within the server's range scale (three quarters
// of full scale and more) are echoes of at least half that strength on the server's own picture,
// within one of its spokes and two of its cells: how many there are, and the share confirmed.
struct Likeness {
  std::size_t strong = 0;
  double confirmed = 0.0;
};
Likeness compare(const std::vector<SeenSpoke>& seen, const Scan& own);

}  // namespace skerry::system_test
