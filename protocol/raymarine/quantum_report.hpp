// Reports of a Raymarine Quantum radar on its data group.  README.md lists what is unknown.
// Source: raymarine/README.md, quantum2-solent-03-gain-sea-rain.pcap.gz.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::raymarine {

inline constexpr std::uint32_t kQuantumInfoType = 0x280001, kQuantumStatusType = 0x280002,
                               kQuantumSpokeType = 0x280003;
inline constexpr std::size_t kQuantumStatusBytes = 260;

// Each mode keeps its own.  Values are percent.
struct QuantumModeControls {
  bool gain_auto = false;
  std::uint8_t gain = 0;
  bool colour_auto = false;
  std::uint8_t colour = 0;  // colour gain
  bool sea_auto = false;
  std::uint8_t sea = 0;
  bool rain_on = false;
  std::uint8_t rain = 0;
  friend bool operator==(const QuantumModeControls&, const QuantumModeControls&) = default;
};

enum class QuantumMode : std::uint8_t { harbour = 0, coastal = 1, offshore = 2, weather = 3 };
inline constexpr std::size_t kQuantumModes = 4;

// 1/1000 NM each: 31 is 1/32 NM.
inline constexpr std::array<std::uint32_t, 20> kQuantumRanges = {
    31,   63,   125,  250,  375,   500,   750,   1000,  1500,  2000,
    3000, 4000, 6000, 8000, 12000, 16000, 24000, 32000, 48000, 64000};

struct QuantumStatus {
  bool transmits = false;
  std::int16_t bearing_offset = 0;  // 0.1 deg
  std::uint8_t rejection = 0;       // of interference, 0 .. 5
  std::uint8_t range_index = 0;     // of `ranges`
  QuantumMode mode = QuantumMode::harbour;
  std::array<QuantumModeControls, kQuantumModes> controls{};
  std::uint8_t expansion = 0;  // of targets
  std::uint8_t main_bang = 1;  // its suppression, 0 or 1
  std::array<std::uint32_t, 20> ranges = kQuantumRanges;
  friend bool operator==(const QuantumStatus&, const QuantumStatus&) = default;
};
// Once a second, and at once when it changes; displays read the range only here.
// Error: truncated, oversized, unknown_kind, out_of_range (mode or range index).
Result<QuantumStatus, WireError> decode_quantum_status(std::span<const std::uint8_t> datagram);
Bytes encode_quantum_status(const QuantumStatus& status);

struct QuantumInfo {
  std::string part_number;    // 6 characters: "E70498" is a Quantum 2 with Doppler
  std::string serial_number;  // 7 characters
};
// Error: truncated, unknown_kind.
Result<QuantumInfo, WireError> decode_quantum_info(std::span<const std::uint8_t> datagram);
Bytes encode_quantum_info(const QuantumInfo& info);  // longer texts are cut

// Reports of unknown meaning that a real radar sends as well, as captured: their numbers are
// 0x280007, 0x280030, 0x280031, 0x280b01 (8 bytes), 0x280008 (532) and 0x288942 (72, a packet of a
// count and nothing else).
inline constexpr std::array<std::uint32_t, 4> kQuantumShortTypes = {0x280007, 0x280030, 0x280031,
                                                                    0x280b01};
Bytes encode_quantum_short(std::uint32_t type);  // requires one of kQuantumShortTypes
Bytes encode_quantum_long();
inline constexpr std::uint32_t kQuantumCounts = 25;  // a second
Bytes encode_quantum_count(std::uint32_t count);     // 0 .. kQuantumCounts-1

}  // namespace skerry::raymarine
