// ThinShape: how much each level of thin spokes leaves of a picture.
#pragma once

#include <array>
#include <cstdint>

namespace skerry {

// A turn has at most so many spokes and a spoke so many cells, and all cells have 4 bits.  Of
// spokes and cells that are put together the strongest echo is kept.
struct ThinShape {
  std::uint32_t most_spokes = 0;
  std::uint32_t most_cells = 0;
  // Cells of less, of 15, are 0: they are noise nearly always, and the larger part of what would be
  // sent.
  std::uint8_t floor = 0;
  // Of 8-bit spokes' rate, as measured on the built-in exercise's coast (4096 spokes of 1024
  // cells); the open sea needs less.
  double share = 1.0;
};

inline constexpr std::uint32_t kThinLevels = 4;

// Of level 1 .. kThinLevels; level 0 is no thin spokes.  Held by ThinTest.LevelsTakeTheirShare.
inline constexpr std::array<ThinShape, kThinLevels + 1> kThinShapes = {{
    {8192, 8192, 0, 1.0},
    {8192, 8192, 0, 0.095},
    {2048, 1024, 0, 0.057},
    {1024, 512, 3, 0.016},
    {512, 256, 3, 0.006},
}};

// Spokes that are sent together: a thirty-second of a turn.  At 24 turns a minute they wait for 78
// ms at most.
inline constexpr std::uint32_t kThinBlocksPerTurn = 32;
inline constexpr std::uint32_t kMostThinSpokes = 1024;  // in a message

}  // namespace skerry
