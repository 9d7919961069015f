// Commands of displays to a Raymarine Quantum radar.  Source: raymarine/README.md, mayara
// docs/raymarine.
#pragma once

#include <cstdint>
#include <span>

#include "protocol/quantity/result.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::raymarine {

enum class QuantumControl : std::uint8_t {
  stay_alive,   // 0x280000 twice a second, or 0x288903 every three
  transmit,     // 0 or 1
  range_index,  // of the status's ranges
  gain_auto,    // 0 or 1
  gain,         // percent, as the next ones
  colour_auto,  // 0 or 1
  colour,
  sea_auto,  // 0 or 1
  sea,
  rain_on,  // 0 or 1
  rain,
  expansion,       // 0 or 1
  rejection,       // 0 .. 5
  mode,            // QuantumMode
  bearing_offset,  // 0.1 deg, -1800 .. 1800
};

// `value` is within the control's range: what lay outside was clamped.
struct QuantumCommand {
  QuantumControl control = QuantumControl::stay_alive;
  std::int32_t value = 0;
  bool clamped = false;
};
// Takes the Quantum's own commands, and those of the older RD radars that displays mix in.
// Error: truncated; unknown_kind.
Result<QuantumCommand, WireError> decode_quantum_command(std::span<const std::uint8_t> datagram);
// In the Quantum's own form.
Bytes encode_quantum_command(QuantumControl control, std::int32_t value);

}  // namespace skerry::raymarine
