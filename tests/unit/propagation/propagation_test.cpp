#include "echo/propagation/propagation.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/propagation/radio.hpp"

namespace skerry::echo {
namespace {

double db(double ratio) { return 10.0 * std::log10(ratio); }

RadarSet set_of(Band band, double antenna_m) {
  RadarSet set;
  set.frequency_hz = band == Band::x ? 9.41e9 : 3.05e9;
  set.antenna_height_m = antenna_m;
  return set;
}

double horizon_of(const PathConditions& c, double height) {
  return std::sqrt(2.0 * c.effective_earth_m) * (std::sqrt(c.antenna_height_m) + std::sqrt(height));
}

// In steps of at most 25 m and half a hundredth: no jump, and over a calm sea it only ever falls.
TEST(Propagation, FallsWithoutAStepFromTheLastLobeToFarBeyondTheHorizon) {
  for (Band band : {Band::x, Band::s})
    for (double wave : {0.0, 2.0})
      for (double height : {1.0, 3.5, 10.0, 60.0}) {
        const PathConditions c = path_conditions(set_of(band, 15.0), {}, wave);
        const double horizon = horizon_of(c, height);
        double before = 1e9, steepest = 0.0, rise = 0.0;
        bool last = false;
        for (double r = 0.05 * horizon; r < 2.0 * horizon; r += std::min(25.0, 0.005 * r)) {
          const double turns = path_terms(c, r, height).difference_m / c.wavelength_m;
          if (turns > 0.5) continue;
          const double level = db(point_reference(c, r, height));
          if (last) {
            steepest = std::max(steepest, before - level);
            rise = std::max(rise, level - before);
          }
          last = true;
          before = level;
        }
        EXPECT_LT(steepest, 0.15) << height;
        EXPECT_LT(rise, wave > 0.0 ? 0.03 : 0.001) << height;
      }
}

TEST(Propagation, BeyondTheHorizonIsTheSmoothEarths) {
  const PathConditions c = path_conditions(set_of(Band::x, 15.0), {}, 0.0);
  // SOURCES.md "Propagation": 16 and 20 NM, 15 and 10 m: -16.58 and -30.07 dB one way, gas apart.
  const double gas = 2.0 * 0.0136 * 1.852;
  EXPECT_NEAR(db(point_reference(c, 16.0 * kMile, 10.0)) + 16.0 * gas, -2.0 * 16.58, 0.011);
  EXPECT_NEAR(db(point_reference(c, 20.0 * kMile, 10.0)) + 20.0 * gas, -2.0 * 30.07, 0.011);
}

TEST(Propagation, WhereTheSmoothEarthBeginsToCost) {
  const auto share = [](double height) {
    const PathConditions c = path_conditions(set_of(Band::x, 15.0), {}, 0.0);
    const double horizon = horizon_of(c, height);
    double at = 0.02;
    while (path_terms(c, at * horizon, height).difference_m > kFullDifference * c.wavelength_m)
      at += 0.001;
    return at;
  };
  std::printf("full clearance ends at %.2f, %.2f of the horizon for 3.5, 60 m\n", share(3.5),
              share(60.0));
  EXPECT_NEAR(share(3.5), 0.52, 0.01);
  EXPECT_NEAR(share(60.0), 0.83, 0.01);
}

TEST(Propagation, ADuctTakesItsShareOfTheLoss) {
  const RadarSet set = set_of(Band::x, 15.0);
  const auto level = [&](double ducting) {
    Atmosphere air;
    air.ducting = ducting;
    const PathConditions c = path_conditions(set, air, 0.0);
    return db(point_reference(c, 30.0 * kMile, 10.0)) + 2.0 * 30.0 * 1.852 * c.gas_db_km;
  };
  EXPECT_NEAR(level(1.0), 0.0, 1e-9);
  EXPECT_NEAR(level(0.5), 0.5 * level(0.0), 1e-9);
  EXPECT_LT(level(0.0), -100.0);
}

TEST(Propagation, MoreBendingSeesFarther) {
  const RadarSet set = set_of(Band::x, 15.0);
  double before = 0.0;
  for (double k : {0.8, 1.0, 4.0 / 3.0, 2.0, 4.0}) {
    Atmosphere air;
    air.k_factor = k;
    const Propagation p(set, air, 0.0, 60e3);
    EXPECT_NEAR(p.effective_earth_m(), k * 6371e3, 1e-6);
    const double level = static_cast<double>(p.point(14.0 * kMile, 3.5));
    EXPECT_GT(level, before);
    before = level;
  }
}

// SOURCES.md "Propagation" at 12 NM: 0.60 dB two-way.
TEST(Propagation, GasTakesItsDecibels) {
  const Propagation x(set_of(Band::x, 15.0), {}, 0.0, 60e3),
      s(set_of(Band::s, 15.0), {}, 0.0, 60e3);
  EXPECT_NEAR(db(x.gas(12.0 * kMile)), -0.60, 0.005);
  EXPECT_NEAR(db(x.gas(10e3)), -0.272, 0.0005);
  EXPECT_NEAR(db(s.gas(10e3)), -0.150, 0.0005);
  EXPECT_EQ(x.gas(0.0), 1.0f);
}

TEST(Propagation, Horizon) {
  const Propagation p(set_of(Band::x, 15.0), {}, 0.0, 60e3);
  EXPECT_NEAR(p.horizon_m(), 4121.8 * std::sqrt(15.0), 0.2);
}

TEST(Propagation, HiddenHeightIsThatOfTheRoundEarthLessTheDuctsShare) {
  Atmosphere air;
  const Propagation p(set_of(Band::x, 20.0), air, 0.0, 60e3);
  EXPECT_EQ(p.hidden_height(10e3), 0.0);
  const double beyond = 40e3 - p.horizon_m();
  EXPECT_NEAR(p.hidden_height(40e3), beyond * beyond / (2.0 * p.effective_earth_m()), 1e-9);
  air.ducting = 0.25;
  EXPECT_NEAR(Propagation(set_of(Band::x, 20.0), air, 0.0, 60e3).hidden_height(40e3),
              0.75 * p.hidden_height(40e3), 1e-9);
}

TEST(Propagation, OneWayIsTheRootOfTwoWays) {
  const Propagation p(set_of(Band::x, 20.0), {}, 0.5, 60e3);
  for (double r : {500.0, 5e3, 20e3, 50e3})
    EXPECT_NEAR(p.one_way(r, 6.0) * p.one_way(r, 6.0) / p.point(r, 6.0), 1.0, 1e-6);
}

// SOURCES.md "Propagation": the mean of 16 sin^4 is 6, +7.78 dB; a rough sea leaves the direct ray
// alone.
TEST(Propagation, ATallBodyNearbyHasTheMeanOfTheLobes) {
  const Propagation calm(set_of(Band::x, 20.0), {}, 0.0, 60e3);
  EXPECT_NEAR(db(calm.body(2000.0, 40.0) / calm.gas(2000.0)), 7.78, 0.15);
  const Propagation rough(set_of(Band::x, 20.0), {}, 6.0, 60e3);
  EXPECT_NEAR(db(rough.body(600.0, 40.0) / rough.gas(600.0)), 0.0, 0.7);
}

TEST(Propagation, NothingIsEverOutOfBounds) {
  for (double ducting : {0.0, 1.0})
    for (double k : {0.8, 4.0}) {
      Atmosphere air{k, ducting};
      const Propagation p(set_of(Band::x, 12.0), air, 0.0, 96.0 * kMile);
      for (double r : {-5.0, 0.0, 0.3, 1.0, 31.0, 32.0, 1e3, 7e4, 177e3, 178e3, 1e6, 1e30})
        for (double h : {-3.0, 0.0, 0.1, 0.25, 5.0, 4094.0, 4095.0, 1e5, 1e30})
          for (float value : {p.point(r, h), p.body(r, h), p.one_way(r, h), p.gas(r)}) {
            EXPECT_TRUE(std::isnormal(value)) << r << ' ' << h << ' ' << value;
            EXPECT_GT(value, 1e-30f);
            EXPECT_LE(value, 16.0f * 1.0001f);
          }
    }
}

}  // namespace
}  // namespace skerry::echo
