#include "clients/signals/waveform.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace skerry::client {
namespace {

constexpr std::array<const char*, 6> kNames = {"video_a", "video_b", "trigger",
                                               "acp",     "arp",     "heading"};

board::Line line_of(SignalChannel channel) {
  return static_cast<board::Line>(static_cast<unsigned>(channel) -
                                  static_cast<unsigned>(SignalChannel::trigger));
}

}  // namespace

const char* channel_name(SignalChannel channel) {
  return kNames[static_cast<std::size_t>(channel)];
}

std::optional<SignalChannel> channel_named(std::string_view name) {
  for (const SignalChannel channel : kAllSignalChannels) {
    if (name == channel_name(channel)) return channel;
  }
  return std::nullopt;
}

std::optional<std::size_t> video_channel(SignalChannel channel) {
  if (channel == SignalChannel::video_a) return 0;
  if (channel == SignalChannel::video_b) return 1;
  return std::nullopt;
}

Waveform::Waveform(const SignalRecording& recording, std::vector<SignalChannel> channels,
                   std::uint32_t rate_hz)
    : recording_(recording),
      channels_(std::move(channels)),
      grid_(recording.sample_clock_hz, rate_hz, recording.ticks()) {
  for (const SignalChannel channel : channels_) {
    pulses_.push_back(video_channel(channel) ? std::vector<Pulse>{}
                                             : pulses_of(recording_, line_of(channel), grid_));
  }
}

void Waveform::fill_line(const std::vector<Pulse>& pulses, std::uint64_t first,
                         std::span<std::uint16_t> out) const {
  std::fill(out.begin(), out.end(), std::uint16_t{0});
  const std::uint64_t end = first + out.size();
  auto pulse = std::upper_bound(pulses.begin(), pulses.end(), first,
                                [](std::uint64_t m, const Pulse& p) { return m < p.fall; });
  for (; pulse != pulses.end() && pulse->rise < end; ++pulse) {
    const auto from = std::max(pulse->rise, first) - first;
    const auto to = std::min(pulse->fall, end) - first;
    std::fill(out.begin() + static_cast<std::ptrdiff_t>(from),
              out.begin() + static_cast<std::ptrdiff_t>(to), std::uint16_t{kLineHigh});
  }
}

void Waveform::fill(std::uint64_t first, std::span<std::int16_t> out) {
  const std::size_t stride = channels_.size();
  column_.resize(out.size() / stride);
  for (std::size_t c = 0; c < stride; ++c) {
    if (const auto video = video_channel(channels_[c])) {
      VideoTrack(recording_, *video, grid_, VideoTrack::Scale::full).fill(first, column_);
    } else {
      fill_line(pulses_[c], first, column_);
    }
    for (std::size_t k = 0; k < column_.size(); ++k) {
      out[k * stride + c] = static_cast<std::int16_t>(column_[k]);
    }
  }
}

}  // namespace skerry::client
