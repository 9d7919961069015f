#include "echo/rain/rain_profile.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <vector>

#include "echo/kernel/isa.hpp"
#include "tests/unit/rain/rain_reference.hpp"

namespace skerry::echo {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

RainCell area(RainKind kind, double east, double north, double radius) {
  RainCell cell;
  cell.centre = {east, north};
  cell.velocity = {5.0, 3.0};
  cell.radius_m = radius;
  cell.rate_mm_h = 10.0;
  cell.identity = 17;
  cell.kind = kind;
  return cell;
}

std::uint32_t units_of(double bearing) {
  return static_cast<std::uint32_t>(
      static_cast<std::int64_t>(bearing / (2.0 * std::numbers::pi) * 4294967296.0));
}

// Rows of 800 knots, 25 m apart, on bearings all round; beams of 0.5 to 6 deg.  Bound: 1e-3 of the
// greatest rate (float roundings: a place is known to 2e-4 of a value).
TEST(RainProfile, IsItsReferenceInDouble) {
  std::mt19937_64 random(4);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  double worst = 0.0;
  int wet = 0;
  for (int trial = 0; trial < 90; ++trial) {
    const RainCell cell = area(kFractalRain[trial % 3], 9000.0 * (unit(random) - 0.5),
                               9000.0 * (unit(random) - 0.5), 500.0 + 9000.0 * unit(random));
    const RainMapPtr map = rain_map_for(rain_map_key(cell, 1e4 * unit(random)));
    const double bearing = 2.0 * std::numbers::pi * unit(random);
    const double beam = kDegree * (0.5 + 5.5 * unit(random));
    const auto chord =
        find_rain_chord(cell, *map, cell.centre, sin_cos_units(units_of(bearing)), 20000.0);
    std::vector<float> rates(800, 0.0f);
    if (chord) add_rain(*chord, beam, 10.0, 25.0, rates);
    for (std::size_t j = 0; j < rates.size(); ++j) {
      const double range = 10.0 + 25.0 * static_cast<double>(j);
      // Beside the map the beam is cut off.
      if (!chord || range < chord->from_m || range >= chord->to_m) {
        EXPECT_EQ(rates[j], 0.0f);
        continue;
      }
      const double expected = rain_rate_at(cell, *map, {}, bearing, beam, range);
      wet += expected > 0.0 ? 1 : 0;
      worst = std::max(worst, std::fabs(static_cast<double>(rates[j]) - expected) /
                                  (cell.rate_mm_h * map->greatest()));
    }
  }
  std::printf("rain profile: worst error %.5f of the greatest rate at %d wet knots\n", worst, wet);
  EXPECT_GT(wet, 5000);
  EXPECT_LT(worst, 1e-3);
}

// Own ship in its middle; rain on both bearings along the band against both across it.
TEST(RainProfile, ASquallLineAtRestLiesAcrossTheWayItFaces) {
  const auto rain_on = [](const RainCell& cell, double bearing) {
    const RainMapPtr map = rain_map_for(rain_map_key(cell, 0.0));
    double sum = 0.0;
    for (const double way : {bearing, bearing + std::numbers::pi}) {
      const auto chord =
          find_rain_chord(cell, *map, cell.centre, sin_cos_units(units_of(way)), 20000.0);
      std::vector<float> rates(200, 0.0f);
      if (chord) add_rain(*chord, kDegree, 10.0, 25.0, rates);
      for (const float rate : rates) sum += static_cast<double>(rate > 0.0f);
    }
    return sum;
  };
  for (const double facing : {0.0, 90.0, 233.0}) {
    double along = 0.0, across = 0.0;
    for (std::uint64_t identity = 1; identity <= 20; ++identity) {
      RainCell cell = area(RainKind::squall_line, 0.0, 0.0, 4000.0);
      cell.velocity = {};
      cell.facing = {std::sin(facing * kDegree), std::cos(facing * kDegree)};
      cell.identity = identity;
      along += rain_on(cell, (facing + 90.0) * kDegree);
      across += rain_on(cell, facing * kDegree);
    }
    EXPECT_GT(along, 1.5 * across) << facing;
  }
}

// What the levels of the map are worth: against the mean over a Gaussian beam's two-way pattern, 61
// rays through the finest map.  Bound: 0.02 of the greatest rate, root mean square, and 0.2 at any
// place.
TEST(RainProfile, IsTheMeanOverTheBeam) {
  double worst = 0.0, squares = 0.0, count = 0.0;
  for (const RainKind kind : kFractalRain) {
    const RainCell cell = area(kind, 6000.0, 9000.0, 4000.0);
    const RainMapPtr map = rain_map_for(rain_map_key(cell, 500.0));
    for (const double beam : {0.8 * kDegree, 1.2 * kDegree, 3.6 * kDegree}) {
      for (double bearing = 10.0; bearing < 60.0; bearing += 1.7) {
        const auto chord = find_rain_chord(cell, *map, cell.centre,
                                           sin_cos_units(units_of(bearing * kDegree)), 20000.0);
        if (!chord) continue;
        std::vector<float> rates(200, 0.0f);
        add_rain(*chord, beam, 50.0, 100.0, rates);
        for (std::size_t j = 0; j < rates.size(); ++j) {
          const double range = 50.0 + 100.0 * static_cast<double>(j);
          if (range < chord->from_m || range >= chord->to_m) continue;
          double mean = 0.0, weights = 0.0;
          for (int k = -30; k <= 30; ++k) {
            const double aside = k / 30.0;  // beam widths
            const double weight = std::exp2(-8.0 * aside * aside);
            const double angle = bearing * kDegree + aside * beam;
            const PlanePoint place = PlanePoint{std::sin(angle), std::cos(angle)} * range;
            mean += weight * rain_share_at(cell, *map, place - cell.centre, 0);
            weights += weight;
          }
          const double error =
              (static_cast<double>(rates[j]) / cell.rate_mm_h - mean / weights) / map->greatest();
          worst = std::max(worst, std::fabs(error));
          squares += error * error, count += 1.0;
        }
      }
    }
  }
  std::printf("rain profile: against the beam %.4f of the greatest, rms %.4f\n", worst,
              std::sqrt(squares / count));
  EXPECT_LT(worst, 0.2);
  EXPECT_LT(std::sqrt(squares / count), 0.02);
}

TEST(RainProfile, LeavesOutWhatTheRayMisses) {
  const RainCell cell = area(RainKind::cell, 0.0, 8000.0, 2000.0);
  const RainMapPtr map = rain_map_for(rain_map_key(cell, 0.0));
  const auto chord = [&](double degrees, double reach) {
    return find_rain_chord(cell, *map, cell.centre, sin_cos_degrees(degrees), reach);
  };
  EXPECT_TRUE(chord(0.0, 20000.0));
  EXPECT_FALSE(chord(180.0, 20000.0));
  EXPECT_FALSE(chord(90.0, 20000.0));
  EXPECT_FALSE(chord(25.0, 20000.0));
  EXPECT_FALSE(chord(0.0, 5000.0));
}

TEST(RainProfile, HasTheSameBitsOnEveryInstructionSet) {
  const RainCell cell = area(RainKind::squall_line, 3000.0, 5000.0, 4000.0);
  const RainMapPtr map = rain_map_for(rain_map_key(cell, 77.0));
  const auto chord = find_rain_chord(cell, *map, cell.centre, sin_cos_degrees(31.0), 20000.0);
  ASSERT_TRUE(chord);
  std::vector<float> first;
  for (const Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
    force_isa(isa);
    std::vector<float> rates(500, 0.0f);
    add_rain(*chord, 0.02, 10.0, 20.0, rates);
    if (first.empty()) first = rates;
    EXPECT_EQ(rates, first) << name_of(isa);
  }
  force_isa(best_isa());
}

}  // namespace
}  // namespace skerry::echo
