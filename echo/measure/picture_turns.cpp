#include "echo/measure/picture_turns.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>
#include <stdexcept>

namespace skerry::echo {
namespace {

constexpr double kNoValue = std::numeric_limits<double>::quiet_NaN();

void require_alike(std::span<const PictureTurn> turns, const PictureWindow& window) {
  for (const PictureTurn& turn : turns) {
    require_valid(turn, window);
    if (turn.spokes != turns.front().spokes || turn.cells != turns.front().cells)
      throw std::invalid_argument("picture: turns of different sizes");
  }
}

struct Difference {
  double sum = 0.0, cells = 0.0;
  double mean() const { return cells > 0.0 ? sum / cells : 0.0; }
};

}  // namespace

double turn_correlation(std::span<const PictureTurn> turns, const PictureWindow& window,
                        std::size_t lag) {
  require_alike(turns, window);
  double total = 0.0, pairs = 0.0;
  for (std::size_t t = 0; t + lag < turns.size(); ++t) {
    const PictureTurn &first = turns[t], &second = turns[t + lag];
    const WindowCells in = cells_of(first, window);
    double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
    for (const std::uint32_t s : in.spokes) {
      for (std::uint32_t c = in.first; c < in.last; ++c) {
        const double a = first.at(s, c), b = second.at(s, c);
        if (a == 0.0 && b == 0.0) continue;
        n += 1.0, x += a, y += b, xx += a * a, yy += b * b, xy += a * b;
      }
    }
    const double spread = n > 1.0 ? (xx - x * x / n) * (yy - y * y / n) : 0.0;
    if (!(spread > 0.0)) continue;
    total += (xy - x * y / n) / std::sqrt(spread), pairs += 1.0;
  }
  return pairs > 0.0 ? total / pairs : kNoValue;
}

double bow_seam(std::span<const PictureTurn> turns, const PictureWindow& window) {
  require_alike(turns, window);
  if (turns.size() < 2 || turns.front().spokes < 32) return kNoValue;
  const WindowCells in = cells_of(turns.front(), window);
  const std::uint32_t spokes = turns.front().spokes;
  constexpr int kBeside = 8;
  Difference across, beside;
  for (std::size_t t = 0; t + 1 < turns.size(); ++t) {
    const auto at = [&](int spoke, std::uint32_t cell) {
      return spoke < 0 ? turns[t].at(spokes - static_cast<std::uint32_t>(-spoke), cell)
                       : turns[t + 1].at(static_cast<std::uint32_t>(spoke), cell);
    };
    for (int s = -kBeside - 1; s < kBeside; ++s) {
      Difference& into = s == -1 ? across : beside;
      for (std::uint32_t c = in.first; c < in.last; ++c) {
        const int a = at(s, c), b = at(s + 1, c);
        if (a == 0 && b == 0) continue;
        into.sum += std::abs(a - b), into.cells += 1.0;
      }
    }
  }
  return across.cells > 0.0 && beside.mean() > 0.0 ? across.mean() / beside.mean() : kNoValue;
}

}  // namespace skerry::echo
