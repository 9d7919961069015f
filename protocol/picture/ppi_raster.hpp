// PpiRaster: the video of a scan, pixel by pixel (polar to image), before it gets colours.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/quantity/angle.hpp"
#include "protocol/video/scan.hpp"

namespace skerry {

enum class Orientation : std::uint8_t {
  north_up,  // every spoke at its own true bearing, north at the top
  head_up,   // every spoke at its own relative bearing, the bow at the top
};

// Where the picture lies in a square image: centre in the middle, the range scale at `radius`.
struct PpiFrame {
  int size = 1024;        // pixels, 1 .. 8192
  double radius = 460.0;  // pixels, > 0
  Orientation orientation = Orientation::north_up;
  double centre() const { return 0.5 * size; }
};

enum class PixelKind : std::uint8_t {
  outside,  // beyond the range scale
  unswept,  // the antenna did not point there in this turn, because the ship turned
  missing,  // it did, but the spoke was not received
  video,
};

struct PpiRaster {
  int size = 0;
  std::vector<std::uint8_t> level;  // 0 .. 255 (4-bit cells times 17); 0 unless video
  std::vector<PixelKind> kind;
  std::vector<DopplerClass> doppler;  // of the cell that gives the level; empty if no spoke has any
};

// A pixel shows the strongest of the cell under its centre and all cells whose centre lies in it.
// So a cell is drawn where it is and no bigger than it is, and when the image is coarser than the
// video no target is lost between pixels.  A spoke covers up to the middle between it and its
// neighbours; where a turning ship made spokes overlap the newer one shows.
// The radius is the newest spoke's range scale; spokes of another scale stand at their own ranges.
// Error: azimuth 0.0028 deg (half of 1/65536 turn): 0.2 pixels at a radius of 4,096.
// Requires a scan as ScanAssembler gives it.  Pure.  Thread: any.
PpiRaster rasterise(const Scan& scan, const PpiFrame& frame);

}  // namespace skerry
