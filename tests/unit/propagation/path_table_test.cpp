#include "echo/propagation/path_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "echo/propagation/propagation.hpp"

namespace skerry::echo {
namespace {

constexpr double kReach = 96.0 * 1852.0;

struct Case {
  Band band;
  double antenna_m, wave_m, k;
};
const Case kCases[] = {{Band::x, 15.0, 0.0, 4.0 / 3.0}, {Band::x, 30.0, 0.0, 4.0 / 3.0},
                       {Band::s, 15.0, 0.0, 4.0 / 3.0}, {Band::x, 15.0, 1.5, 4.0 / 3.0},
                       {Band::x, 4.0, 0.3, 0.8},        {Band::s, 45.0, 1.5, 4.0}};

PathConditions conditions_of(const Case& c) {
  RadarSet set;
  set.frequency_hz = c.band == Band::x ? 9.41e9 : 3.05e9;
  set.antenna_height_m = c.antenna_m;
  Atmosphere air;
  air.k_factor = c.k;
  return path_conditions(set, air, c.wave_m);
}

// Range and height spread evenly in their logarithms, as floats.
class Places {
 public:
  explicit Places(std::uint64_t seed) : random_(seed) {}
  void next() {
    range = static_cast<float>(100.0 * std::pow(kReach / 100.0, unit_(random_)));
    height = static_cast<float>(0.25 * std::pow(2000.0, unit_(random_)));
  }
  double range = 0.0, height = 0.0;

