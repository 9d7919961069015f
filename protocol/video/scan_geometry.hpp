// ScanGeometry: how a turn is cut into spokes and a spoke into cells.
#pragma once

#include <cstdint>

#include "protocol/quantity/length.hpp"
#include "protocol/video/range_scale.hpp"

namespace skerry {

struct ScanGeometry {
  // A Quantum sends 250 spokes a turn of 180 cells or so; what this server makes has 256 of each.
  static constexpr std::uint32_t kMinSpokes = 128, kMaxSpokes = 8192;
  static constexpr std::uint32_t kMinCells = 128, kMaxCells = 4096;

  std::uint32_t spokes_per_turn = 4096;  // kMinSpokes .. kMaxSpokes
  std::uint32_t cells = 1024;            // per spoke, kMinCells .. kMaxCells
  std::uint32_t bits = 8;                // per cell, 4 or 8

  constexpr bool valid() const {
    return spokes_per_turn >= kMinSpokes && spokes_per_turn <= kMaxSpokes && cells >= kMinCells &&
           cells <= kMaxCells && (bits == 4 || bits == 8);
  }
  // Cell n covers ranges [n, n+1) * cell_size; the last cell ends at the range scale.
  constexpr Length cell_size(RangeScale scale) const { return scale.length() / cells; }
  friend constexpr bool operator==(const ScanGeometry&, const ScanGeometry&) = default;
};

}  // namespace skerry
