// Value change dumps of a board's signals.
#pragma once

#include <cstdint>
#include <string>

#include "clients/signals/signal_recording.hpp"

namespace skerry::client {

// How ticks become the times of a dump.  The unit is the coarsest of 1 ns, 1 ps and 1 fs that a
// period of the sample clock is a whole number of: tick n stands at n * period, exactly.  Where
// even a femtosecond does not divide it (60 MHz) tick n stands at n / clock rounded to the nearest
// femtosecond, from the beginning of the recording. Error: at most 0.5 fs, at every tick, not
// adding up.
struct VcdTimescale {
  const char* unit = "1 ns";
  std::uint64_t units_per_second = 1'000'000'000;
  std::uint64_t clock_hz = 1;

  std::uint64_t time_of(std::uint64_t tick) const;
  bool exact() const { return units_per_second % clock_hz == 0; }
  // Units in a tick, rounded down: for readers that take every so-manieth unit
  // (sigrok-cli -I vcd:downsample=N), one sample per tick.
  std::uint64_t downsample() const { return units_per_second / clock_hz; }
};
// Requires clock_hz > 0.
VcdTimescale vcd_timescale(std::uint32_t clock_hz);

// About what a dump takes, more rather than less: rising edges and changes of video in it.
std::uint64_t vcd_bytes(std::uint64_t edges, std::uint64_t video_changes);

// Wires trigger, acp, arp, heading, and with `video` the bits of video_a and video_b (codes as the
// converter gives them) where the recording has them, highest first, in the scope `board`.  Bit by
// bit, since sigrok of Debian 12 knows no vectors; viewers such as gtkwave put them together.  Time
// 0 is from_tick; the last time is to_tick.  Pulses as of pulses_of() at the sample clock. Source:
// IEEE Std 1364-2005, clause 18. Error: std::runtime_error "cannot write PATH: why"; the file is
// then removed.  As of pulses_of().
SignalFile write_vcd(const std::string& path, const SignalRecording& recording, bool video,
                     const GoOn& go_on);

}  // namespace skerry::client
