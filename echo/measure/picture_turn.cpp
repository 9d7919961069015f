#include "echo/measure/picture_turn.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace skerry::echo {
namespace {

[[noreturn]] void refuse(const std::string& what, double found, const std::string& expected) {
  throw std::invalid_argument("picture: " + what + " is " + std::to_string(found) + ", expected " +
                              expected);
}

}  // namespace

void require_valid(const PictureTurn& turn, const PictureWindow& window) {
  if (turn.spokes < 1 || turn.spokes > 8192) refuse("number of spokes", turn.spokes, "1 to 8192");
  if (turn.cells < 1 || turn.cells > 4096) refuse("number of cells", turn.cells, "1 to 4096");
  if (turn.video.size() != std::size_t{turn.spokes} * turn.cells)
    refuse("size of the video", static_cast<double>(turn.video.size()), "spokes times cells");
  if (!(turn.cell_m > 0.0 && turn.cell_m < 1e6))
    refuse("cell, in metres,", turn.cell_m, "more than 0 and less than 1e6");
  if (!(turn.beam_deg > 0.0 && turn.beam_deg <= 180.0))
    refuse("beam width", turn.beam_deg, "more than 0 and at most 180 degrees");
  if (!(window.threshold > 0.0 && window.threshold <= 1.0))
    refuse("threshold", window.threshold, "more than 0 and at most 1");
  if (!(window.from_m >= 0.0 && window.to_m > window.from_m))
    refuse("range the window begins at, in metres,", window.from_m,
           "at least 0 and less than where it ends");
}

std::uint8_t least_echo(const PictureTurn& turn, const PictureWindow& window) {
  return static_cast<std::uint8_t>(
      std::clamp(std::ceil(window.threshold * turn.full_scale), 1.0, 255.0));
}

WindowCells cells_of(const PictureTurn& turn, const PictureWindow& window) {
  WindowCells cells;
  const double step = 360.0 / turn.spokes;
  // From the first spoke of the window on, so that neighbours are neighbours through 0 too.
  const auto first = static_cast<std::uint32_t>(
      std::clamp(std::ceil(window.from_deg / step), 0.0, static_cast<double>(turn.spokes)));
  for (std::uint32_t k = 0; k < turn.spokes; ++k) {
    const std::uint32_t spoke = (first + k) % turn.spokes;
    if (window.holds_bearing(spoke * step)) cells.spokes.push_back(spoke);
  }
  const auto cell = [&](double m) {
    return static_cast<std::uint32_t>(
        std::clamp(std::floor(m / turn.cell_m), 0.0, static_cast<double>(turn.cells)));
  };
  cells.first = cell(window.from_m);
  cells.last = cell(window.to_m);
  return cells;
}

}  // namespace skerry::echo
