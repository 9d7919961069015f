// VideoTrack: a video channel of a recording as a waveform.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "clients/signals/sample_grid.hpp"
#include "clients/signals/signal_recording.hpp"

namespace skerry::client {

// Bits that the largest code of a channel takes, 1 .. 16: those of the converter, more after a sum.
unsigned code_bits(const board::ChannelFormat& format);
// A code on the 16-bit scale of waveforms: left-justified below the sign, code << (15 - bits), so
// that full scale is just below 32767 and nothing is rounded.  Error: of codes of 16 bits (sums)
// the lowest bit goes.
std::int16_t full_scale(std::uint16_t code, const board::ChannelFormat& format);
// Whether any sweep of the recording has that channel.
bool has_video(const SignalRecording& recording, std::size_t channel);

// The video as a scope on the video output sees it.  Sample i of a sweep holds its level for the
// ticks [delay + i * decimation, delay + (i + 1) * decimation) after its trigger, until the next
// trigger at the latest; elsewhere the level is that of no echo.  Where a sample of the grid covers
// several levels it takes the strongest, so that no echo is lost at a low rate.  Video of a sweep
// triggered before the recording is not in it. Thread: any, each its own.
class VideoTrack {
 public:
  enum class Scale : std::uint8_t { codes, full };

  // channel: 0 (A) or 1 (B).  Keeps references.
  VideoTrack(const SignalRecording& recording, std::size_t channel, const SampleGrid& grid,
             Scale scale);

  // Samples first .. first + out.size() - 1 of the grid.
  void fill(std::uint64_t first, std::span<std::uint16_t> out) const;

 private:
  struct Stretch;
  Stretch stretch(std::size_t index) const;
  void draw(const Stretch& stretch, std::uint64_t first, std::span<std::uint16_t> out) const;

  const SignalRecording& recording_;
  std::size_t channel_;
  const SampleGrid& grid_;
  Scale scale_;
};

}  // namespace skerry::client
