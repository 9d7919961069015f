// Levels of the three echo types against the radar equation written out again, the edges' sharpness
// and depth, and charted relief against brute force.
#include "echo/returns/shore_returns.hpp"

#include <gtest/gtest.h>

#include <GeographicLib/Geodesic.hpp>
#include <cmath>
#include <cstdio>
#include <random>

#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {
namespace {

constexpr GeoPoint kShip{60.0, 5.0};
constexpr double kArc = 0.0015, kAntenna = 20.0;

// 25 kW, 31 dB, 9.41 GHz, losses 3 dB, noise figure 5 dB, 10 MHz: received from sigma at R over
// k T B F.
double signal_to_noise(double sigma, double range) {
  const double gain = std::pow(10.0, 3.1), lambda = 299792458.0 / 9.41e9;
  const double received = 25e3 * gain * gain * lambda * lambda * sigma /
                          (std::pow(4.0 * M_PI, 3) * std::pow(range, 4) * std::pow(10.0, 0.3));
  return received / (1.380649e-23 * 290.0 * 10e6 * std::pow(10.0, 0.5));
}

double decibels(double ratio) { return 10.0 * std::log10(ratio); }

LandModel shore_model(double cell_m) {
  return {cell_m, kAntenna, kArc, unit_signal_to_noise(RadarSet{}, {0.1e-6, 10e6}), 9};
}

PictureShore shore_of(CoastType type) { return {type, false, 0.0f}; }

ShoreStretch stretch_of(CoastType type, double begin, double end) {
  const ShoreState state{shore_of(type), 0.0, 0.0};
  return {begin, end, {state, begin, false}, {state, end, false}};
}

std::vector<float> shore_power(std::vector<ShoreStretch> land, double cell_m,
                               std::size_t cells = 1024, const ShoreWater& water = {},
                               std::uint32_t bearing = 0x20000000u,
                               const ChartedRelief* relief = nullptr,
                               GroundProfile* profile = nullptr) {
  std::vector<float> power(cells, 0.0f);
  add_shores(land, shore_model(cell_m), water, lattice_path(kShip, {}, bearing, cell_m), relief,
             profile, power);
  return power;
}

// Mean power by metres behind the edge, over many places; cells of 5 m whose borders are the edge.
std::vector<double> mean_profile(CoastType type, const ShoreWater& water = {}) {
  std::vector<double> mean(200, 0.0);
  int n = 0;
  for (double begin = 2000.0; begin < 2100.0; begin += 5.0) {
    for (std::uint32_t k = 0; k < 16; ++k, ++n) {
      const auto power =
          shore_power({stretch_of(type, begin, begin + 1500.0)}, 5.0, 1024, water, k << 28);
      const auto first = static_cast<std::size_t>(begin / 5.0);
      for (std::size_t i = 0; i < mean.size(); ++i) {
        // To 2 km, as R^-3 has it.
        const double scale = std::pow((static_cast<double>(first + i) + 0.5) * 5.0 / 2000.0, 3);
        mean[i] += static_cast<double>(power[first + i]) * scale;
      }
    }
  }
  for (double& m : mean) m /= n;
  return mean;
}

TEST(ShoreReturns, AQuaysFaceIsThatOfTheRadarEquation) {
  for (const double range : {502.5, 2002.5, 4502.5}) {
    const auto power = shore_power({stretch_of(CoastType::artificial, range, range + 400.0)}, 5.0);
    const auto cell = static_cast<std::size_t>(range / 5.0);
    const double sigma = std::pow(10.0, -0.15) * 3.0 * range * kArc;
    EXPECT_NEAR(decibels(static_cast<double>(power[cell]) / signal_to_noise(sigma, range)), 0.0,
                0.01)
        << range;
  }
}

TEST(ShoreReturns, ARockyBankIsThatOfTheRadarEquationInTheMean) {
  const double sigma = std::pow(10.0, -0.8) * 4.0 * 2000.0 * kArc;
  EXPECT_NEAR(decibels(mean_profile(CoastType::rocky)[0] / signal_to_noise(sigma, 2000.0)), 0.0,
              0.7);  // the cover varies by place
}

// Sand rises 1 in 50 and lies open to the antenna above: what a cell shows across the line of sight
// is its rise and its length times the grazing angle.
TEST(ShoreReturns, ABeachIsThatOfTheRadarEquationInTheMean) {
  const auto mean = mean_profile(CoastType::sandy);
  double made = 0.0, expected = 0.0;
  for (int i = 7; i < 28; ++i) {  // dry sand, 35 to 140 m behind the edge
    const double inland = 5.0 * i + 2.5;
    const double grazing = (kAntenna - inland / 50.0) / 2000.0;
    const double sigma = 0.01 * 5.0 * (1.0 / 50.0 + grazing) * 2000.0 * kArc;
    made += mean[static_cast<std::size_t>(i)];
    expected += signal_to_noise(sigma, 2000.0);
  }
  EXPECT_NEAR(decibels(made / expected), 0.0, 0.7);
}

TEST(ShoreReturns, TypesDifferInLevelSharpnessAndDepth) {
  struct Shape {
    double peak, at_edge, half_after_m, deep_m;
  };
  const auto shape = [](CoastType type) {
    const auto mean = mean_profile(type);
    Shape s{0, mean[0], 0, 0};
    for (std::size_t i = 0; i < 30; ++i) s.peak = std::max(s.peak, mean[i]);
    while (mean[static_cast<std::size_t>(s.half_after_m / 5.0)] < 0.5 * s.peak)
      s.half_after_m += 5.0;
    for (std::size_t i = 0; i < mean.size() && mean[i] > 0.1 * s.peak; ++i) s.deep_m += 5.0;
    return s;
  };
  const Shape quay = shape(CoastType::artificial), rock = shape(CoastType::rocky),
              sand = shape(CoastType::sandy);
  for (const auto& [name, s] : {std::pair{"I artificial", quay}, std::pair{"II rocky", rock}}) {
    std::printf(
        "%-13s peak %6.1f dB, half of it %3.0f m behind the edge, within 10 dB for %.0f m\n", name,
        decibels(s.peak), s.half_after_m, s.deep_m);
  }
  std::printf(
      "III sandy     peak %6.1f dB, half of it %3.0f m behind the edge, edge cell %.1f dB "
      "below\n",
      decibels(sand.peak), sand.half_after_m, decibels(sand.peak / sand.at_edge));
  EXPECT_GT(decibels(quay.peak / rock.peak), 4.0);
  EXPECT_LT(decibels(quay.peak / rock.peak), 7.0);
  EXPECT_GT(decibels(rock.peak / sand.peak), 15.0);
  EXPECT_EQ(quay.half_after_m, 0.0);  // in one cell
  EXPECT_EQ(quay.deep_m, 5.0);
  EXPECT_EQ(rock.half_after_m, 0.0);
  EXPECT_GE(sand.half_after_m, 10.0);
  EXPECT_GT(decibels(sand.peak / sand.at_edge), 6.0);
}

TEST(ShoreReturns, NothingEchoesBeforeAnEdgeAcrossTheRay) {
  for (const CoastType type : {CoastType::artificial, CoastType::rocky, CoastType::sandy}) {
    for (double begin = 700.0; begin < 4000.0; begin += 61.7) {
      const auto power = shore_power({stretch_of(type, begin, begin + 800.0)}, 5.0);
      const auto first = static_cast<std::size_t>(begin / 5.0);
      for (std::size_t i = 0; i < first; ++i) ASSERT_EQ(power[i], 0.0f);
      double near = 0.0;
      for (std::size_t i = first; i < first + 10; ++i) near += static_cast<double>(power[i]);
      ASSERT_GT(near, 0.0);
      if (type == CoastType::artificial) {
        ASSERT_GT(static_cast<double>(power[first]), 0.8 * near);
      }
    }
  }
}

TEST(ShoreReturns, AFaceAlongTheRaySpreadsWhatItReturns) {
  ShoreStretch s = stretch_of(CoastType::artificial, 2002.5, 2600.0);
  const auto square = shore_power({s}, 5.0);
  s.face_near_m = 42.5, s.face_far_m = 57.5;  // cells 392 .. 411
  const auto along = shore_power({s}, 5.0);
  const double whole = static_cast<double>(square[400]) * std::pow(2002.5, 3);
  double sum = 0.0;
  for (std::size_t i = 392; i < 412; ++i) {
    EXPECT_GT(along[i], 0.0f);
    sum += (static_cast<double>(along[i]) - (i > 400 ? static_cast<double>(square[i]) : 0.0)) *
           std::pow((static_cast<double>(i) + 0.5) * 5.0, 3);
  }
  EXPECT_NEAR(sum / whole, 1.0, 1e-3);
  EXPECT_EQ(along[391], 0.0f);
}

TEST(ShoreReturns, PlainLandHasTheBitsOfAddLand) {
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 300; ++i) {
    const double cell = 2.0 + 40.0 * unit(random);
    std::vector<LandInterval> land;
    std::vector<ShoreStretch> stretches;
    double at = 0.0;
    for (int k = 0; k < 5; ++k) {
      const double begin = k == 0 && i % 3 == 0 ? 0.0 : at + 300.0 * cell * unit(random);
      at = begin + 200.0 * cell * unit(random);
      land.push_back({begin, at});
      stretches.push_back(stretch_of(k % 2 ? CoastType::rocky : CoastType::unknown, begin, at));
      stretches.back().end.state.shore.type = CoastType::rocky;
    }
    const auto bearing = static_cast<std::uint32_t>(random());
    std::vector<float> plain(1024, 0.0f);
    const LatticePath path = lattice_path(kShip, {}, bearing, cell);
    add_land(land, shore_model(cell), path, plain);
    GroundProfile profile;
    profile.clear(1024);
    ASSERT_EQ(shore_power(stretches, cell, 1024, {}, bearing), plain);
    ASSERT_EQ(shore_power(stretches, cell, 1024, {}, bearing, nullptr, &profile), plain);
  }
}

