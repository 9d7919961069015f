// Frames: the picture of a Navico radar, 32 spokes to a datagram.  Source: navico/README.md.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/navico/model.hpp"
#include "protocol/navico/spoke_range.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::navico {

inline constexpr std::size_t kFrameHeader = 8;
inline constexpr std::size_t kSpokeCells = 1024;
inline constexpr std::size_t kSpokeOctets = kSpokeHeader + kSpokeCells / 2;
inline constexpr std::size_t kFrameSpokes = 32;
inline constexpr std::size_t kFrameOctets = kFrameHeader + kFrameSpokes * kSpokeOctets;
static_assert(kFrameOctets == 17160);
inline constexpr std::uint32_t kTurnUnits = 4096;  // of angles and headings
inline constexpr std::uint32_t kTurnSpokes = 2048;

// Status of a spoke.
inline constexpr std::uint8_t kSpokeGood = 0x02;
inline constexpr std::uint8_t kSpokeAfterGap = 0x12;  // BR24, 3G: spokes are missing before it

struct SpokeFields {
  std::uint8_t status = kSpokeGood;
  std::uint16_t scan = 0;      // number of the spoke, modulo 4096; HALOs have used the upper bits
  std::uint16_t angle = 0;     // 0 .. 4095, clockwise from the bow
  std::uint16_t heading = 0;   // as it stands; heading_of() reads it
  std::uint16_t rotation = 0;  // octet 14: a counter that grows with the antenna's turning
  Length reach;
};
struct FrameSpoke {
  SpokeFields fields;
  std::array<std::uint8_t, kSpokeCells> cells;  // 0 .. 15, nearest first
};

// One datagram, 1 .. 32 spokes: a full frame has 32, and a HALO begins to transmit with one of a
// single spoke.
// Error: truncated, oversized or malformed.
Result<std::vector<FrameSpoke>, WireError> decode_frame(Model model,
                                                        std::span<const std::uint8_t> datagram);

// The bow's bearing as a spoke says it: 1/4096 of a turn with bit 0x4000 for true; without it
// magnetic; any other bit: there is none.
struct SpokeHeading {
  std::uint16_t units = 0;
  bool is_true = false;
};
std::optional<SpokeHeading> heading_of(std::uint16_t field);
std::uint16_t heading_field(TrueBearing heading);  // to the nearest 1/4096

// Appends the 8 octets before `spokes` spokes (1 .. 32).
void append_frame_header(Bytes& out, std::size_t spokes);

// Appends one spoke.  Of `fields`, `reach` is not looked at: `range` says it.  `nibbles` are two
// cells an octet, the low one nearer.
void append_spoke(Bytes& out, const SpokeFields& fields, const SpokeRange& range, Model model,
                  std::span<const std::uint8_t, kSpokeCells / 2> nibbles);

// Packs 1024 cells of 0..255 into nibbles: zero stays zero, and every other value is at least 1,
// 255 is 15: ceil(cell / 17).
void pack_cells(std::span<const std::uint8_t, kSpokeCells> cells,
                std::span<std::uint8_t, kSpokeCells / 2> nibbles);
// The same of cells that are 0..15 already.
void pack_nibbles(std::span<const std::uint8_t, kSpokeCells> cells,
                  std::span<std::uint8_t, kSpokeCells / 2> nibbles);

// Values that a HALO with Doppler on shows in place of a strength; strengths end below them.
inline constexpr std::uint8_t kApproaching = 0x0F, kReceding = 0x0E, kMostBesideDoppler = 0x0D;

}  // namespace skerry::navico
