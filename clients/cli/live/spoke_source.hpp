// SpokeSource: where `skerry dump` takes spokes from.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "clients/cli/command.hpp"
#include "clients/cli/live/spoke_line.hpp"
#include "clients/common/datagram_socket.hpp"

namespace skerry::client {

// One line, and the turn it belongs to.  Turns are counted as the source knows them: from bow to
// bow for the native protocol, from north to north for CAT240, which has no heading.
struct SourcedLine {
  SpokeLine line;
  std::uint32_t turn = 0;
  bool begins_turn = false;  // surely its first spoke
};

class SpokeSource {
 public:
  virtual ~SpokeSource() = default;
  // The next spoke; nothing if none came within `timeout`.
  virtual ClientResult<std::optional<SourcedLine>> next(Duration timeout) = 0;
  virtual std::string name() const = 0;
  virtual std::string advice() const = 0;  // what to try when nothing comes
  virtual std::uint64_t received() const = 0;
  virtual std::uint64_t lost() const = 0;
  virtual std::uint64_t refused() const = 0;  // datagrams that were not understood
};
using SpokeSourcePtr = std::unique_ptr<SpokeSource>;

ClientResult<SpokeSourcePtr> open_tcp_source(const ServerPlace& place, ViewChoice choice);
// All radars unless one is chosen.
ClientResult<SpokeSourcePtr> open_udp_source(const UdpAddress& where,
                                             std::optional<std::uint32_t> radar);
ClientResult<SpokeSourcePtr> open_cat240_source(const UdpAddress& where);

}  // namespace skerry::client
