// The echo that a board's sweeps are cut from: that of the radar's own spokes, at the true time.
#include "server/radar/turn_echoes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <vector>

#include "server/app/options/radar_config.hpp"
#include "server/world/scenario.hpp"
#include "server/world/world.hpp"
#include "tests/unit/radar/open_sea.hpp"

namespace skerry::server {
namespace {

using Row = std::vector<float>;

class Turn : public testing::Test {
 protected:
  explicit Turn(const std::string& radar = "{range_nm: 6}")
      : scenario_(parse_scenario(
            "name: s\nseed: 3\nown_ships:\n  - {name: F, position: {lat: 60, lon: 5}, radars: [" +
                radar +
                "]}\ntargets:\n"
                "  - {name: a, position: {lat: 60.02, lon: 5}, course_deg: 90, speed_kn: 30}\n",
            "f")),
        timeline_(World(scenario_)),
        coast_(std::make_unique<OpenSea>(), 1, {}),
        airwaves_(1),
        unit_(radar_config(scenario_.own_ships(0).radars(0), 0, 0, 3), timeline_, coast_, airwaves_,
              0) {
    coast_.prepare_now(
        0, unit_.wish(timeline_.latest()->own_ships[0], unit_.config().controls.range_scale));
  }

  static Row copy(std::span<const float> row) { return {row.begin(), row.end()}; }
  // The cell of the strongest echo of the rows round the bow.
  static std::size_t strongest(TurnEchoes& echoes, std::uint64_t first, ScenarioTime when) {
    Row sum(TurnEchoes::kCells);
    for (std::uint64_t n = first; n < first + 16; ++n) {
      const auto row = echoes.row(n, when);
      std::transform(row.begin(), row.end(), sum.begin(), sum.begin(), std::plus<>());
    }
    return static_cast<std::size_t>(std::max_element(sum.begin(), sum.end()) - sum.begin());
  }

  scenario::Scenario scenario_;
  Timeline timeline_;
  CoastService coast_;
  Airwaves airwaves_;
  RadarUnit unit_;
};

TEST_F(Turn, CoversTheReachInCellsOfWholeTicks) {
  TurnEchoes echoes(unit_, timeline_, coast_, airwaves_);
  echoes.set({.reach_m = 15'350.0, .tick_m = 1.5});
  EXPECT_EQ(echoes.grid().rows_per_turn, 4096u);
  EXPECT_EQ(echoes.grid().cells, 4096u);
  EXPECT_NEAR(echoes.grid().cell_m, 4.5, 1e-9);
  EXPECT_EQ(echoes.grid().pulse, unit_.pulse_on_air());
  EXPECT_GT(echoes.grid().blind_m, 0.0);
  echoes.set({.reach_m = 1e9, .pulse_code = 1});
  EXPECT_NEAR(echoes.grid().cell_m * 4096, 96 * 1852.0, 1e-6) << "no range scale is longer";
  EXPECT_EQ(echoes.grid().pulse, unit_.config().set.pulses.front());
}

TEST_F(Turn, HoldsTheEchoOfTheSpokesOfAnEqualRadar) {
  TurnEchoes echoes(unit_, timeline_, coast_, airwaves_);
  echoes.set({.reach_m = 6 * 1852.0, .rpm = unit_.config().set.rpm});
  const echo::SpokeClock clock(unit_.config().set.rpm, 4096);
  const ScanGeometry geometry{4096, 4096, 8};
  echo::SpokeReturns returns(
      echo::radar_model(unit_.config().set, geometry, *RangeScale::find(6.0), clock, 0),
      echo::serial_for);
  SceneBuilder scenes({.own_ship = 0, .radar = 0, .seed = 3});
  for (std::uint64_t first = 4096; first < 4096 + 64; first += 16) {
    const ScenarioTime when = clock.time_of(first);
    const echo::PowerRows rows = returns.make(
        *scenes.build(timeline_.at(when), coast_.latest(0), airwaves_.get()), first, 16);
    for (std::uint64_t k = 0; k < 16; ++k) {
      const auto spoke = rows.cells.subspan(k * rows.pitch, 4096);
      ASSERT_EQ(copy(echoes.row(first + k, clock.time_of(first + k))), copy(spoke))
          << "row " << first + k;
    }
  }
}

TEST_F(Turn, HoldsTwoRowsAtATimeAcrossBlocks) {
  TurnEchoes echoes(unit_, timeline_, coast_, airwaves_);
  const echo::SpokeClock clock(24.0, 4096);
  for (std::uint64_t n = 0; n < 40; ++n) {
    const auto before = echoes.row(n, clock.time_of(n));
    const Row held = copy(before);
    const auto after = echoes.row(n + 1, clock.time_of(n + 1));
    ASSERT_EQ(copy(before), held) << "row " << n;
    ASSERT_NE(before.data(), after.data());
  }
}

TEST_F(Turn, ShowsWhatMovesWhereItIsAtTheTrueTime) {
  TurnEchoes echoes(unit_, timeline_, coast_, airwaves_);
  echoes.set({.reach_m = 11'000.0});
  const echo::SpokeClock clock(24.0, 4096);
  // 60.02 N is 2228 m ahead.  After standing still for 100 s the ship has gone 1543 m to the east:
  // she is 2710 m off, 34.7 deg to starboard.
  const std::uint64_t turn = 4096, bow = turn - 8;
  const double cell_m = echoes.grid().cell_m;
  EXPECT_NEAR(static_cast<double>(strongest(echoes, bow, clock.time_of(bow))) * cell_m, 2228, 60);
  const std::uint64_t there = turn + 395 - 8;
  EXPECT_NEAR(static_cast<double>(
                  strongest(echoes, there, clock.time_of(there) + std::chrono::seconds(100))) *
                  cell_m,
              2710, 60);
}

TEST_F(Turn, IsEmptyInStandbyAndFollowsThePulseOnTheAir) {
  TurnEchoes echoes(unit_, timeline_, coast_, airwaves_);
  echo::RadarControls controls = unit_.radar_controls();
  controls.transmit = false;
  unit_.set_radar_controls(controls);
  EXPECT_FALSE(echoes.radiates());
  const auto empty = echoes.row(0, ScenarioTime{});
  EXPECT_EQ(std::accumulate(empty.begin(), empty.end(), 0.0f), 0.0f);
  EXPECT_EQ(empty.size(), 4096u);
  controls.transmit = true;
  controls.pulse = echo::PulseChoice::long_pulse;
  unit_.set_radar_controls(controls);
  const auto row = echoes.row(16, ScenarioTime{});
  EXPECT_EQ(echoes.grid().pulse, unit_.config().set.pulses.back());
  EXPECT_EQ(row.size(), 4096u);
}

class NarrowTurn : public Turn {
 protected:
  NarrowTurn() : Turn("{beam_width_deg: 0.5}") {}
};

TEST_F(NarrowTurn, HasTwiceTheRows) {
  TurnEchoes echoes(unit_, timeline_, coast_, airwaves_);
  EXPECT_EQ(echoes.grid().rows_per_turn, 8192u);
}

}  // namespace
}  // namespace skerry::server
