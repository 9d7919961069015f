// The sea's statistics against their laws.
#include <gtest/gtest.h>

#include <algorithm>
#include <boost/math/special_functions/bessel.hpp>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "echo/clutter/gamma_law.hpp"
#include "echo/clutter/nrl_sea.hpp"
#include "tests/unit/clutter/clutter_scene.hpp"

namespace skerry::echo {
namespace {

// Share of K-distributed power over t, unit mean: 2 / Gamma(nu) (nu t)^(nu/2) K_nu(2 sqrt(nu t)).
double k_tail(double nu, double t) {
  if (t <= 0.0) return 1.0;
  const double z = std::sqrt(nu * t);
  return 2.0 * std::exp(nu * std::log(z) - std::lgamma(nu)) *
         boost::math::cyl_bessel_k(nu, 2.0 * z);
}

// The greatest difference of the two distributions over kLeast.
constexpr double kLeast = 1e-3;
double distance_to_k(std::vector<double> values, double nu) {
  std::sort(values.begin(), values.end());
  double worst = 0.0;
  const double n = static_cast<double>(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < kLeast) continue;
    const double below = 1.0 - k_tail(nu, values[i]);
    const auto rank = static_cast<double>(i);
    worst = std::max({worst, std::fabs(below - rank / n), std::fabs(below - (rank + 1.0) / n)});
  }
  return worst;
}

// Powers over their mean in a few cells of every 29th spoke (two beams and a spoke apart, so that
// all places between two rows and two bearings occur) of turns 10 s apart, in which texture and
// speckle have both been forgotten; and the block they are from.
struct Sample {
  std::vector<double> values;
  double nu = 0.0;
};
Sample sample_sea(const RadarModel& model, const Scene& scene, std::uint32_t cell,
                  std::uint32_t cell_step, int cells, int turns) {
  Sample sample;
  SeaReturns sea(model);
  for (int turn = 0; turn < turns; ++turn) {
    for (std::uint64_t s = 0; s < 4096; s += 29) {
      const std::uint64_t spoke = std::uint64_t(turn) * 4 * 4096 + s;
      for_spokes(sea, model, scene, spoke, 1, [&](const SpokeAim& aim, const auto& power) {
        const double off = (bearing_deg(aim) - scene.sea.wind_from_deg) * std::numbers::pi / 180.0;
        for (int k = 0; k < cells; ++k) {
          const std::uint32_t i = cell + static_cast<std::uint32_t>(k) * cell_step;
          const double wind = std::exp2(
              sea.profile().spread()[i / sea.profile().cells_per_sample()] * std::cos(off));
          sample.values.push_back(power[i] / (sea.profile().mean()[i] * wind));
        }
      });
    }
  }
  sample.nu = sea.profile().shape(cell / sea.profile().cells_per_sample() / kSamplesPerLaw, 0.0);
  return sample;
}

// Kolmogorov and Smirnov: of n independent values of the law the distance stays below
// 1.95 / sqrt(n) in 999 of 1000 cases.  Values here are independent of each other (two beams, three
// pulses or 10 s apart), but drawn from a ring of 2^18 / (1.57 * 4 * 4) = 10400 independent values
// of the field, whose own distribution is off by as much as that of 10400 values is: 1/n + 1/10400
// stands for 1/n.  On top come 0.01 for the table (0.14 dB) and for rows and samples joined by
// straight lines, whose variance is right but whose tails are not quite.
// Compared is what lies over -30 dB of the mean: the texture is cut at -42 dB (8 % of its values at
// nu 0.2), from where speckle takes it to -30 dB with a probability of exp(-16).
TEST(SeaStatistics, AmplitudesFollowTheKLaw) {
  struct Case {
    const char* name;
    double nm;
    Polarisation polarisation;
    double state;
    std::uint32_t cell, step;
  };
  constexpr Case kCases[] = {{"HH, 0.25 us, 3 NM scale", 3.0, Polarisation::hh, 4.0, 352, 21},
                             {"VV, 80 ns, 1.5 NM scale", 1.5, Polarisation::vv, 3.0, 320, 20},
                             {"HH, 80 ns, 1.5 NM scale", 1.5, Polarisation::hh, 5.0, 640, 20},
                             {"HH, 0.5 us, 6 NM scale", 6.0, Polarisation::hh, 4.0, 256, 24}};
  for (const Case& c : kCases) {
    RadarSet set;
    set.polarisation = c.polarisation;
    const RadarModel model = sea_radar(c.nm, set);
    const Sample sample = sample_sea(model, open_sea(c.state), c.cell, c.step, 2, 40);
    const double n = static_cast<double>(sample.values.size());
    const double bound = 1.95 * std::sqrt(1.0 / n + 1.0 / 10400.0) + 0.01;
    const double distance = distance_to_k(sample.values, sample.nu);
    double mean = 0.0, square = 0.0, spikes = 0.0;
    for (const double v : sample.values) mean += v / n, square += v * v / n, spikes += v > 10.0;
    std::printf(
        "%s: nu %.3f, distance %.4f (bound %.4f, of nu * 1.6: %.3f, / 1.6: %.3f), mean "
        "%.3f, over 10 dB %.4f (law %.4f)\n",
        c.name, sample.nu, distance, bound, distance_to_k(sample.values, 1.6 * sample.nu),
        distance_to_k(sample.values, sample.nu / 1.6), mean, spikes / n, k_tail(sample.nu, 10.0));
    EXPECT_LE(distance, bound) << c.name;
    EXPECT_GT(distance_to_k(sample.values, 1.6 * sample.nu), bound) << c.name;
    EXPECT_GT(distance_to_k(sample.values, sample.nu / 1.6), bound) << c.name;
    EXPECT_NEAR(spikes / n, k_tail(sample.nu, 10.0), 0.3 * k_tail(sample.nu, 10.0) + 0.001);
  }
}

// The law's shape at the cell's own grazing angle and area, against that of the contrast
// <I^2> / <I>^2 = 2 (1 + 1 / nu).
TEST(SeaStatistics, AreSpikierTheLowerTheGrazingAngle) {
  RadarSet set;
  set.polarisation = Polarisation::vv;
  const RadarModel model = sea_radar(1.5, set);
  double before = 1e9;
  for (const std::uint32_t cell : {48u, 192u, 960u}) {
    const Sample sample = sample_sea(model, open_sea(5.0), cell, 20, 2, 60);
    const double n = static_cast<double>(sample.values.size());
    double mean = 0.0, square = 0.0;
    for (const double v : sample.values) mean += v / n, square += v * v / n;
    const double contrast = 0.5 * square / (mean * mean) - 1.0;
    const double range = (cell + 10.5) * model.cell_m;
    const double psi = std::asin(sine_of_grazing(range, 20.0, 6371000.0 * 4.0 / 3.0));
    const double area =
        range * 0.7436 * 1.2 * std::numbers::pi / 180.0 * 0.5 * kLightSpeed * 0.08e-6;
    const double nu = k_shape(psi * 180.0 / std::numbers::pi, area, Polarisation::vv);
    std::printf("%.0f m, %.2f deg: nu %.2f, law there %.2f\n", range,
                psi * 180.0 / std::numbers::pi, 1.0 / contrast, nu);
    EXPECT_NEAR(1.0 / contrast, nu, 0.25 * nu);
    EXPECT_LT(nu, before);
    before = nu;
  }
}

// Decibels over the mean in a window of cells and spokes of one turn.
std::vector<double> window(const RadarModel& model, const Scene& scene, std::uint64_t first,
                           std::uint32_t cell, std::uint32_t cells, std::uint64_t spokes = 2048) {
  std::vector<double> values;
  SeaReturns sea(model);
  for_spokes(sea, model, scene, first, spokes, [&](const SpokeAim&, const auto& power) {
    for (std::uint32_t i = cell; i < cell + cells; ++i) {
      values.push_back(10.0 * std::log10(power[i] / sea.profile().mean()[i] + 1e-3));
    }
  });
  return values;
}

// Speckle is forgotten in a few spokes, texture in tens of metres and seconds.
TEST(SeaStatistics, SpeckleGoesInSpokesTextureStaysForSeconds) {
  const RadarModel model = sea_radar(3.0);
  const Scene scene = open_sea(4.0);
  constexpr std::uint32_t kCells = 64;
  const std::vector<double> now = window(model, scene, 4096, 300, kCells);
  const auto at_spoke_lag = [&](std::uint64_t lag) {
    return correlation(now, window(model, scene, 4096 + lag, 300, kCells));
  };
  const auto at_turn_lag = [&](std::uint64_t turns) {
    return correlation(now, window(model, scene, 4096 * (1 + turns), 300, kCells));
  };
  std::printf("log video, spoke lag 1 2 4 8 16 32: %.2f %.2f %.2f %.2f %.2f %.2f\n",
              at_spoke_lag(1), at_spoke_lag(2), at_spoke_lag(4), at_spoke_lag(8), at_spoke_lag(16),
              at_spoke_lag(32));
  const double one = at_turn_lag(1), four = at_turn_lag(4);
  std::printf("turn lag 1 4: %.2f %.2f\n", one, four);
  EXPECT_GT(at_spoke_lag(1), 0.85);
  EXPECT_LT(at_spoke_lag(16), at_spoke_lag(4));
  EXPECT_LT(at_spoke_lag(32), 0.15);
  // A turn later, 2.5 s, the speckle is new and the texture has gone on by a group's 12 m.
  EXPECT_GT(one, 0.05);
  EXPECT_LT(one, 0.6);
  EXPECT_NEAR(four, 0.0, 0.06);
}

TEST(SeaStatistics, TheTextureStaysWithTheSeaWhenTheShipMoves) {
  const RadarModel model = sea_radar(3.0);
  Scene still = open_sea(4.0), moved = open_sea(4.0);
  // Bow to the north, the ship ten cells further on: what was ahead is ten cells nearer.
  constexpr std::uint32_t kCells = 64, kAhead = 10;
  moved.own_ship.north_m = kAhead * model.cell_m;
  const auto ahead = [&](const Scene& scene, std::uint32_t cell) {
    // Spokes 0 to 63, 5.6 deg, of many turns.
    std::vector<double> values;
    for (std::uint64_t turn = 1; turn <= 40; ++turn) {
      const auto part = window(model, scene, turn * 4096, cell, kCells, 64);
      values.insert(values.end(), part.begin(), part.end());
    }
    return values;
  };
  const std::vector<double> first = ahead(still, 300);
  // The same turn, hence the same speckle by spoke and cell, shifted: that must not correlate; what
  // does is the sea.
  const double with_sea = correlation(first, ahead(moved, 300 - kAhead));
  const double without = correlation(first, ahead(moved, 300 + 3 * kAhead));
  std::printf("moved with the sea %.2f, against it %.2f\n", with_sea, without);
  EXPECT_GT(with_sea, 0.3);
  EXPECT_LT(without, 0.5 * with_sea);
}

}  // namespace
}  // namespace skerry::echo
