// Records of the interface board: sweeps, edges of its digital signals, and events, as bytes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "protocol/board/registers.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::board {

// The same bytes in the TCP stream, in datagrams and in shared memory (BOARD.md has the table):
// little-endian, a multiple of 64 bytes, header first.
inline constexpr std::size_t kRecordAlignment = 64;
inline constexpr std::uint32_t kMaxSamples = 16384;  // of a channel
inline constexpr std::size_t kSweepHeader = 192, kEdgesHeader = 64, kEventBytes = 64;
// A sweep of two channels of kMaxSamples, 16 bits each.
inline constexpr std::size_t kMaxRecordBytes = kSweepHeader + 2 * 2 * kMaxSamples;
enum class RecordKind : std::uint8_t { sweep = 1, edges = 2, event = 3, filler = 255 };

struct ChannelFormat {
  std::uint32_t samples = 0;  // 0: the channel is off
  std::uint32_t decimation = 1;
  std::uint8_t bits = 8;  // of the converter; values have up to 16 after a sum
  DecimationMode mode = DecimationMode::peak;
  Detector detector = Detector::log;
  bool inverted = false;
  friend bool operator==(const ChannelFormat&, const ChannelFormat&) = default;
};

// The largest value of a sample, 1 .. 65535: the converter's, or what a sum of them comes to.
std::uint32_t largest_code(const ChannelFormat& format);
// The value of a sample without any video: 0, inverted the largest.
std::uint16_t blank_code(const ChannelFormat& format);

// Values that the board latched at the trigger.
struct SweepMeta {
  std::uint32_t radar = 0;
  std::uint64_t trigger_count = 0;
  std::uint64_t trigger_tick = 0;  // of the sample clock, from scenario time 0
  std::uint32_t sample_clock_hz = 0;
  std::uint32_t acp_count = 0;        // since the last ARP
  std::uint32_t ticks_since_acp = 0;  // from the last ACP to the trigger
  std::uint32_t acp_period = 0;       // ticks between the last two ACPs
  std::uint32_t acp_per_turn = 0;     // as configured
  std::uint32_t turn_ticks = 0;  // between the last two ARPs; 0: that turn had not all its ACPs
  std::uint32_t arp_ticks = 0;   // from the ACP before the last ARP to that ARP
  std::uint32_t arp_count = 0;
  std::uint64_t utc_ns = 0;
  std::uint32_t delay_ticks = 0;  // from the trigger (range zero) to the first sample
  std::uint32_t pulse_ns = 0;
  std::uint32_t prf_millihertz = 0;
  std::uint32_t faults = 0;           // FaultBit at that trigger
  std::uint32_t pulses = 1;           // integrated into this record
  std::uint32_t spoke = 0;            // of a formed spoke: index in the turn
  std::uint32_t spokes_per_turn = 0;  // 0: a sweep of one trigger
  std::array<ChannelFormat, 2> channels;
  friend bool operator==(const SweepMeta&, const SweepMeta&) = default;
};

// Turns clockwise from the ARP, in [0, 1): (ACPs + fraction - fraction at the ARP) / ACPs per turn.
// 0 where no ACP has been seen twice.  A fraction is at most 1: an antenna that stands still does
// not turn on.  Source: BOARD.md "Sources", timing arithmetic.
// Bound: an ACP stands for the tick nearest to it, so at constant speed, with the ARP on an ACP,
// the azimuth is off by half a tick of turning at most, and half a tick more with an ARP between
// two (tests SweepAzimuth, BoardAzimuth).
double azimuth_turns(const SweepMeta& meta);
// Ticks of an ACP: the mean of the last turn, unless the last period, which counts whole ticks, is
// more than one off it, as where the antenna does not turn evenly.
double acp_ticks(const SweepMeta& meta);
// Metres to the middle of sample i of a channel.
double sample_range_m(const SweepMeta& meta, std::size_t channel, std::uint32_t i);

struct Sweep {
  SweepMeta meta;
  std::array<std::vector<std::uint16_t>, 2> samples;  // of channels A and B
  friend bool operator==(const Sweep&, const Sweep&) = default;
};

enum class Line : std::uint8_t { trigger = 0, acp = 1, arp = 2, heading = 3 };

// Rising edges of the digital signals, in order of time; their pulses last kPulseTicks.
struct Edge {
  std::uint64_t tick = 0;
  Line line = Line::trigger;
  friend bool operator==(const Edge&, const Edge&) = default;
};
struct Edges {
  std::uint32_t radar = 0;
  std::uint32_t sample_clock_hz = 0;
  std::uint64_t from_tick = 0, to_tick = 0;  // all edges in [from, to) are in it
  std::vector<Edge> edges;                   // at most kMaxEdges
  friend bool operator==(const Edges&, const Edges&) = default;
};
inline constexpr std::size_t kMaxEdges = 4096;

struct Event {
  std::uint32_t radar = 0;
  std::uint64_t tick = 0;
  std::uint32_t event = 0;   // one EventBit
  std::uint32_t faults = 0;  // FaultBit raised or cleared
  std::uint32_t value = 0;   // by event: ARP count, ACPs of the turn
  friend bool operator==(const Event&, const Event&) = default;
};

using Record = std::variant<Sweep, Edges, Event>;

// `sequence`: +1 for every record of a board; a gap is a loss.
// Takes the numbers of samples from `samples`, at most kMaxSamples each; writes the first kMaxEdges
// edges.
void append_record(Bytes& out, std::uint64_t sequence, const Sweep& sweep);
void append_record(Bytes& out, std::uint64_t sequence, const Edges& edges);
void append_record(Bytes& out, std::uint64_t sequence, const Event& event);

struct DecodedRecord {
  std::uint64_t sequence = 0;
  std::size_t size = 0;  // bytes it took
  Record record;
};
// The begin of every record.  nullopt if `bytes` are too few for it, or no record can have that
// size; the kind may be one that does not exist yet.
struct RecordPrefix {
  std::size_t size = 0;
  std::uint8_t kind = 0;
  std::uint64_t sequence = 0;
};
std::optional<RecordPrefix> record_prefix(std::span<const std::uint8_t> bytes);

// The first record of `bytes`.  Nothing in it is believed unchecked.
// Error: truncated, malformed, oversized, out_of_range, unknown_kind, with the offset.
Result<DecodedRecord, WireError> decode_record(std::span<const std::uint8_t> bytes);

}  // namespace skerry::board
