// Legend: what each byte of a spoke's data means to a Signal K display, and its colour.
#pragma once

#include <cstdint>

#include "protocol/signalk/json.hpp"

namespace skerry::signalk {

// Values 0 .. levels-1 are echoes by strength, 0 none; behind them stand the edge of a tracked
// target, the two Doppler colours and the trail, which displays paint by themselves.
// Source: signalk/README.md.
struct Legend {
  std::uint32_t levels = 128;

  static constexpr std::uint32_t kHistory = 32;
  constexpr std::uint8_t target_border() const { return static_cast<std::uint8_t>(levels); }
  constexpr std::uint8_t doppler_approaching() const {
    return static_cast<std::uint8_t>(levels + 1);
  }
  constexpr std::uint8_t doppler_receding() const { return static_cast<std::uint8_t>(levels + 2); }
  constexpr std::uint8_t history_start() const { return static_cast<std::uint8_t>(levels + 3); }
  constexpr std::uint32_t size() const { return levels + 3 + kHistory; }

  // The first values of weak, middling and strong echoes.
  constexpr std::uint32_t low_return() const { return levels / 16 > 0 ? levels / 16 : 1; }
  constexpr std::uint32_t medium_return() const { return levels / 2; }
  constexpr std::uint32_t strong_return() const { return levels * 13 / 16; }
};

// The legend of cells of 4 or 8 bits.  8-bit cells lose their lowest bit, so that colours that are
// no strengths have values of their own; a cell above 0 stays above 0.
constexpr Legend legend_of(std::uint32_t bits) { return {.levels = bits == 4 ? 16u : 128u}; }

// The "legend" of a radar's capabilities.  Every colour is a text "#rrggbbaa".
Json legend_document(const Legend& legend);

}  // namespace skerry::signalk
