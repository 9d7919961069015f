// Quantities as items have them: whole multiples of the value of the least significant bit (LSB).
// Shared by the encoders and decoders, of no use elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>

#include "protocol/wire/wire_error.hpp"

namespace skerry::asterix {

struct Quantity {
  std::uint8_t octets = 2;  // 1 .. 4
  double unit = 1.0;        // of the least significant bit, in the report's own unit
  bool is_signed = false;   // two's complement
  // Of what is out of range: the nearest that there is, as "the maximum value means that or above";
  // otherwise it is not written.
  bool clamps = false;
  bool is_angle = false;  // degrees, of which any turns fall away; its octets are one turn
};

// What the octets are called in the reports.
inline constexpr double kMetresPerNauticalMile = 1852.0;
inline constexpr double kTurn16 = 360.0 / 65536.0;         // degrees
inline constexpr double kSpeedUnit = 1852.0 / (1u << 14);  // 2^-14 NM/s, in m/s
inline constexpr Quantity kAngle{.unit = kTurn16, .is_angle = true};
inline constexpr Quantity kSpeed{.unit = kSpeedUnit};  // up to 7407 m/s

struct QuantityValue {
  Quantity quantity;
  double value;
};

// Appends all of them, each rounded to its unit; nothing if one is not finite or out of range.
// Returns whether they are written.  Error: half a unit.
bool append_quantities(Bytes& out, std::initializer_list<QuantityValue> values);

// The value of octets that are there.  Requires at + quantity.octets <= octets.size().
double quantity_at(std::span<const std::uint8_t> octets, std::size_t at, const Quantity& quantity);

}  // namespace skerry::asterix
