// Commands: what a display tells a Navico radar.  Source: navico/README.md.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::navico {

enum class CommandKind : std::uint8_t {
  prepare,             // 00C1: comes before every `transmit`
  transmit,            // 01C1: value 1 on, 0 off
  range,               // 03C1: value in decimetres
  bearing_alignment,   // 05C1: value 0 .. 3599, 0.1 deg
  gain,                // 06C1 00: automatic 0 or 1, value 0 .. 255
  sea,                 // 06C1 02: automatic 0 manual, 1 harbour, 2 offshore; value 0 .. 255
  rain,                // 06C1 04: value 0 .. 255
  side_lobe,           // 06C1 05: automatic 0 or 1, value 0 .. 255
  interference,        // 08C1: value 0 .. 3
  expansion,           // 09C1, HALO 12C1: value 0 .. 3
  boost,               // 0AC1: value 0 .. 2
  sea_state,           // 0BC1: value 0 calm, 1 moderate, 2 rough
  blanking_on,         // 0DC1: sector 0 .. 3, value 1 on, 0 off
  blanking_angles,     // C0C1: sector, value as above, from and to
  local_interference,  // 0EC1: value 0 .. 3
  scan_speed,          // 0FC1: value 0 .. 3
  mode,                // 10C1: value 0 custom, 1 harbour, 2 offshore, 3 buoy, 4 weather, 5 bird
  halo_sea_mode,       // 11C1 xx000001: automatic 0 or 1
  halo_sea,            // 11C1 00vvvv02: value 0 .. 100
  halo_sea_adjust,     // 11C1 01ssss04: value -100 .. 100 around automatic
  noise_rejection,     // 21C1: value 0 .. 3
  target_separation,   // 22C1: value 0 .. 3
  doppler,             // 23C1: value 0 off, 1 both, 2 approaching
  doppler_threshold,   // 24C1: value in cm/s
  antenna_height,      // 30C1 01: value in mm
  antenna_offset,      // 30C1 03: value in mm
  accent_light,        // 31C1: value 0 .. 255
  parking,             // 40C1: value in 0.1 deg
  stay_alive,          // A0C1
  ask_controls,        // 03C2: reports 02C4 and 08C4
  ask_identity,        // 04C2: report 03C4
  ask_installation,    // 05C2: report 04C4
  ask_other,           // 0AC2
};

// Values are as they came: the radar clamps or ignores those it does not know.
struct Command {
  CommandKind kind = CommandKind::stay_alive;
  std::int32_t value = 0;
  std::uint8_t automatic = 0;
  std::uint8_t sector = 0;
  std::uint16_t from = 0, to = 0;  // 0.1 deg, clockwise from the bow
  friend bool operator==(const Command&, const Command&) = default;
};

inline constexpr std::size_t kMaxCommand = 64;

// Octets after those a command needs are not looked at, as real radars do not.
// Error: truncated, oversized (above kMaxCommand) or unknown_kind.
Result<Command, WireError> decode_command(std::span<const std::uint8_t> datagram);

// Encodes it as a chart plotter does.  `halo`: a HALO's form where it has one of its own.
Bytes encode_command(const Command& command, bool halo = false);

}  // namespace skerry::navico