TEST(ShoreReturns, SandIsMadeAnewInTimeOnlyWhereThereAreWaves) {
  const auto at = [](CoastType type, double waves, double seconds) {
    const auto stretch = stretch_of(type, 2000.0, 3000.0);
    return shore_power({stretch}, 5.0, 1024, {0.0, waves, seconds, 9});
  };
  EXPECT_EQ(at(CoastType::sandy, 0.0, 1.0), at(CoastType::sandy, 0.0, 77.0));
  EXPECT_EQ(at(CoastType::rocky, 2.0, 1.0), at(CoastType::rocky, 2.0, 77.0));
  EXPECT_EQ(at(CoastType::artificial, 2.0, 1.0), at(CoastType::artificial, 2.0, 77.0));
  EXPECT_EQ(at(CoastType::sandy, 2.0, 1.0), at(CoastType::sandy, 2.0, 1.0));

  const auto one = at(CoastType::sandy, 2.0, 1.0), other = at(CoastType::sandy, 2.0, 77.0);
  const double wet = 30.0 + 2.0 * swash_m(2.0);
  int changed = 0;
  for (std::size_t i = 0; i < one.size(); ++i) {
    const double behind = (static_cast<double>(i) + 0.5) * 5.0 - 2000.0;
    if (behind > wet) {
      EXPECT_EQ(one[i], other[i]) << behind;
    } else if (one[i] != other[i]) {
      ++changed;
    }
  }
  EXPECT_GT(changed, 5);
}

