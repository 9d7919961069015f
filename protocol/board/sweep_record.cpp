#include "protocol/board/sweep_record.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/board/record_layout.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry::board {
namespace {

// m/s, exact.
constexpr double kLightSpeed = 299'792'458.0;

template <std::size_t kBytes>
class Header {
 public:
  Header(RecordKind kind, std::size_t size, std::uint64_t sequence, std::uint32_t radar) {
    put(layout::kSize, static_cast<std::uint32_t>(size));
    put(layout::kKind, static_cast<std::uint8_t>(kind));
    put(layout::kFormat, layout::kVersion);
    put(layout::kHeader, static_cast<std::uint16_t>(kBytes));
    put(layout::kSequence, sequence);
    put(layout::kRadar, radar);
  }
  template <std::unsigned_integral T>
  void put(std::size_t offset, T value) {
    put_little_endian(bytes_, offset, value, sizeof(T));
  }
  void append_to(Bytes& out) const { out.insert(out.end(), bytes_.begin(), bytes_.end()); }

 private:
  std::array<std::uint8_t, kBytes> bytes_ = {};
};

void pad(Bytes& out, std::size_t begin) {
  out.resize(begin + layout::padded(out.size() - begin), 0);
}

}  // namespace

std::uint32_t largest_code(const ChannelFormat& format) {
  const std::uint64_t converter = (std::uint64_t{1} << std::min<unsigned>(format.bits, 16)) - 1;
  const std::uint64_t added = format.mode == DecimationMode::sum ? format.decimation : 1;
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(converter * added, 1, 65'535));
}

std::uint16_t blank_code(const ChannelFormat& format) {
  return format.inverted ? static_cast<std::uint16_t>(largest_code(format)) : std::uint16_t{0};
}

double acp_ticks(const SweepMeta& meta) {
  const double last = meta.acp_period;
  if (meta.turn_ticks == 0 || meta.acp_per_turn == 0) return last;
  const double mean = static_cast<double>(meta.turn_ticks) / meta.acp_per_turn;
  return std::fabs(mean - last) <= 1.0 ? mean : last;
}

double azimuth_turns(const SweepMeta& meta) {
  if (meta.acp_period == 0 || meta.acp_per_turn == 0) return 0.0;
  const double period = acp_ticks(meta);
  const auto fraction = [&](std::uint32_t ticks) { return std::min(ticks / period, 1.0); };
  const double acps = meta.acp_count + (fraction(meta.ticks_since_acp) - fraction(meta.arp_ticks));
  const double turns = acps / meta.acp_per_turn;
  const double wrapped = turns - std::floor(turns);
  return wrapped < 1.0 ? wrapped : 0.0;
}

double sample_range_m(const SweepMeta& meta, std::size_t channel, std::uint32_t i) {
  if (meta.sample_clock_hz == 0) return 0.0;
  const double ticks = meta.delay_ticks + (i + 0.5) * meta.channels[channel].decimation;
  return 0.5 * kLightSpeed * ticks / meta.sample_clock_hz;
}

void append_record(Bytes& out, std::uint64_t sequence, const Sweep& sweep) {
  using namespace layout::sweep;
  const SweepMeta& meta = sweep.meta;
  std::array<std::size_t, 2> counts, offsets;
  std::size_t size = kSweepHeader;
  for (std::size_t c = 0; c < 2; ++c) {
    counts[c] = std::min<std::size_t>(sweep.samples[c].size(), kMaxSamples);
    offsets[c] = counts[c] == 0 ? 0 : size;
    size += layout::padded(2 * counts[c]);
  }

  Header<kSweepHeader> header(RecordKind::sweep, size, sequence, meta.radar);
  header.put(layout::kFaults, meta.faults);
  header.put(kTriggerCount, meta.trigger_count);
  header.put(kTriggerTick, meta.trigger_tick);
  header.put(kUtcNs, meta.utc_ns);
  header.put(kSampleClock, meta.sample_clock_hz);
  header.put(kAcpCount, meta.acp_count);
  header.put(kTicksSinceAcp, meta.ticks_since_acp);
  header.put(kAcpPeriod, meta.acp_period);
  header.put(kAcpPerTurn, meta.acp_per_turn);
  header.put(kTurnTicks, meta.turn_ticks);
  header.put(kArpTicks, meta.arp_ticks);
  header.put(kArpCount, meta.arp_count);
  header.put(kDelayTicks, meta.delay_ticks);
  header.put(kPulseNs, meta.pulse_ns);
  header.put(kPrf, meta.prf_millihertz);
  header.put(kPulses, meta.pulses);
  header.put(kSpoke, meta.spoke);
  header.put(kSpokesPerTurn, meta.spokes_per_turn);
  for (std::size_t c = 0; c < 2; ++c) {
    const ChannelFormat& format = meta.channels[c];
    const std::size_t at = kChannel + c * kChannelBytes;
    header.put(at + kSamples, static_cast<std::uint32_t>(counts[c]));
    header.put(at + kDecimation, format.decimation);
    header.put(at + kOffset, static_cast<std::uint32_t>(offsets[c]));
    header.put(at + kBits, format.bits);
    header.put(at + kMode, static_cast<std::uint8_t>(format.mode));
    header.put(at + kDetector, static_cast<std::uint8_t>(format.detector));
    header.put(at + kInverted, static_cast<std::uint8_t>(format.inverted));
  }

  const std::size_t begin = out.size();
  header.append_to(out);
  for (std::size_t c = 0; c < 2; ++c) {
    append_little_endian(out, std::span(sweep.samples[c]).first(counts[c]));
    pad(out, begin);
  }
}

void append_record(Bytes& out, std::uint64_t sequence, const Edges& edges) {
  using namespace layout::edges;
  const std::size_t count = std::min(edges.edges.size(), kMaxEdges);
  const std::size_t size = layout::padded(kEdgesHeader + count * kEdgeBytes);
  Header<kEdgesHeader> header(RecordKind::edges, size, sequence, edges.radar);
  header.put(kFromTick, edges.from_tick);
  header.put(kToTick, edges.to_tick);
  header.put(kSampleClock, edges.sample_clock_hz);
  header.put(kCount, static_cast<std::uint32_t>(count));

  const std::size_t begin = out.size();
  header.append_to(out);
  out.resize(begin + size, 0);
  const std::span<std::uint8_t> bytes = std::span(out).subspan(begin + kEdgesHeader);
  for (std::size_t i = 0; i < count; ++i) {
    put_little_endian(bytes, i * kEdgeBytes + kTick, edges.edges[i].tick, 8);
    bytes[i * kEdgeBytes + kLine] = static_cast<std::uint8_t>(edges.edges[i].line);
  }
}

void append_record(Bytes& out, std::uint64_t sequence, const Event& event) {
  using namespace layout::event;
  Header<kEventBytes> header(RecordKind::event, kEventBytes, sequence, event.radar);
  header.put(layout::kFaults, event.faults);
  header.put(kTick, event.tick);
  header.put(kEvent, event.event);
  header.put(kValue, event.value);
  header.append_to(out);
}

}  // namespace skerry::board
