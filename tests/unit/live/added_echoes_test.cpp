// A simulated picture over a real one: where its echoes fall, how old they may be, the mark.
#include "server/live/added_echoes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <tuple>

namespace skerry::server {
namespace {

const UtcTime kMoment{std::chrono::seconds(1'800'000'000)};

struct Shape {
  std::uint32_t spokes = 512, cells = 512;
  std::uint8_t bits = 8;
  double reach_nm = 6.0;
  double heading_deg = 0.0;
};

Spoke spoke_of(const Shape& shape, std::uint32_t index, UtcTime utc = kMoment) {
  Spoke spoke;
  spoke.header.index = index;
  spoke.header.geometry = {shape.spokes, shape.cells, shape.bits};
  spoke.header.range_scale = *RangeScale::find(6.0);
  if (shape.reach_nm != 6.0) spoke.header.instrumented_range = nautical_miles(shape.reach_nm);
  spoke.header.heading = TrueBearing::from(degrees(shape.heading_deg));
  spoke.header.utc = utc;
  spoke.cells.assign(shape.cells, 0);
  return spoke;
}

// A turn with an echo at a true bearing and a range, in one cell.
void simulate(AddedEchoes& echoes, const Shape& shape, double bearing_deg, double range_m,
              std::uint8_t level, UtcTime utc = kMoment) {
  const auto to = to_relative(TrueBearing::from(degrees(bearing_deg)),
                              TrueBearing::from(degrees(shape.heading_deg)))
                      .nearest_spoke(shape.spokes);
  Sector sector;
  for (std::uint32_t i = 0; i < shape.spokes; ++i) {
    Spoke spoke = spoke_of(shape, i, utc);
    if (i == to) {
      spoke.cells[static_cast<std::size_t>(range_m / spoke.header.cell_size().in_metres())] = level;
    }
    sector.spokes.push_back(std::make_shared<Spoke>(std::move(spoke)));
  }
  echoes.take(sector);
}

std::vector<Spoke> real_turn(const Shape& shape) {
  std::vector<Spoke> spokes;
  for (std::uint32_t i = 0; i < shape.spokes; ++i) spokes.push_back(spoke_of(shape, i));
  return spokes;
}

// Without the letter astern.
struct Echo {
  double worst_range_m = 0.0, worst_bearing_deg = 0.0;
  std::size_t cells = 0;
  unsigned level = 0;
};
Echo echo_in(const std::vector<Spoke>& spokes, double bearing_deg, double range_m) {
  Echo echo;
  for (const Spoke& spoke : spokes) {
    const bool astern = std::abs(spoke.header.antenna().in_degrees() - 180.0) < 5.0;
    const double mark_m = 0.83 * spoke.header.range_scale.length().in_metres();
    for (std::size_t cell = 0; cell < spoke.cells.size(); ++cell) {
      const double from_m = static_cast<double>(cell) * spoke.header.cell_size().in_metres();
      if (spoke.cells[cell] == 0 || (astern && from_m > mark_m)) continue;
      ++echo.cells;
      echo.level = std::max<unsigned>(echo.level, spoke.cells[cell]);
      const double at = (static_cast<double>(cell) + 0.5) * spoke.header.cell_size().in_metres();
      const double off =
          (spoke.header.bearing() - TrueBearing::from(degrees(bearing_deg))).in_degrees();
      echo.worst_range_m = std::max(echo.worst_range_m, std::abs(at - range_m));
      echo.worst_bearing_deg = std::max(echo.worst_bearing_deg, std::abs(off));
    }
  }
  return echo;
}

class AddedEchoesTest : public testing::TestWithParam<std::tuple<Shape, Shape>> {};

// Over all geometries, headings and places: nothing is lost, and nothing is further off than a cell
// or a spoke of the coarser radar.
TEST_P(AddedEchoesTest, FallWithinACellAndASpoke) {
  const auto& [simulated, real] = GetParam();
  const double cell_m = std::max(spoke_of(simulated, 0).header.cell_size().in_metres(),
                                 spoke_of(real, 0).header.cell_size().in_metres());
  const double spoke_deg = 360.0 / std::min(simulated.spokes, real.spokes);
  for (const double bearing : {3.0, 121.3, 359.9}) {
    for (const double range_m : {150.0, 8000.0}) {
      AddedEchoes echoes;
      simulate(echoes, simulated, bearing, range_m,
               static_cast<std::uint8_t>((1u << simulated.bits) - 1));
      auto spokes = real_turn(real);
      echoes.add_to(spokes, true);
      const Echo echo = echo_in(spokes, bearing, range_m);
      EXPECT_GT(echo.cells, 0u) << bearing << " deg, " << range_m << " m";
      EXPECT_EQ(echo.level, (1u << real.bits) - 1u);
      EXPECT_LE(echo.worst_range_m, 1.5 * cell_m) << bearing << " deg, " << range_m << " m";
      EXPECT_LE(echo.worst_bearing_deg, 1.5 * spoke_deg) << bearing << " deg, " << range_m << " m";
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Geometries, AddedEchoesTest,
                         testing::Combine(testing::Values(Shape{}, Shape{4096, 1024, 8, 6.0, 214.3},
                                                          Shape{512, 512, 4, 12.0, 359.8}),
                                          testing::Values(Shape{2048, 1024, 4, 10.3, 31.7},
                                                          Shape{1440, 705, 8, 6.75, 0.0},
                                                          Shape{250, 252, 8, 9.0, 300.0})));

TEST(AddedEchoes, TheStrongerShows) {
  AddedEchoes echoes;
  simulate(echoes, {}, 90.0, 5000.0, 100);
  for (const auto& [real, expected] : {std::pair{50, 100}, std::pair{200, 200}}) {
    auto spokes = real_turn({});
    for (Spoke& spoke : spokes) std::fill(spoke.cells.begin(), spoke.cells.end(), real);
    echoes.add_to(spokes, true);
    const std::size_t cell =
        static_cast<std::size_t>(5000.0 / spokes[0].header.cell_size().in_metres());
    EXPECT_EQ(spokes[128].cells[cell], expected);
    EXPECT_EQ(spokes[128].cells[cell + 9], real);
  }
}

TEST(AddedEchoes, AreNorthUp) {
  AddedEchoes echoes;
  Shape simulated, real;
  simulated.heading_deg = 20.0;
  real.heading_deg = 110.0;
  simulate(echoes, simulated, 90.0, 5000.0, 255);
  auto spokes = real_turn(real);
  echoes.add_to(spokes, true);
  EXPECT_LE(echo_in(spokes, 90.0, 5000.0).worst_bearing_deg, 1.5 * 360.0 / 512);
  // A radar that knows no heading has the simulation's.
  spokes = real_turn({});
  echoes.add_to(spokes, false);
  EXPECT_LE(echo_in(spokes, 70.0, 5000.0).worst_bearing_deg, 1.5 * 360.0 / 512);
}

TEST(AddedEchoes, LeaveNoGapWhereTheShipTurns) {
  AddedEchoes echoes;
  Shape shape;
  Sector sector;
  for (std::uint32_t i = 0; i < shape.spokes; ++i) {
    shape.heading_deg = 0.1 * i;  // 51 deg in a turn
    Spoke spoke = spoke_of(shape, i);
    std::fill(spoke.cells.begin(), spoke.cells.end(), 77);
    sector.spokes.push_back(std::make_shared<Spoke>(std::move(spoke)));
  }
  echoes.take(sector);
  auto spokes = real_turn({});
  echoes.add_to(spokes, true);
  for (const Spoke& spoke : spokes) EXPECT_EQ(spoke.cells[100], 77) << spoke.header.index;
}

TEST(AddedEchoes, OfASilentSimulationGoAway) {
  AddedEchoes echoes;
  simulate(echoes, {}, 90.0, 5000.0, 255, kMoment - AddedEchoes::kHeld);
  auto spokes = real_turn({});
  echoes.add_to(spokes, true);
  EXPECT_EQ(echo_in(spokes, 90.0, 5000.0).cells, 0u);
}

TEST(AddedEchoes, BearAMarkAsternOnEveryPicture) {
  for (const Shape& shape :
       {Shape{}, Shape{2048, 1024, 4, 10.3, 31.7}, Shape{250, 252, 8, 9.0, 0.0}}) {
    auto spokes = real_turn(shape);
    for (Spoke& spoke : spokes) std::fill(spoke.cells.begin(), spoke.cells.end(), 1);
    AddedEchoes().add_to(spokes, true);
    const auto level = (1u << shape.bits) - 1u;
    std::size_t lit = 0, dark = 0;
    for (const Spoke& spoke : spokes) {
      const double off = spoke.header.antenna().in_degrees() - 180.0;
      for (std::size_t cell = 0; cell < spoke.cells.size(); ++cell) {
        const double part = (static_cast<double>(cell) + 0.5) *
                            spoke.header.cell_size().in_metres() /
                            spoke.header.range_scale.length().in_metres();
        const bool near_mark = std::abs(off) < 3.0 && part > 0.83 && part < 0.98;
        if (!near_mark) {
          EXPECT_EQ(spoke.cells[cell], 1);
        }
        lit += spoke.cells[cell] == level;
        dark += spoke.cells[cell] == 0;
      }
    }
    EXPECT_GE(lit, 20u);
    EXPECT_GT(dark, lit);
  }
}

TEST(AddedEchoes, TakeAnyGeometryAfterAnother) {
  AddedEchoes echoes;
  simulate(echoes, {}, 90.0, 5000.0, 255);
  simulate(echoes, {250, 16, 8, 6.0, 0.0}, 90.0, 5000.0, 255);
  simulate(echoes, {4096, 8192, 8, 12.0, 0.0}, 90.0, 5000.0, 255);
  for (const Shape& shape : {Shape{16, 16, 4, 0.25, 0.0}, Shape{8192, 8192, 8, 12.0, 5.0}}) {
    auto spokes = real_turn(shape);
    echoes.add_to(spokes, true);
  }
}

}  // namespace
}  // namespace skerry::server