// 8 x 8 km of hills on a raster of 15 m: finer than the finest synthetic roughness, so that the
// ground is the raster alone.
ElevationGrid hills() {
  ElevationGrid grid;
  grid.south_deg = 59.99, grid.west_deg = 4.98;
  grid.step_lat_deg = 15.0 / 111195.0, grid.step_lon_deg = 2.0 * grid.step_lat_deg;
  grid.rows = 620, grid.columns = 620;
  for (int r = 0; r < grid.rows; ++r) {
    for (int c = 0; c < grid.columns; ++c)
      grid.heights_m.push_back(static_cast<float>(20.0 + 3e-4 * r * r + 8.0 * std::sin(r / 9.0) +
                                                  6.0 * std::cos(c / 13.0 + r / 20.0)));
  }
  return grid;
}

// Heights at the geodesic's places, each cell against every nearer one.
TEST(ShoreReturns, ReliefIsThatOfTheRasterAtTheCell) {
  const ElevationGrid grid = hills();
  constexpr double kCell = 10.0, kBegin = 1000.0, kEnd = 7000.0;
  const LandModel model = shore_model(kCell);
  int shown_cells = 0, hidden_cells = 0;
  double worst = 0.0;
  for (const double bearing : {5.0, 10.0, 22.0, 35.0, 48.0, 60.0, 77.0, 83.0}) {
    const auto units = static_cast<std::uint32_t>(bearing / 360.0 * 4294967296.0);
    const ChartedRelief relief{grid, GroundTrack(kShip, {}, units)};
    const auto power =
        shore_power({stretch_of(CoastType::rocky, kBegin, kEnd)}, kCell, 1024, {}, units, &relief);
    const LatticePath path = lattice_path(kShip, {}, units, kCell);
    double steepest = -1e9;
    for (std::size_t i = 100; i < 700; ++i) {
      const double range = (static_cast<double>(i) + 0.5) * kCell;
      GeoPoint p;
      GeographicLib::Geodesic::WGS84().Direct(kShip.latitude_deg, kShip.longitude_deg, bearing,
                                              range, p.latitude_deg, p.longitude_deg);
      const double height = static_cast<double>(grid.at(p));
      ASSERT_GT(height, 0.0);
      const double drop = range * range / (2.0 * 6371000.0 * 4.0 / 3.0);
      const double slope = (height - kAntenna - drop) / range;
      // The bank, and what the first cell shows of itself over the sea, are other tests' matter.
      const bool near_shore = i < 102 || i > 697;
      const double shows = (slope - steepest) * range;
      if (!near_shore && shows > 0.05) {
        const double fine = relief_noise_reference(
            path.north0 +
                static_cast<double>(i) * (path.north1 + static_cast<double>(i) * path.north2),
            path.east0 +
                static_cast<double>(i) * (path.east1 + static_cast<double>(i) * path.east2),
            fine_octaves(kCell), model.seed ^ kFineSeed);
        const double sigma =
            std::pow(10.0, -0.8) * (1.0 + 0.8 * fine) * std::min(height, shows) * range * kArc;
        const double off =
            std::fabs(static_cast<double>(power[i]) / signal_to_noise(sigma, range) - 1.0);
        worst = std::max(worst, off * shows);
        EXPECT_LT(off * shows, 0.05 + 0.02 * shows) << bearing << " deg, " << range << " m";
        ++shown_cells;
      } else if (!near_shore && shows < -0.05) {
        EXPECT_EQ(power[i], 0.0f) << bearing << " deg, " << range << " m";
        ++hidden_cells;
      }
      steepest = std::max(steepest, slope);
    }
  }
  std::printf("raster relief: %d cells shown, %d hidden, heights off by %.3f m at most\n",
              shown_cells, hidden_cells, worst);
  EXPECT_GT(shown_cells, 200);
  EXPECT_GT(hidden_cells, 200);
}

