// The video of Furuno's networked radars (DRS, FAR): several packed sweeps a datagram.
// Source: furuno/README.md, furuno-drs4dnxt.pcap.gz.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/ipv4_endpoint.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::furuno {

inline constexpr Ipv4Endpoint kSpokeAddress{ipv4(239, 255, 0, 2), 10024};
// Broadcast: who is there, by name.
inline constexpr Ipv4Endpoint kBeaconAddress{ipv4(172, 31, 255, 255), 10010};

// Angles are clockwise from the bow.  Sweeps come at a fixed rate, so the angle from one to the
// next follows the antenna's speed: 12 to 14 at 46 turns a minute.
inline constexpr std::uint32_t kAnglesPerTurn = 8192;
inline constexpr std::size_t kFrameHeader = 16;
inline constexpr std::size_t kMaxCells = 2047;
inline constexpr std::size_t kMaxSweeps = 127;

struct Sweep {
  std::uint16_t angle = 0;    // of kAnglesPerTurn
  std::uint16_t heading = 0;  // the same; see SpokeFrame::has_heading
  std::vector<std::uint8_t> cells;
};
struct SpokeFrame {
  std::uint8_t counter = 0;  // +1 a datagram
  bool has_heading = false;  // as published; the recording's radar says no and sends one
  bool range_b = false;      // of a radar with two ranges
  std::uint32_t cells = 0;   // of each sweep
  std::uint32_t scale = 0;   // how many of them are the range
  // Nothing: no range of the published table.
  std::optional<double> range_m;
  std::vector<Sweep> sweeps;
};

// A frame may hold fewer sweeps than it says: the recording's first says 20 and has 19.

// Whether it begins like one, has the length it says, and its sweeps end where it does.  The whole
// datagram is walked.
bool is_spoke_frame(std::span<const std::uint8_t> datagram);
// Error: truncated, oversized, unknown_kind (no such frame), malformed (a sweep refers to one
// before the datagram, a scale of 0), out_of_range (an angle beyond a turn).
Result<SpokeFrame, WireError> decode_spoke_frame(std::span<const std::uint8_t> datagram);

// What a datagram to kBeaconAddress.port says of its sender: "DRS4D-NXT".  Nothing: it says none.
std::optional<std::string> decode_model(std::span<const std::uint8_t> datagram);

// The range of a table index, m; nothing for others.  In NM: whether a radar counts in kilometres
// its frames do not say.
std::optional<double> range_of_index(std::uint32_t index);

}  // namespace skerry::furuno
