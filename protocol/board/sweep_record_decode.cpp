#include <fmt/format.h>

#include <bit>
#include <string>
#include <utility>

#include "protocol/board/record_layout.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::board {
namespace {

// One record's bytes, all of them there; the first thing wrong with it is kept.
class Fields {
 public:
  explicit Fields(std::span<const std::uint8_t> bytes) : bytes_(bytes) {}

  template <std::unsigned_integral T>
  T get(std::size_t offset) const {
    return little_endian_at<T>(bytes_, offset);
  }
  std::uint32_t u32(std::size_t offset) const { return get<std::uint32_t>(offset); }
  std::uint64_t u64(std::size_t offset) const { return get<std::uint64_t>(offset); }
  std::span<const std::uint8_t> part(std::size_t offset, std::size_t count) const {
    return bytes_.subspan(offset, count);
  }

  void fail(WireErrorKind kind, std::size_t offset, std::string text) {
    if (!error_) error_ = WireError{kind, offset, std::move(text)};
  }
  template <std::unsigned_integral T>
  T in_range(std::size_t offset, T min, T max, const char* what) {
    const T value = get<T>(offset);
    if (value < min || value > max) {
      fail(WireErrorKind::out_of_range, offset,
           fmt::format("{} is {}, expected {} .. {}", what, value, min, max));
    }
    return value;
  }

  const std::optional<WireError>& error() const { return error_; }