TEST(ShoreReturns, WhereTheRasterHasNoDataReliefIsSynthetic) {
  ElevationGrid grid = hills();
  for (float& h : grid.heights_m) h = std::nanf("");
  const ChartedRelief empty{grid, GroundTrack(kShip, {}, 0x08000000u)};
  const std::vector<ShoreStretch> land = {stretch_of(CoastType::rocky, 1000.0, 4000.0)};
  // Without a raster the longer waves of the relief are joined between cells (natural_land.hpp).
  const auto with = shore_power(land, 10.0, 1024, {}, 0x08000000u, &empty);
  const auto without = shore_power(land, 10.0, 1024, {}, 0x08000000u);
  double sum = 0.0, difference = 0.0;
  for (std::size_t i = 0; i < with.size(); ++i) {
    sum += static_cast<double>(without[i]);
    difference += std::fabs(static_cast<double>(with[i]) - static_cast<double>(without[i]));
  }
  EXPECT_GT(sum, 0.0);
  EXPECT_LT(difference, 0.03 * sum);
}

// Raster posts of 30 m say 0.2 m at the shore: the bank is finer than they are.
TEST(ShoreReturns, ARasterKeepsTheBankAtTheEdge) {
  const ShoreStretch rock = stretch_of(CoastType::rocky, 1000.0, 4000.0);
  EXPECT_DOUBLE_EQ(charted_height(rock, 1000.0, 0.2, 30.0, 0.0), 4.0);
  EXPECT_DOUBLE_EQ(charted_height(rock, 1015.0, 0.2, 30.0, 0.0), 2.0);
  EXPECT_DOUBLE_EQ(charted_height(rock, 1040.0, 7.0, 30.0, 0.0), 7.0);
  EXPECT_DOUBLE_EQ(charted_height(rock, 1040.0, -2.0, 30.0, 0.0), 0.5);
  const ShoreStretch sand = stretch_of(CoastType::sandy, 1000.0, 4000.0);
  EXPECT_DOUBLE_EQ(charted_height(sand, 1000.0, 0.7, 30.0, 0.0), 0.7);
}

