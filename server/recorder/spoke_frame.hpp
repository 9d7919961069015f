// The spokes in a ring's bytes, without decoding their cells.
#pragma once

#include <cstdint>
#include <optional>
#include <span>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

struct FramedSpoke {
  std::span<const std::uint8_t> bytes;  // the wire::Spoke alone
  std::uint64_t sequence = 0;
  UtcTime utc{};
  ScenarioTime scenario{};
};

// Reads one frame of a ServerMessage that holds a spoke, as append_spoke_frame() makes it; nullopt
// if it is something else.
std::optional<FramedSpoke> framed_spoke(std::span<const std::uint8_t> frame);

}  // namespace skerry::server
