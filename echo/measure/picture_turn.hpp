// One turn of radar video, as the picture's estimators see it.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace skerry::echo {

// Spoke k looks along k * 360 / spokes degrees (of any zero, clockwise); cell n covers ranges
// [n, n+1) * cell_m.
struct PictureTurn {
  std::uint32_t spokes = 0, cells = 0;
  double cell_m = 1.0;
  double beam_deg = 1.2;                // horizontal beam width, one way, -3 dB
  std::uint8_t full_scale = 255;        // the largest value of a cell
  std::span<const std::uint8_t> video;  // spokes * cells

  std::uint8_t at(std::uint32_t spoke, std::uint32_t cell) const {
    return video[std::size_t{spoke} * cells + cell];
  }
};

// The part of the picture to measure, and the level that counts as an echo.
struct PictureWindow {
  double from_deg = 0.0, to_deg = 360.0;  // clockwise; from > to: through 0
  double from_m = 0.0, to_m = 1e12;
  double threshold = 0.5;  // of full scale, above 0

  bool holds_bearing(double deg) const {
    return from_deg <= to_deg ? deg >= from_deg && deg <= to_deg : deg >= from_deg || deg <= to_deg;
  }
};

// Least value of a cell that counts as an echo, at least 1.
std::uint8_t least_echo(const PictureTurn& turn, const PictureWindow& window);

// The spokes of the window in order, and its cells [first, last).
struct WindowCells {
  std::vector<std::uint32_t> spokes;
  std::uint32_t first = 0, last = 0;
};
WindowCells cells_of(const PictureTurn& turn, const PictureWindow& window);

// Refuses turns that contradict themselves: sizes of 0 or beyond 8192 spokes and 4096 cells, video
// of another size, a cell or beam that is not above 0.
// Error: std::invalid_argument naming what was found and what is allowed.
void require_valid(const PictureTurn& turn, const PictureWindow& window);

}  // namespace skerry::echo