// Two charts, one land: away from the seam as if there were none.
TEST(ShoreReturns, ASeamIsNoCoast) {
  const ShoreState rock{shore_of(CoastType::rocky), 0.0, 0.0};
  const ShoreEnd begin{rock, 1000.0, false}, end{rock, 5000.0, false};
  const auto whole = shore_power({{1000.0, 5000.0, begin, end}}, 5.0);
  const auto seamed =
      shore_power({{1000.0, 2001.0, begin, end}, {2003.0, 5000.0, begin, end}}, 5.0);
  int echoing = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    if (i == 400) continue;  // the cell of the seam has both
    ASSERT_EQ(seamed[i], whole[i]) << i;
    echoing += whole[i] > 0.0f;
  }
  EXPECT_GT(echoing, 50);
  // Land that ends at a seam, sea beyond: no bank there, and no jump before it.
  const ShoreEnd seam{{}, 3000.0, true};
  const ShoreStretch cut{1000.0, 3000.0, begin, seam};
  EXPECT_EQ(ground_at(cut, 2999.0, 0.2, 0.2).height_m, land_height(1999.0, 0.2, 0.2));
  const ShoreStretch both{1000.0, 3000.0, seam, seam};
  EXPECT_EQ(ground_at(both, 1000.0, 0.2, 0.2).height_m, land_height(900.0, 0.2, 0.2));
}

TEST(ShoreReturns, BetweenTwoTypesTheGroundGoesOverWithoutAStep) {
  ShoreStretch s = stretch_of(CoastType::sandy, 1000.0, 1400.0);
  s.end.state.shore.type = CoastType::rocky;
  for (double r = 1000.0; r < 1400.0; r += 0.05) {
    ASSERT_LT(
        std::fabs(ground_at(s, r + 0.05, 0.4, -0.4).height_m - ground_at(s, r, 0.4, -0.4).height_m),
        0.05);
  }
  EXPECT_EQ(ground_at(s, 1000.0, 0.4, -0.4).height_m, 0.0);
  EXPECT_EQ(ground_at(s, 1400.0, 0.4, -0.4).height_m, 4.0);
}

}  // namespace
}  // namespace skerry::echo
