#include "echo/coast_tool/figure_sheet.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <tuple>

#include "tests/scenes/charts.hpp"

namespace skerry::echo {
namespace {

const RangeScale kScale = *RangeScale::find(1.5);

FigureCoast made_up_coast() {
  return {scenes::made_up_chart(scenes::kBergen, nautical_miles(2.0), 30, 7), scenes::kBergen,
          kScale};
}

TEST(FigureCoast, PrintedCoastHasTheChartsVerticesAndAsManyPointsAsCounted) {
  const FigureCoast coast = made_up_coast();
  const CoastPicture& chart = coast.straight();
  const CoastPicturePtr koch = coast.printed({.iterations = 2, .control_value_px = 0.0});
  ASSERT_EQ(koch->run_starts.size(), chart.run_starts.size());
  EXPECT_EQ(koch->edge_count(), 16 * chart.edge_count());
  for (std::size_t run = 0; run + 1 < chart.run_starts.size(); ++run) {
    for (std::uint32_t v = chart.run_starts[run]; v < chart.run_starts[run + 1]; ++v) {
      const PlanePoint p = koch->vertices[koch->run_starts[run] + 16 * (v - chart.run_starts[run])];
      // Through pixels of 5.6 m and back.
      EXPECT_NEAR(p.east_m, chart.vertices[v].east_m, 1e-8);
      EXPECT_NEAR(p.north_m, chart.vertices[v].north_m, 1e-8);
    }
  }
  EXPECT_EQ(coast.printed({.method = CoastMethod::straight})->edge_count(), chart.edge_count());
}

TEST(FigureCoast, RefusesAPlaceWithoutACoast) {
  EXPECT_THROW(FigureCoast(scenes::made_up_chart(scenes::kBergen, nautical_miles(2.0), 0, 7),
                           scenes::kBergen, kScale),
               std::invalid_argument);
}

TEST(FigureCoast, EchoBeginsWhereLandDoes) {
  const FigureCoast coast = made_up_coast();
  const LandByRay land(coast.straight());
  const Scan scan = coast.scan_of(coast.printed({.method = CoastMethod::straight}));
  ASSERT_TRUE(scan.is_complete());
  const double cell_m = scan.geometry.cell_size(kScale).in_metres();
  int with_land = 0, with_echo = 0;
  for (std::uint32_t spoke = 0; spoke < scan.geometry.spokes_per_turn; spoke += 16) {
    const double bearing = 360.0 * spoke / scan.geometry.spokes_per_turn;
    std::uint32_t first = 0;
    while (first < scan.geometry.cells && !land.is_land(bearing, (first + 0.5) * cell_m)) ++first;
    if (first + 20 > scan.geometry.cells) continue;
    ++with_land;
    const auto& cells = scan.spokes[spoke]->cells;
    with_echo += *std::max_element(cells.begin() + first, cells.begin() + first + 20) > 60;
  }
  EXPECT_GT(with_land, 40);
  EXPECT_GE(with_echo, with_land * 95 / 100);
}

TEST(FigureSheet, GrowsByRowsAndDrawsInEveryPanel) {
  const FigureCoast coast = made_up_coast();
  FigureSheet sheet(coast, "Title");
  sheet.begin_row("Heading", "Remark");
  for (int i = 0; i < 5; ++i) {
    sheet.add_coast(*coast.printed({.iterations = 1}), "1 iteration");
  }
  sheet.begin_row("Echo", "");
  sheet.add_echo(coast.corrected({}), "corrected");
  const RgbaImage image = sheet.take();
  EXPECT_GT(image.height, 3 * FigureSheet::kPanel);
  EXPECT_LT(image.height, 3 * (FigureSheet::kPanel + 120) + 120);
  EXPECT_EQ(image.pixels.size(), static_cast<std::size_t>(image.width) * image.height);
  // Every panel has many colours where it was drawn; the three left empty in row 2 have one.
  const auto colours_in = [&](int left, int top) {
    std::set<std::tuple<int, int, int>> colours;
    for (int y = top; y < top + 200; ++y) {
      for (int x = left; x < left + 200; ++x) {
        const Rgba p = image.at(x, y);
        colours.insert({p.red, p.green, p.blue});
      }
    }
    return colours.size();
  };
  const int pitch = image.width / FigureSheet::kColumns;
  const int row1 = 88 + 58 + 115, row2 = row1 + FigureSheet::kPanel + 40;
  for (int column = 0; column < FigureSheet::kColumns; ++column) {
    EXPECT_GT(colours_in(column * pitch + 115, row1), 10u) << column;
    EXPECT_EQ(colours_in(column * pitch + 115, row2) == 1, column > 0) << column;
  }
}

}  // namespace
}  // namespace skerry::echo