 private:
  std::span<const std::uint8_t> bytes_;
  std::optional<WireError> error_;
};

ChannelFormat read_channel(Fields& in, std::size_t at) {
  using namespace layout::sweep;
  ChannelFormat format;
  format.samples = in.in_range<std::uint32_t>(at + kSamples, 0, kMaxSamples, "samples");
  format.decimation = in.in_range<std::uint32_t>(at + kDecimation, 1, 65'536, "decimation");
  format.bits = in.in_range<std::uint8_t>(at + kBits, 8, 14, "bits");
  if (format.bits % 2 != 0) {
    in.fail(WireErrorKind::out_of_range, at + kBits,
            fmt::format("bits is {}, expected 8, 10, 12 or 14", format.bits));
  }
  format.mode =
      static_cast<DecimationMode>(in.in_range<std::uint8_t>(at + kMode, 0, 2, "decimation mode"));
  format.detector =
      static_cast<Detector>(in.in_range<std::uint8_t>(at + kDetector, 0, 1, "detector"));
  format.inverted = in.in_range<std::uint8_t>(at + kInverted, 0, 1, "inverted") != 0;
  return format;
}

SweepMeta read_meta(Fields& in) {
  using namespace layout::sweep;
  SweepMeta meta;
  meta.radar = in.u32(layout::kRadar);
  meta.faults = in.u32(layout::kFaults);
  meta.trigger_count = in.u64(kTriggerCount);
  meta.trigger_tick = in.u64(kTriggerTick);
  meta.utc_ns = in.u64(kUtcNs);
  meta.sample_clock_hz = in.in_range<std::uint32_t>(kSampleClock, 1, 2'000'000'000, "sample clock");
  meta.acp_count = in.u32(kAcpCount);
  meta.ticks_since_acp = in.u32(kTicksSinceAcp);
  meta.acp_period = in.u32(kAcpPeriod);
  meta.acp_per_turn = in.in_range<std::uint32_t>(kAcpPerTurn, 1, 65'536, "ACPs per turn");
  meta.turn_ticks = in.u32(kTurnTicks);
  meta.arp_ticks = in.u32(kArpTicks);
  meta.arp_count = in.u32(kArpCount);
  meta.delay_ticks = in.u32(kDelayTicks);
  meta.pulse_ns = in.u32(kPulseNs);
  meta.prf_millihertz = in.u32(kPrf);
  meta.pulses = in.in_range<std::uint32_t>(kPulses, 1, 65'535, "pulses");
  meta.spokes_per_turn = in.in_range<std::uint32_t>(kSpokesPerTurn, 0, 65'536, "spokes per turn");
  meta.spoke = in.u32(kSpoke);
  if (meta.spoke != 0 && meta.spoke >= meta.spokes_per_turn) {
    in.fail(WireErrorKind::out_of_range, kSpoke,
            fmt::format("spoke is {}, expected less than {}", meta.spoke, meta.spokes_per_turn));
  }
  for (std::size_t c = 0; c < 2; ++c) {
    meta.channels[c] = read_channel(in, kChannel + c * kChannelBytes);
  }
  return meta;
}

// Requires that the channel's samples lie in the record.
void read_samples(Fields& in, const ChannelFormat& format, std::size_t at,
                  std::vector<std::uint16_t>& samples) {
  samples.resize(format.samples);
  read_little_endian(in.part(at, 2 * samples.size()), samples);
  if (format.mode == DecimationMode::sum) return;
  std::uint32_t any = 0;
  for (const std::uint16_t sample : samples) any |= sample;
  if (any >> format.bits != 0) {
    in.fail(WireErrorKind::out_of_range, at,
            fmt::format("a sample needs {} bits, expected {}", std::bit_width(any), format.bits));
  }
}

Sweep read_sweep(Fields& in, std::size_t size) {
  Sweep sweep;
  sweep.meta = read_meta(in);
  if (in.error()) return sweep;
  std::array<std::size_t, 2> offsets;
  std::size_t end = kSweepHeader;
  for (std::size_t c = 0; c < 2; ++c) {
    offsets[c] = end;
    end += layout::padded(2 * std::size_t{sweep.meta.channels[c].samples});
    const std::size_t at =
        layout::sweep::kChannel + c * layout::sweep::kChannelBytes + layout::sweep::kOffset;
    const std::size_t expected = sweep.meta.channels[c].samples == 0 ? 0 : offsets[c];
    if (in.u32(at) != expected) {
      in.fail(WireErrorKind::malformed, at,
              fmt::format("samples begin at {}, expected {}", in.u32(at), expected));
    }
  }
  if (end != size) {
    in.fail(WireErrorKind::malformed, layout::kSize,
            fmt::format("size is {}, expected {} for these samples", size, end));
  }
  if (in.error()) return sweep;
  for (std::size_t c = 0; c < 2; ++c) {
    read_samples(in, sweep.meta.channels[c], offsets[c], sweep.samples[c]);
  }
  return sweep;
}

Edges read_edges(Fields& in, std::size_t size) {
  using namespace layout::edges;
  Edges edges;
  edges.radar = in.u32(layout::kRadar);
  edges.sample_clock_hz =
      in.in_range<std::uint32_t>(kSampleClock, 1, 2'000'000'000, "sample clock");
  edges.from_tick = in.u64(kFromTick);
  edges.to_tick = in.u64(kToTick);
  if (edges.to_tick < edges.from_tick) {
    in.fail(WireErrorKind::out_of_range, kToTick,
            fmt::format("ends at tick {}, before it begins at {}", edges.to_tick, edges.from_tick));
  }
  const std::uint32_t count = in.in_range<std::uint32_t>(kCount, 0, kMaxEdges, "edges");
  const std::size_t expected = layout::padded(kEdgesHeader + count * kEdgeBytes);
  if (!in.error() && expected != size) {
    in.fail(WireErrorKind::malformed, layout::kSize,
            fmt::format("size is {}, expected {} for {} edges", size, expected, count));
  }
  if (in.error()) return edges;
  edges.edges.reserve(count);
  std::uint64_t earliest = edges.from_tick;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::size_t at = kEdgesHeader + i * kEdgeBytes;
    const std::uint64_t tick = in.u64(at + kTick);
    const std::uint8_t line = in.in_range<std::uint8_t>(at + kLine, 0, 3, "line");
    if (tick < earliest || tick >= edges.to_tick) {
      in.fail(WireErrorKind::out_of_range, at + kTick,
              fmt::format("edge at tick {}, expected {} or later and before {}", tick, earliest,
                          edges.to_tick));
    }
    if (in.error()) return edges;
    earliest = tick;
    edges.edges.push_back({tick, static_cast<Line>(line)});
  }
  return edges;
}

Event read_event(Fields& in, std::size_t size) {
  using namespace layout::event;
  Event event;
  event.radar = in.u32(layout::kRadar);
  event.faults = in.u32(layout::kFaults);
  event.tick = in.u64(kTick);
  event.event = in.u32(kEvent);
  event.value = in.u32(kValue);
  if (!std::has_single_bit(event.event)) {
    in.fail(WireErrorKind::out_of_range, kEvent,
            fmt::format("event is {:#x}, expected one bit", event.event));
  }
  if (size != kEventBytes) {
    in.fail(WireErrorKind::malformed, layout::kSize,
            fmt::format("size is {}, expected {}", size, kEventBytes));
  }
  return event;
}

}  // namespace

std::optional<RecordPrefix> record_prefix(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kRecordAlignment) return std::nullopt;
  RecordPrefix prefix;
  prefix.size = little_endian_at<std::uint32_t>(bytes, layout::kSize);
  prefix.kind = bytes[layout::kKind];
  prefix.sequence = little_endian_at<std::uint64_t>(bytes, layout::kSequence);
  const bool possible = prefix.size >= kRecordAlignment && prefix.size <= kMaxRecordBytes &&
                        prefix.size % kRecordAlignment == 0;
  return possible ? std::optional(prefix) : std::nullopt;
}

Result<DecodedRecord, WireError> decode_record(std::span<const std::uint8_t> bytes) {
  if (bytes.size() < kRecordAlignment) {
    return failure(
        WireErrorKind::truncated, bytes.size(),
        fmt::format("{} bytes, a record has at least {}", bytes.size(), kRecordAlignment));
  }
  const std::size_t size = little_endian_at<std::uint32_t>(bytes, layout::kSize);
  if (size > kMaxRecordBytes) {
    return failure(WireErrorKind::oversized, layout::kSize,
                   fmt::format("size is {}, at most {}", size, kMaxRecordBytes));
  }
  if (size < kRecordAlignment || size % kRecordAlignment != 0) {
    return failure(WireErrorKind::malformed, layout::kSize,
                   fmt::format("size is {}, expected a multiple of {}", size, kRecordAlignment));
  }
  if (size > bytes.size()) {
    return failure(WireErrorKind::truncated, bytes.size(),
                   fmt::format("{} bytes of a record of {}", bytes.size(), size));
  }
  const auto kind = static_cast<RecordKind>(bytes[layout::kKind]);
  std::size_t header = kRecordAlignment;
  switch (kind) {
    case RecordKind::sweep:
      header = kSweepHeader;
      break;
    case RecordKind::edges:
    case RecordKind::event:
      break;
    default:
      return failure(WireErrorKind::unknown_kind, layout::kKind,
                     fmt::format("kind {}", bytes[layout::kKind]));
  }
  if (bytes[layout::kFormat] != layout::kVersion) {
    return failure(WireErrorKind::out_of_range, layout::kFormat,
                   fmt::format("format {}, expected {}", bytes[layout::kFormat], layout::kVersion));
  }
  const std::size_t stated = little_endian_at<std::uint16_t>(bytes, layout::kHeader);
  if (stated != header || size < header) {
    return failure(WireErrorKind::malformed, layout::kHeader,
                   fmt::format("header of {} bytes in {}, expected {}", stated, size, header));
  }

  Fields in(bytes.first(size));
  DecodedRecord decoded;
  decoded.sequence = in.u64(layout::kSequence);
  decoded.size = size;
  if (kind == RecordKind::sweep) decoded.record = read_sweep(in, size);
  if (kind == RecordKind::edges) decoded.record = read_edges(in, size);
  if (kind == RecordKind::event) decoded.record = read_event(in, size);
  if (in.error()) return Failure{*in.error()};
  return decoded;
}

}  // namespace skerry::board
