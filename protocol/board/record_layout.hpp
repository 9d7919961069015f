// Offsets of the fields of records; BOARD.md has the same table.
#pragma once

#include <cstddef>
#include <cstdint>

namespace skerry::board::layout {

inline constexpr std::uint8_t kVersion = 1;

// Offsets in every record.
inline constexpr std::size_t kSize = 0;      // u32, whole record
inline constexpr std::size_t kKind = 4;      // u8
inline constexpr std::size_t kFormat = 5;    // u8, kVersion
inline constexpr std::size_t kHeader = 6;    // u16, bytes before samples or edges
inline constexpr std::size_t kSequence = 8;  // u64
inline constexpr std::size_t kRadar = 16;    // u32
inline constexpr std::size_t kFaults = 20;   // u32; 0 in edges

namespace sweep {
inline constexpr std::size_t kTriggerCount = 24;  // u64
inline constexpr std::size_t kTriggerTick = 32;   // u64
inline constexpr std::size_t kUtcNs = 40;         // u64
inline constexpr std::size_t kSampleClock = 48;   // u32 from here on
inline constexpr std::size_t kAcpCount = 52;
inline constexpr std::size_t kTicksSinceAcp = 56;
inline constexpr std::size_t kAcpPeriod = 60;
inline constexpr std::size_t kAcpPerTurn = 64;
inline constexpr std::size_t kArpTicks = 68;
inline constexpr std::size_t kArpCount = 72;
inline constexpr std::size_t kDelayTicks = 76;
inline constexpr std::size_t kPulseNs = 80;
inline constexpr std::size_t kPrf = 84;
inline constexpr std::size_t kPulses = 88;
inline constexpr std::size_t kSpoke = 92;
inline constexpr std::size_t kSpokesPerTurn = 96;
inline constexpr std::size_t kTurnTicks = 100;
inline constexpr std::size_t kChannel = 128;  // A; B follows
inline constexpr std::size_t kChannelBytes = 32;
// In a channel.
inline constexpr std::size_t kSamples = 0;     // u32
inline constexpr std::size_t kDecimation = 4;  // u32
inline constexpr std::size_t kOffset = 8;      // u32, of the first sample in the record; 0: none
inline constexpr std::size_t kBits = 12;       // u8 from here on
inline constexpr std::size_t kMode = 13;
inline constexpr std::size_t kDetector = 14;
inline constexpr std::size_t kInverted = 15;
}  // namespace sweep

namespace edges {
inline constexpr std::size_t kFromTick = 24;     // u64
inline constexpr std::size_t kToTick = 32;       // u64
inline constexpr std::size_t kSampleClock = 40;  // u32
inline constexpr std::size_t kCount = 44;        // u32
inline constexpr std::size_t kEdgeBytes = 16;    // each
inline constexpr std::size_t kTick = 0;          // u64
inline constexpr std::size_t kLine = 8;          // u8
}  // namespace edges

namespace event {
inline constexpr std::size_t kTick = 24;   // u64
inline constexpr std::size_t kEvent = 32;  // u32
inline constexpr std::size_t kValue = 36;  // u32
}  // namespace event

constexpr std::size_t padded(std::size_t bytes) { return (bytes + 63) / 64 * 64; }

}  // namespace skerry::board::layout
