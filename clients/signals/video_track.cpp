#include "clients/signals/video_track.hpp"

#include <algorithm>
#include <bit>

namespace skerry::client {
namespace {

std::uint16_t scaled(std::uint16_t code, unsigned bits) {
  const unsigned value = bits > 15 ? code >> 1u : static_cast<unsigned>(code) << (15 - bits);
  return static_cast<std::uint16_t>(std::min(value, 32767u));
}

}  // namespace

unsigned code_bits(const board::ChannelFormat& format) {
  return std::max(1u, static_cast<unsigned>(std::bit_width(board::largest_code(format))));
}

std::int16_t full_scale(std::uint16_t code, const board::ChannelFormat& format) {
  return static_cast<std::int16_t>(scaled(code, code_bits(format)));
}

bool has_video(const SignalRecording& recording, std::size_t channel) {
  return std::any_of(recording.sweeps.begin(), recording.sweeps.end(),
                     [&](const board::Sweep& sweep) { return !sweep.samples[channel].empty(); });
}

// From a trigger to the next: ticks [begin, end) of the recording.
struct VideoTrack::Stretch {
  std::uint64_t begin = 0, end = 0;
  const board::Sweep* sweep = nullptr;  // its format holds; nothing drawn where `silent`
  bool silent = false;
};

VideoTrack::VideoTrack(const SignalRecording& recording, std::size_t channel,
                       const SampleGrid& grid, Scale scale)
    : recording_(recording), channel_(channel), grid_(grid), scale_(scale) {}

// Stretch 0 is what comes before the first sweep, stretch k that of sweep k - 1.
VideoTrack::Stretch VideoTrack::stretch(std::size_t index) const {
  const auto& sweeps = recording_.sweeps;
  const auto begin_of = [&](std::size_t sweep) {
    return sweeps[sweep].meta.trigger_tick - recording_.from_tick;
  };
  Stretch result;
  result.begin = index == 0 ? 0 : begin_of(index - 1);
  result.end = index < sweeps.size() ? begin_of(index) : grid_.ticks();
  result.sweep = &sweeps[index == 0 ? 0 : index - 1];
  result.silent = index == 0;
  return result;
}

void VideoTrack::fill(std::uint64_t first, std::span<std::uint16_t> out) const {
  const auto& sweeps = recording_.sweeps;
  if (sweeps.empty() || out.empty()) {
    std::fill(out.begin(), out.end(), std::uint16_t{0});
    return;
  }
  // The first stretch with a tick in the first sample is that of the last trigger before it.
  const std::uint64_t tick = recording_.from_tick + grid_.first_tick(first);
  const auto after = std::upper_bound(
      sweeps.begin(), sweeps.end(), tick,
      [](std::uint64_t t, const board::Sweep& sweep) { return t < sweep.meta.trigger_tick; });
  auto index = static_cast<std::size_t>(after - sweeps.begin());
  const std::uint64_t last = first + out.size() - 1;
  std::uint64_t next = first;  // the first sample that has no level yet
  for (; index <= sweeps.size() && next <= last; ++index) {
    const Stretch part = stretch(index);
    if (part.begin == part.end) continue;
    const board::ChannelFormat& format = part.sweep->meta.channels[channel_];
    const std::uint16_t rest = board::blank_code(format);
    const std::uint16_t level = scale_ == Scale::codes ? rest : scaled(rest, code_bits(format));
    const std::uint64_t end = std::min(grid_.index(part.end - 1), last) + 1;
    if (end > next) {
      std::fill(out.begin() + static_cast<std::ptrdiff_t>(next - first),
                out.begin() + static_cast<std::ptrdiff_t>(end - first), level);
      next = end;
    }
    if (!part.silent) draw(part, first, out);
  }
  // A trigger within the last sample begins a stretch that reaches into it.
  for (; index <= sweeps.size(); ++index) {
    const Stretch part = stretch(index);
    if (grid_.index(part.begin) > last) break;
    if (part.begin < part.end) draw(part, first, out);
  }
}

void VideoTrack::draw(const Stretch& part, std::uint64_t first,
                      std::span<std::uint16_t> out) const {
  const board::SweepMeta& meta = part.sweep->meta;
  const board::ChannelFormat& format = meta.channels[channel_];
  const auto& samples = part.sweep->samples[channel_];
  const unsigned bits = code_bits(format);
  const std::uint64_t hold = std::max(format.decimation, 1u);
  const std::uint64_t begin = part.begin + meta.delay_ticks;
  const std::uint64_t block_tick = grid_.first_tick(first);
  const std::uint64_t last = first + out.size() - 1;
  std::uint64_t i = block_tick > begin ? (block_tick - begin) / hold : 0;
  for (; i < samples.size(); ++i) {
    const std::uint64_t from = begin + i * hold;
    if (from >= part.end) break;
    const std::uint64_t low = std::max(grid_.index(from), first);
    if (low > last) break;
    const std::uint64_t high = std::min(grid_.index(std::min(from + hold, part.end) - 1), last);
    const std::uint16_t level = scale_ == Scale::codes ? samples[i] : scaled(samples[i], bits);
    for (std::uint64_t m = low; m <= high; ++m) {
      std::uint16_t& sample = out[m - first];
      sample = format.inverted ? std::min(sample, level) : std::max(sample, level);
    }
  }
}

}  // namespace skerry::client
