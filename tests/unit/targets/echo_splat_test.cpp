#include "echo/targets/echo_splat.hpp"

#include <gtest/gtest.h>

#include "echo/kernel/hash.hpp"
#include "echo/radar/beam.hpp"
#include "tests/unit/targets/targets_support.hpp"

namespace skerry::echo {
namespace {

// The row of one spoke that looks straight at the points, all at bearing 0 of turn 1.
std::vector<float> row_ahead(const RadarModel& model, const std::vector<PointEcho>& points) {
  EchoSplat splat(model);
  return rows_of(model, splat, calm_scene(), points, 4096, 1)[0];
}

RadarModel model_with_pulse(double pulse_cells) {
  RadarModel model = model_at(1.5);
  model.pulse_cells = pulse_cells;
  return model;
}

TEST(EchoSplat, TheLeadingEdgeStandsAtItsTrueRangeToAFractionOfACell) {
  const RadarModel model = model_with_pulse(3.5);
  for (const double into : {0.0, 0.3, 0.5, 0.9}) {
    const std::vector<float> row =
        row_ahead(model, {echo_at((100.0 + into) * model.cell_m, 0.0, 50.0f)});
    EXPECT_EQ(row[99], 0.0f);
    EXPECT_NEAR(row[100], 50.0 * (1.0 - into), 2e-5) << into;
    EXPECT_NEAR(row[101], 50.0, 1e-5);
    EXPECT_NEAR(row[102], 50.0, 1e-5);
    const double end = into + 3.5;
    EXPECT_NEAR(row[103], 50.0 * std::min(1.0, end - 3.0), 2e-5) << into;
    EXPECT_NEAR(row[104], 50.0 * std::max(0.0, end - 4.0), 2e-5) << into;
    EXPECT_EQ(row[105], 0.0f);
  }
}

TEST(EchoSplat, APulseShorterThanACellFillsOne) {
  const RadarModel model = model_with_pulse(0.2);
  const std::vector<float> row = row_ahead(model, {echo_at(40.25 * model.cell_m, 0.0, 8.0f)});
  EXPECT_NEAR(row[40], 6.0, 1e-5);
  EXPECT_NEAR(row[41], 2.0, 1e-5);
  EXPECT_EQ(row[42], 0.0f);
}

TEST(EchoSplat, EndsWhereThePictureEnds) {
  const RadarModel model = model_with_pulse(7.3);
  for (const double at : {1023.9, 1020.0, 1016.7, 1024.0, 5000.0}) {
    const std::vector<float> row = row_ahead(
        model, {echo_at(at * model.cell_m, 0.0, 8.0f), echo_at(at * model.cell_m, 0.0, 8.0f)});
    EXPECT_EQ(row[1023] > 0.0f, at < 1024.0) << at;
  }
}

// Spokes are 0.088 deg apart; voltages are compared, for the power falls to nothing at the null.
TEST(EchoSplat, AcrossTheBeamAPointHasTheShapeOfTheTwoWayPattern) {
  const RadarModel model = model_at(6.0);
  for (const double bearing : {0.0, 0.03, 123.456, 359.99}) {
    const auto turn = turn_of(model, {echo_at(300.5 * model.cell_m, bearing, 1e6f)});
    double worst = 0.0;
    int seen = 0;
    for (std::uint32_t s = 0; s < 4096; ++s) {
      const double off = std::remainder(s * (360.0 / 4096) - bearing, 360.0);
      const double beam = model.set.beam_width_deg;
      const double expected =
          std::fabs(off) < 1.25 * beam ? std::pow(cosine_taper_voltage(off, beam), 2) : 0.0;
      const double got = std::sqrt(static_cast<double>(turn[s][301]) / 1e6);
      worst = std::max(worst, std::fabs(got - expected));
      seen += turn[s][301] > 0.0f;
    }
    EXPECT_LT(worst, 2e-5) << bearing;
    EXPECT_GT(seen, 30);
  }
}

TEST(EchoSplat, StrongPointsAreWiderThanWeakOnes) {
  const RadarModel model = model_at(6.0);
  const auto extent = [&](float power) {
    const auto turn = turn_of(model, {echo_at(300.0 * model.cell_m, 90.0, power)});
    int above = 0;
    for (const auto& row : turn) above += row[300] > 20.0f;
    return above * 360.0 / 4096 / model.set.beam_width_deg;
  };
  // Beams wide: 3 dB over the threshold, 13 dB, 40 dB.  Recorded: a quarter to a half when
  // weak, 1.0 to 1.5 when saturated (SOURCES.md "Pictures (e)").
  EXPECT_NEAR(extent(40.0f), 0.72, 0.1);
  EXPECT_NEAR(extent(400.0f), 1.4, 0.1);
  EXPECT_GT(extent(2e5f), 1.9);
}

TEST(EchoSplat, PointsOfOneBodyInterfereAndBodiesDoNot) {
  const RadarModel model = model_with_pulse(3.0);
  const double range = 50.0 * model.cell_m;
  const auto power = [&](std::uint32_t body, float phase) {
    return row_ahead(model,
                     {echo_at(range, 0.0, 9.0f, 1), echo_at(range, 0.0, 4.0f, body, phase)})[50];
  };
  EXPECT_NEAR(power(1, 0.0f), 25.0, 1e-4);
  EXPECT_NEAR(power(1, 0.5f), 1.0, 1e-4);
  EXPECT_NEAR(power(1, 0.25f), 13.0, 1e-4);
  EXPECT_NEAR(power(1, -0.5f), 1.0, 1e-4);
  for (const float phase : {0.0f, 0.3f, 0.5f}) EXPECT_NEAR(power(2, phase), 13.0, 1e-4);
}

// The mean over phases of |sum|^2 is the sum of powers, in every cell, partly filled or not.
TEST(EchoSplat, TheMeanOverPhasesIsTheSumOfPowers) {
  const RadarModel model = model_with_pulse(2.6);
  std::vector<PointEcho> points;
  for (int k = 0; k < 6; ++k) points.push_back(echo_at((80.0 + 0.37 * k) * model.cell_m, 0, 5.0f));
  std::vector<double> mean(1024, 0.0), sum(1024, 0.0);
  for (const PointEcho& p : points) {
    const std::vector<float> row = row_ahead(model, {p});
    for (std::size_t c = 0; c < row.size(); ++c) sum[c] += static_cast<double>(row[c]);
  }
  // Every point's phase runs through the circle at a speed of its own: all cross terms vanish.
  constexpr int kTurns = 64;
  constexpr int kSpeeds[6] = {0, 1, 4, 9, 15, 22};
  for (int n = 0; n < kTurns; ++n) {
    for (std::size_t k = 0; k < 6; ++k)
      points[k].phase = static_cast<float>(kSpeeds[k] * n % kTurns) / kTurns;
    const std::vector<float> row = row_ahead(model, points);
    for (std::size_t c = 0; c < row.size(); ++c) mean[c] += static_cast<double>(row[c]) / kTurns;
  }
  for (std::size_t c = 78; c < 90; ++c) EXPECT_NEAR(mean[c], sum[c], 1e-4) << c;
}

TEST(EchoSplat, FortyMetresAndTwoAndAHalfDegreesAreTwoPoints) {
  // MSC.192(79): on a scale of 1.5 NM, at half to all of its range.
  const RadarModel model = model_at(1.5);
  for (const double range : {1400.0, 2000.0, 2700.0}) {
    const std::vector<float> row =
        row_ahead(model, {echo_at(range, 0, 1e4f, 1), echo_at(range + 40.0, 0, 1e4f, 2)});
    const auto cell = [&](double r) { return static_cast<std::size_t>(r / model.cell_m); };
    EXPECT_GT(row[cell(range) + 1], 1e3f);
    EXPECT_GT(row[cell(range + 40.0) + 1], 1e3f);
    EXPECT_EQ(row[cell(range + 25.0)], 0.0f);

    const auto turn =
        turn_of(model, {echo_at(range, 40.0, 1e4f, 1), echo_at(range, 42.5, 1e4f, 2)});
    const auto at = [&](double deg) {
      return static_cast<double>(
          turn[static_cast<std::size_t>(std::lround(deg / 360.0 * 4096))][cell(range) + 1]);
    };
    EXPECT_GT(decibels(at(40.0) / at(41.25)), 20.0);
    EXPECT_GT(decibels(at(42.5) / at(41.25)), 20.0);
  }
}

TEST(EchoSplat, StrongPointsStandInTheSideLobesAllRound) {
  const RadarModel model = model_at(6.0);
  const AntennaPattern pattern(model.set);
  const float strong = 1e9f;
  const auto turn = turn_of(model, {echo_at(200.0 * model.cell_m, 180.0, strong)}, true);
  int near = 0, far = 0;
  for (std::uint32_t s = 0; s < 4096; ++s) {
    const double off = std::fabs(s * (360.0 / 4096) - 180.0);
    if (off < 1.26 * model.set.beam_width_deg) continue;
    const double got = static_cast<double>(turn[s][200]) / static_cast<double>(strong);
    const double limit = off < 10.0 ? model.set.near_side_lobe_db : model.set.far_side_lobe_db;
    if (off < 4.5) {
      ASSERT_NEAR(got, static_cast<double>(pattern.two_way(units_at(off))),
                  1e-4 * got + 0.051 / static_cast<double>(strong));
      ++near;
    } else if (off > 12.0) {
      ASSERT_LE(decibels(got + 1e-30), 2.0 * limit + 0.01) << off;
      ++far;
    }
  }
  EXPECT_GT(near, 60);
  EXPECT_GT(far, 3700);
  // Farther off they are those of the middle of the sector.
  const double off = 180.0 - (7.5 + 16 * 20) * 360.0 / 4096;
  EXPECT_NEAR(static_cast<double>(turn[16 * 20 + 3][200] / strong) /
                  static_cast<double>(pattern.two_way(units_at(off))),
              1.0, 0.1);
  const auto without = turn_of(model, {echo_at(200.0 * model.cell_m, 180.0, strong)}, false);
  const auto weak = turn_of(model, {echo_at(200.0 * model.cell_m, 180.0, 1e3f)}, true);
  for (std::uint32_t s = 0; s < 2000; ++s) {
    ASSERT_EQ(without[s][200], 0.0f);
    ASSERT_EQ(weak[s][200], 0.0f);
  }
}

// A ship is made of scatterers where the beam may meet her and of a few strong points elsewhere:
// never of both at once.
TEST(EchoSplat, ABodyUnderTheBeamIsNotLaidOnceMoreAsAStrongOne) {
  const RadarModel model = model_at(6.0);
  const Scene scene = calm_scene();
  const std::vector<PointEcho> ship = {echo_at(200.0 * model.cell_m, 0.0, 1e9f, 7)};
  EchoSplat splat(model);
  const SpokeAim from = aim_of(scene, model.clock, 4096), to = aim_of(scene, model.clock, 4111);
  std::vector<float> once(1024, 0.0f), both(1024, 0.0f), other(1024, 0.0f);
  splat.prepare(ship, from, to, StrongEchoes{{}, 1});
  splat.add(to, once);
  splat.prepare(ship, from, to, StrongEchoes{ship, 2});
  splat.add(to, both);
  EXPECT_EQ(once, both);
  std::vector<PointEcho> another = ship;
  another[0].body = 8;
  splat.prepare(ship, from, to, StrongEchoes{another, 3});
  splat.add(to, other);
  EXPECT_NEAR(other[200] / once[200], 2.0, 1e-4);
}

TEST(EchoSplat, IsTheSameInAnyOrderOfSpokesAndNeverDenormal) {
  const RadarModel model = model_at(3.0, 4096);
  std::vector<PointEcho> points;
  for (std::uint64_t k = 0; k < 4000; ++k) {
    const double power = std::pow(10.0, -5.0 + 27.0 * as_unit(mixed(1, k)));
    points.push_back(echo_at(7000.0 * as_unit(mixed(2, k)), 10.0 * as_unit(mixed(3, k)),
                             static_cast<float>(power), static_cast<std::uint32_t>(k % 300),
                             static_cast<float>(as_unit(mixed(4, k)))));
  }
  EchoSplat splat(model), again(model);
  const Scene scene = calm_scene();
  const auto rows = rows_of(model, splat, scene, points, 4096 + 32, 16, true);
  rows_of(model, again, scene, {}, 4096, 16, true);
  rows_of(model, again, scene, points, 4096 + 32, 16, true);
  for (std::uint32_t k = 16; k-- > 0;) {
    std::vector<float> row(4096, 0.0f);
    again.add(aim_of(scene, model.clock, 4096 + 32 + k), row);
    ASSERT_EQ(row, rows[k]);
    for (const float p : row) {
      const bool sound = p == 0.0f || std::isnormal(p);
      ASSERT_TRUE(sound && p >= 0.0f && p < 1e30f) << p;
    }
  }
}

}  // namespace
}  // namespace skerry::echo