 private:
  std::mt19937_64 random_;
  std::uniform_real_distribution<double> unit_{0.0, 1.0};
};

struct Errors {
  std::vector<double> db;
  void add(double made, double truth) { db.push_back(std::fabs(10.0 * std::log10(made / truth))); }
  double at(double share) {
    std::sort(db.begin(), db.end());
    return db[static_cast<std::size_t>(share * static_cast<double>(db.size() - 1))];
  }
};

// An echo so much weaker than in free space is not seen.
constexpr double kLeast = 1e-12;

// In the depth of a null, where the power is more than 30 dB below free space, an error in dB says
// nothing: there the power itself is compared.
bool in_a_null(const PathConditions& c, double range, double height, double truth) {
  return truth < kNullDepth &&
         path_terms(c, range, height).difference_m > kFullDifference * c.wavelength_m;
}

TEST(PathTable, PointsStayWithinTheirBoundOfTheReference) {
  for (const Case& of : kCases) {
    const PathConditions c = conditions_of(of);
    const PathTable table(c, kReach);
    Places place(7);
    Errors errors;
    double nulls = 0.0;
    for (int i = 0; i < 15000; ++i) {
      place.next();
      const double truth = point_reference(c, place.range, place.height);
      if (truth < kLeast) continue;
      const double made = static_cast<double>(
          table.point(static_cast<float>(place.range), static_cast<float>(place.height)));
      if (in_a_null(c, place.range, place.height, truth))
        nulls = std::max(nulls, std::fabs(made - truth));
      else
        errors.add(made, truth);
    }
    std::printf("%s %2.0f m, waves %.1f m, k %.2f: p50 %.4f p99 %.3f max %.2f dB, nulls %.1e\n",
                of.band == Band::x ? "X" : "S", of.antenna_m, of.wave_m, of.k, errors.at(0.5),
                errors.at(0.99), errors.at(1.0), nulls);
    EXPECT_LT(errors.at(0.5), kPointBound.p50_db);
    EXPECT_LT(errors.at(0.99), kPointBound.p99_db);
    EXPECT_LT(errors.at(1.0), kPointBound.max_db);
    EXPECT_LT(nulls, kNullBound);
  }
}

TEST(PathTable, BodiesStayWithinTheirBoundOfTheReference) {
  for (const Case& of : kCases) {
    const PathConditions c = conditions_of(of);
    const PathTable table(c, kReach);
    Places place(11);
    Errors errors;
    for (int i = 0; i < 60; ++i) {
      place.next();
      const double truth = body_reference(c, place.range, place.height);
      if (truth < kLeast) continue;
      const float made =
          table.body(static_cast<float>(place.range), static_cast<float>(place.height));
      errors.add(static_cast<double>(made), truth);
    }
    std::printf("%s %2.0f m, waves %.1f m, k %.2f: p50 %.4f p99 %.3f max %.2f dB\n",
                of.band == Band::x ? "X" : "S", of.antenna_m, of.wave_m, of.k, errors.at(0.5),
                errors.at(0.99), errors.at(1.0));
    EXPECT_LT(errors.at(0.5), kBodyBound.p50_db);
    EXPECT_LT(errors.at(0.99), kBodyBound.p99_db);
    EXPECT_LT(errors.at(1.0), kBodyBound.max_db);
  }
}

// The lobes of 15 m over a calm sea in X band: nulls where height * clearance makes whole turns.
TEST(PathTable, NullsStandWhereTheyBelong) {
  const PathConditions c = conditions_of(kCases[0]);
  const PathTable table(c, kReach);
  for (double range : {300.0, 1500.0, 6000.0, 15000.0}) {
    // Twice as high as the first null of a flat Earth, and the least power found about it.
    const double lobe = c.wavelength_m * range / (2.0 * c.antenna_height_m);
    double least_truth = 1e9, at_truth = 0.0, least = 1e9, at = 0.0;
    for (double h = 2.6 * lobe; h < 3.4 * lobe + 20.0 * (range > 5000.0); h += 1e-4 * lobe) {
      const double truth = point_reference(c, range, h);
      const double made =
          static_cast<double>(table.point(static_cast<float>(range), static_cast<float>(h)));
      if (truth < least_truth) least_truth = truth, at_truth = h;
      if (made < least) least = made, at = h;
    }
    EXPECT_NEAR(at, at_truth, 2e-3 * lobe) << range;
  }
}

TEST(PathTable, IsContinuousAcrossItsNodes) {
  const PathTable table(conditions_of(kCases[3]), kReach);
  for (int octave = 6; octave < 16; ++octave)
    for (int node = 0; node < 16; ++node) {
      const float range = std::ldexp(1.0f + static_cast<float>(node) / 16.0f, octave);
      const float below = std::nextafter(range, 0.0f);
      for (float height : {0.25f, 1.0f, 3.7f, 16.0f, 100.0f}) {
        EXPECT_NEAR(table.point(below, height) / table.point(range, height), 1.0, 2e-3);
        EXPECT_NEAR(table.body(below, height) / table.body(range, height), 1.0, 2e-3);
        const float lower = std::nextafter(height, 0.0f);
        EXPECT_NEAR(table.point(range, lower) / table.point(range, height), 1.0, 2e-3);
      }
    }
}

TEST(PathTable, IsSharedByRadarsOfTheSameConditions) {
  const PathConditions c = conditions_of(kCases[0]);
  const auto one = path_table_for(c, 20e3), two = path_table_for(c, 20e3);
  EXPECT_EQ(one, two);
  PathConditions other = c;
  other.antenna_height_m += 0.5;
  EXPECT_NE(one, path_table_for(other, 20e3));
  EXPECT_NE(one, path_table_for(c, 40e3));
  EXPECT_EQ(one->point(3000.0f, 4.0f), PathTable(c, 20e3).point(3000.0f, 4.0f));
}

TEST(PathTable, ReachDoesNotChangeWhatLiesWithinIt) {
  const PathConditions c = conditions_of(kCases[3]);
  const PathTable near(c, 10e3), far(c, 400e3);
  EXPECT_LT(near.bytes(), far.bytes());
  for (float range = 40.0f; range < 10e3f; range *= 1.07f)
    EXPECT_EQ(near.point(range, 5.0f), far.point(range, 5.0f));
}

}  // namespace
}  // namespace skerry::echo
