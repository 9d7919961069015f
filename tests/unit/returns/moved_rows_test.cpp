#include "echo/returns/moved_rows.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

namespace skerry::echo {
namespace {

// Every cell of a spoke, by parts laid for it or for one near by, against where libm says its place
// was seen.
TEST(MovedRows, FindEachPlaceWhereItWasSeen) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst_rows = 0.0, worst_m = 0.0, worst_cells = 0.0;
  for (int round = 0; round < 3000; ++round) {
    MovedView view;
    view.rows = 1u << (10 + random() % 4);
    view.cell_m = std::exp2(7.0 * unit(random));
    const double way = round % 10 == 0 ? 0.0 : 12.0 * view.cell_m * unit(random);
    const double course = 2.0 * std::numbers::pi * unit(random);
    view.moved = {way * std::sin(course), way * std::cos(course)};
    const auto bearing = static_cast<std::uint32_t>(random());
    const double b = bearing * std::numbers::pi * 0x1p-31;
    const double from = 3.0 * way + 20.0 * view.cell_m * unit(random);
    const auto cells = static_cast<std::uint32_t>(256 + random() % 800);
    std::uint32_t next = static_cast<std::uint32_t>(from / view.cell_m);
    const double aside = round % 2 == 0 ? 0.0 : kPartsServe * (2.0 * unit(random) - 1.0);
    const auto laid_for =
        bearing +
        static_cast<std::uint32_t>(static_cast<std::int64_t>(aside / std::numbers::pi * 0x1p31));
    lay_parts(view, laid_for, from, cells, [&](const PlacedPart& placed) {
      const RowPart part = placed.at(bearing, view.rows);
      ASSERT_EQ(part.first, next);
      ASSERT_LT(part.first, part.last);
      ASSERT_LT(part.row, view.rows);
      next = part.last;
      for (const std::uint32_t cell : {part.first, (part.first + part.last) / 2, part.last - 1}) {
        const double range = (cell + 0.5) * view.cell_m;
        const double east = view.moved.east_m + range * std::sin(b);
        const double north = view.moved.north_m + range * std::cos(b);
        const double row = std::atan2(east, north) / (2.0 * std::numbers::pi) * view.rows;
        const double off = std::fabs(std::remainder(part.row - row, view.rows));
        // Change of bearing within half of the least part.
        const double least =
            way * kLeastPart * view.cell_m / (range * range) / (2.0 * std::numbers::pi) * view.rows;
        const double by_serving = std::fabs(aside) * way / std::max(range - way, view.cell_m) /
                                  (2.0 * std::numbers::pi) * view.rows;
        worst_rows = std::max(worst_rows, off - least - by_serving);
        const double seen = std::hypot(east, north);
        const double error = std::fabs(range + part.shift * view.cell_m - seen);
        // Shift of range within the least part.
        const double least_m = way * way * kLeastPart * view.cell_m / (2.0 * range * range);
        worst_m = std::max(worst_m, way > 0.0 ? (error - least_m) / way : error);
        worst_cells = std::max(worst_cells, error / view.cell_m);
      }
    });
    ASSERT_EQ(next, cells);
  }
  std::printf("worst: %.3f rows in bearing; in range %.3f of the way moved, %.2f cells\n",
              worst_rows, worst_m, worst_cells);
  EXPECT_LE(worst_rows, kMostOff + 0.02);
  EXPECT_LE(worst_m, 0.05);
  EXPECT_LE(worst_cells, 0.25);
}

}  // namespace
}  // namespace skerry::echo
