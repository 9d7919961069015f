// BoardSettings: what the registers of a board say, and whether it makes sense together.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>

#include "echo/radar/radar_set.hpp"
#include "protocol/board/sweep_record.hpp"
#include "server/board/azimuth.hpp"

namespace skerry::server {

struct ChannelSettings {
  std::uint32_t source = 0;  // 0: off; n: radar n - 1
  board::ChannelFormat format;
  std::int32_t gain_centibel = 0;  // 1/100 dB
  std::int32_t offset = 0;         // steps
  std::uint32_t stc = 0;
  board::TestMode test_mode = board::TestMode::off;
  std::uint32_t test_value = 256;

  bool is_on() const { return source != 0; }
  // Ticks from its first sample to its end.
  std::uint64_t length() const { return std::uint64_t{format.samples} * format.decimation; }
  friend bool operator==(const ChannelSettings&, const ChannelSettings&) = default;
};

struct BoardSettings {
  std::uint32_t clock_hz = 20'000'000;
  std::uint32_t pulse_code = 0;
  echo::Pulse pulse;                         // in use
  std::uint32_t prf_millihertz = 3'000'000;  // in use
  std::uint32_t jitter_ppm = 0, stagger_ppm = 0;
  std::uint32_t delay_ticks = 0;
  board::BlankingMode blanking = board::BlankingMode::off;
  std::array<BlankSector, 2> blank;
  std::uint32_t acp_per_turn = 4096;
  std::uint32_t milli_rpm = 24'000;  // in use
  std::int32_t arp_error = 0;
  std::uint32_t wow_ppm = 0, wow_per_turn = 1, gust_ppm = 0;
  std::uint32_t fifo_depth = 131'072;
  std::uint32_t spokes_per_turn = 0;
  std::array<ChannelSettings, 2> channels;

  bool blanks(Azimuth azimuth) const {
    return blank[0].contains(azimuth) || blank[1].contains(azimuth);
  }
  friend bool operator==(const BoardSettings&, const BoardSettings&) = default;
};

// From the registers' values; `on_air` is what pulse code 0 stands for.
BoardSettings settings_of(const std::function<std::uint32_t(std::uint32_t address)>& value,
                          const echo::RadarSet& set, const echo::Pulse& on_air);

// Why these cannot be in force together, naming registers and numbers; empty: they can.  Printable
// ASCII, shorter than board::kFaultReasonBytes.  The rules are protocol/board/contradiction.hpp's.
std::string contradiction_in(const BoardSettings& settings, const echo::RadarSet& set);

}  // namespace skerry::server
