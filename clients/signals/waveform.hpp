// Waveform: the chosen channels of a recording as interleaved 16-bit samples.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "clients/signals/pulse_train.hpp"
#include "clients/signals/sample_grid.hpp"
#include "clients/signals/signal_recording.hpp"
#include "clients/signals/video_track.hpp"

namespace skerry::client {

enum class SignalChannel : std::uint8_t { video_a, video_b, trigger, acp, arp, heading };
inline constexpr std::array<SignalChannel, 6> kAllSignalChannels = {
    SignalChannel::video_a, SignalChannel::video_b, SignalChannel::trigger,
    SignalChannel::acp,     SignalChannel::arp,     SignalChannel::heading};

// "video_a", "video_b", "trigger", "acp", "arp", "heading".
const char* channel_name(SignalChannel channel);
std::optional<SignalChannel> channel_named(std::string_view name);
// Channel 0 (A) or 1 (B) of the sweeps, or nothing for a digital line.
std::optional<std::size_t> video_channel(SignalChannel channel);

// A digital line that is high; low is 0.
inline constexpr std::int16_t kLineHigh = 32767;

// Every sample by the rules of pulses_of() and VideoTrack.
// Thread: one at a time.
class Waveform {
 public:
  // Keeps a reference.  Requires 0 < rate_hz <= the sample clock.  Error: as of pulses_of().
  Waveform(const SignalRecording& recording, std::vector<SignalChannel> channels,
           std::uint32_t rate_hz);

  // How often fill() is asked for at a time, by those who write files.
  static constexpr std::size_t kBlock = 1 << 16;

  const SampleGrid& grid() const { return grid_; }
  std::uint64_t samples() const { return grid_.samples(); }
  const std::vector<SignalChannel>& channels() const { return channels_; }

  // Samples `first` .. of all channels: out[k * channels + c].  Requires `out` a multiple of the
  // channels and no sample behind the last.
  void fill(std::uint64_t first, std::span<std::int16_t> out);

 private:
  void fill_line(const std::vector<Pulse>& pulses, std::uint64_t first,
                 std::span<std::uint16_t> out) const;

  const SignalRecording& recording_;
  std::vector<SignalChannel> channels_;
  SampleGrid grid_;
  std::vector<std::vector<Pulse>> pulses_;  // of each channel; none for video
  std::vector<std::uint16_t> column_;
};

}  // namespace skerry::client
