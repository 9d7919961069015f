// Assembly of the shoreline segments of one GSHHG bin into closed rings.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/gshhg_grid.hpp"

namespace skerry::echo {

inline constexpr std::uint8_t kIceFront = 5;  // level of the Antarctic one, a kind of 1

// A piece of shoreline within a bin, as stored: land on its left.  Either a ring (entry and exit
// are kClosed, the first point repeated at the end) or a line from one side of the bin to another.
struct ShoreSegment {
  static constexpr std::uint8_t kClosed = 4;
  std::uint8_t level = 1;        // 1 to 4, or kIceFront
  std::uint8_t entry = kClosed;  // side where it begins: 0 south, 1 east, 2 north, 3 west
  std::uint8_t exit = kClosed;
  std::vector<BinPoint> points;
};

struct BinShore {
  int bin = 0;
  // Levels at the south-west, south-east, north-east and north-west corner, 0 = sea.
  std::array<std::uint8_t, 4> corner_levels{};
  std::vector<ShoreSegment> segments;
};

struct BinRing {
  std::uint8_t level = 1;
  std::vector<BinPoint> points;  // closed, the first not repeated
  std::vector<EdgeKind> edges;   // edges[i] joins points[i] and points[i+1 mod n]
};

// The segments contradict the format.  The text does not name the file and the bin.
class BinError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// Closed rings, each level by itself: land rings (levels 1, 3, 5) run counter-clockwise around what
// they bound, water rings (2, 4) clockwise, so that land is on the left everywhere and the winding
// numbers of all rings at a place sum up to 1 on land and to 0 on water.
//
// Lines are closed along the bin's border: counter-clockwise, from where one leaves the bin to
// where the next of its level enters, around the corners passed; those edges are
// EdgeKind::bin_border. Without lines of a level, the bin is inside that level or outside as its
// corners are.
//
// All five files of GSHHG 2.3.7 were checked whole: lines begin and end on the sides stated, and
// entries and exits of a level alternate, but 2 to 22 times per file two lines touch on the border
// (one of the two may be a spike of two points, which bounds nothing and is left out).
// No segment runs along a bin border: the polygons were closed along the antimeridian and at the
// South Pole, but the cut into bins has taken those edges away, so no shoreline edge needs to be
// turned into a border.  In the coarser files, simplified islands of three corners are sometimes
// turned inside out (at most 10 of a file), or flat: the one is set right, the other left out.
// Held by GshhgWorld.EveryBinHasTheCornersItsFileStates and TheAreasOfAllRings....
//
// Error: BinError when the segments do not fit together.
std::vector<BinRing> assemble_bin(const BinShore& shore, bool antarctic);

}  // namespace skerry::echo
