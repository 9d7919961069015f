#include "echo/clutter/speckle.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <set>

#include "echo/clutter/lattice_field.hpp"
#include "tests/unit/clutter/clutter_scene.hpp"

namespace skerry::echo {
namespace {

// Autocorrelation of a ring of values along and across, about its own mean.
double lattice_correlation(std::span<const float> ring, std::uint32_t along, std::uint32_t across) {
  double mean = 0.0, square = 0.0, product = 0.0;
  for (std::uint32_t i = 0; i < kLatticeSize; ++i) {
    mean += ring[i];
    square += double{ring[i]} * ring[i];
    product += double{ring[i]} * ring[(i + along + across * kLatticeStep) & kLatticeMask];
  }
  mean /= kLatticeSize;
  return (product / kLatticeSize - mean * mean) / (square / kLatticeSize - mean * mean);
}

TEST(LatticeField, CorrelatesAsAskedFor) {
  for (const auto& [along, across] : {std::pair{4.0, 4.0}, {8.0, 2.0}, {1.5, 6.0}}) {
    const std::vector<float> field = lattice_field(along, across, 3);
    // Independent values there are about so many; correlations scatter by one over their root.
    const double bound = 4.0 / std::sqrt(kLatticeSize / (1.57 * along * across));
    for (std::uint32_t d = 1; d <= 16; ++d) {
      EXPECT_NEAR(lattice_correlation(field, d, 0), std::exp(-1.0 * d * d / (along * along)), bound)
          << d;
      EXPECT_NEAR(lattice_correlation(field, 0, d), std::exp(-1.0 * d * d / (across * across)),
                  bound)
          << d;
    }
  }
}

TEST(LatticeField, OfNoLengthIsWhiteAndGaussian) {
  const std::vector<float> field = lattice_field(0.0, 0.0, 5);
  double fourth = 0.0;
  for (const float v : field) fourth += std::pow(double{v}, 4.0) / kLatticeSize;
  EXPECT_NEAR(fourth, 3.0, 4.0 * std::sqrt(96.0 / kLatticeSize));
  for (std::uint32_t d = 1; d <= 4; ++d) {
    EXPECT_NEAR(lattice_correlation(field, d, 0), 0.0, 4.0 / std::sqrt(kLatticeSize));
    EXPECT_NEAR(lattice_correlation(field, 0, d), 0.0, 4.0 / std::sqrt(kLatticeSize));
  }
}

TEST(LatticeField, RepeatsNoNearerThanItSays) {
  double nearest = 1e9;
  for (std::uint32_t across = 1; across < 1200; ++across) {
    const std::uint32_t at = across * kLatticeStep & kLatticeMask;
    const double along = std::min(at, kLatticeSize - at);
    nearest = std::min(nearest, std::sqrt(along * along + double{1} * across * across));
  }
  EXPECT_GE(nearest, 541.0);
}

TEST(Speckle, HasTheMomentsOfTheExponential) {
  for (const auto& [spokes, cells] : {std::pair{0.0, 0.0}, {5.0, 2.0}, {11.6, 8.0}, {40.0, 30.0}}) {
    const Speckle speckle(spokes, cells, 9);
    double mean = 0.0, decibels = 0.0, squares = 0.0;
    // The ring's values, read once each by walking across from its beginning.
    std::set<const float*> seen;
    std::uint32_t count = 0;
    for (std::uint32_t spoke = 0; count < kLatticeSize; ++spoke) {
      const auto row = speckle.row({1, 0, spoke, ~0u}, 16);
      if (!seen.insert(row.data()).second) break;
      for (const float v : row) {
        const double db = 10.0 * std::log10(double{v});
        mean += v, decibels += db, squares += db * db;
        EXPECT_GE(v, 1.9e-6f);
        EXPECT_LE(v, 13.2f);
        ++count;
      }
    }
    ASSERT_EQ(count, kLatticeSize);
    mean /= count, decibels /= count;
    const double deviation = std::sqrt(squares / count - decibels * decibels);
    std::printf("%4.1f spokes %4.1f cells: mean %.5f, decibels %.4f +- %.4f\n", spokes, cells, mean,
                decibels, deviation);
    EXPECT_NEAR(mean, 1.0, 2e-4);
    EXPECT_NEAR(decibels, -2.5068, 0.005);
    EXPECT_NEAR(deviation, 5.5700, 0.005);
  }
}

// Of spokes within a turn and of those that fade into the next.
TEST(Speckle, IsPackedWithinItsBound) {
  constexpr std::uint32_t kTurn = 2048, kCells = 700, kFrom = 64;
  const Speckle speckle(11.6, 2.0, 9);
  double worst = 0.0, mean = 0.0, packed_mean = 0.0;
  for (std::uint32_t spoke = 0; spoke < kTurn; ++spoke) {
    const auto row = speckle.row({1, 3, spoke, kTurn}, kCells, kFrom);
    const auto packed = speckle.packed_row({1, 3, spoke, kTurn}, kCells, kFrom);
    ASSERT_GE(packed.size(), kCells + kRowPadding);
    for (std::uint32_t i = kFrom; i < kCells; ++i) {
      const double value = row[i], kept = unpacked_value(packed[i]);
      worst = std::max(worst, std::fabs(kept / value - 1.0));
      mean += value, packed_mean += kept;
    }
  }
  std::printf("worst error of packing %.3g, of the mean %.2g\n", worst, packed_mean / mean - 1.0);
  EXPECT_LE(worst, 0x1p-8);
  EXPECT_NEAR(packed_mean / mean, 1.0, 1e-4);
}

// What two neighbours have is valid at the same time.
TEST(Speckle, KeepsTheRowsOfTwoSpokes) {
  constexpr std::uint32_t kTurn = 2048;
  const Speckle speckle(11.6, 2.0, 9);
  for (const std::uint32_t spoke : {100u, kTurn - 2}) {
    const auto first = speckle.packed_row({1, 3, spoke, kTurn}, 64);
    const std::vector<PackedPower> before(first.begin(), first.end());
    speckle.packed_row({1, 3, spoke + 1, kTurn}, 64);
    EXPECT_TRUE(std::equal(before.begin(), before.end(), first.begin())) << spoke;
  }
}

TEST(Speckle, CorrelatesAsTheSquareOfItsField) {
  constexpr double kSpokes = 6.0, kCells = 4.0;
  const Speckle speckle(kSpokes, kCells, 2);
  const auto measured = [&](std::uint32_t spokes, std::uint32_t cells) {
    double mean = 0.0, square = 0.0, product = 0.0;
    int count = 0;
    for (std::uint32_t s = 0; s < 4096; ++s) {
      const auto a = speckle.row({7, 0, s, 8192}, 256),
                 b = speckle.row({7, 0, s + spokes, 8192}, 256);
      for (std::uint32_t i = 0; i + 32 < 256; ++i) {
        mean += a[i], square += double{a[i]} * a[i], product += double{a[i]} * b[i + cells];
        ++count;
      }
    }
    mean /= count;
    return (product / count - mean * mean) / (square / count - mean * mean);
  };
  // 2^18 / (1.57 * 24 / 2) independent values of the power: four deviations are 0.034.
  for (std::uint32_t d = 1; d <= 12; ++d) {
    EXPECT_NEAR(measured(d, 0), std::exp(-2.0 * d * d / (kSpokes * kSpokes)), 0.035) << d;
    EXPECT_NEAR(measured(0, d), std::exp(-2.0 * d * d / (kCells * kCells)), 0.035) << d;
  }
}

TEST(Speckle, OfTwoTurnsIsUnrelated) {
  const Speckle speckle(8.0, 4.0, 2);
  double mean = 0.0, square = 0.0, product = 0.0;
  int count = 0;
  for (std::uint32_t scan = 0; scan < 200; ++scan) {
    for (std::uint32_t s = 0; s < 4096; s += 64) {
      const auto a = speckle.row({7, scan, s, 8192}, 512),
                 b = speckle.row({7, scan + 1, s, 8192}, 512);
      for (std::uint32_t i = 0; i < 512; i += 16) {
        mean += a[i], square += double{a[i]} * a[i], product += double{a[i]} * b[i];
        ++count;
      }
    }
  }
  mean /= count;
  EXPECT_NEAR((product / count - mean * mean) / (square / count - mean * mean), 0.0, 0.01);
}

// Mean square differences of neighbours, before the turn's end, at it and far from it.
TEST(Speckle, FadesFromTurnToTurnWithoutASeam) {
  for (const auto& [spokes, cells] : {std::pair{6.0, 4.0}, {24.0, 8.0}}) {
    const Speckle speckle(spokes, cells, 2);
    constexpr std::uint32_t kTurn = 1024;
    const std::uint32_t fading = speckle.fading_spokes(kTurn);
    const auto row = [&](std::uint64_t key, std::uint32_t running) {
      const auto values = speckle.row({key, running / kTurn, running % kTurn, kTurn}, 512);
      return std::vector<float>(values.begin(), values.end());
    };
    const auto steps = [&](std::uint32_t from, std::uint32_t to, double& mean) {
      double sum = 0.0, squares = 0.0, n = 0.0;
      for (std::uint64_t key = 0; key < 40; ++key) {
        std::vector<float> last = row(key, from);
        for (std::uint32_t s = from + 1; s <= to; ++s) {
          std::vector<float> now = row(key, s);
          for (std::uint32_t i = 0; i < 512; ++i) {
            sum += now[i], squares += std::pow(double{now[i]} - last[i], 2.0), n += 1.0;
          }
          last.swap(now);
        }
      }
      mean = sum / n;
      return squares / n;
    };
    double mean = 0.0, fading_mean = 0.0, ignored = 0.0;
    const double anywhere = steps(200, 400, mean);
    const double fades = steps(kTurn - fading + 1, kTurn - 2, fading_mean);
    const double begins = steps(kTurn - fading - 1, kTurn - fading, ignored);
    const double bow = steps(kTurn - 1, kTurn, ignored);
    std::printf("%.0f spokes: steps %.4f, fading %.4f, where it begins %.4f, at the bow %.4f\n",
                spokes, anywhere, fades, begins, bow);
    EXPECT_NEAR(mean, 1.0, 0.03);
    EXPECT_NEAR(fading_mean, 1.0, 0.06);
    EXPECT_NEAR(fades / anywhere, 1.0, 0.2);
    EXPECT_NEAR(begins / anywhere, 1.0, 0.35);
    EXPECT_NEAR(bow / anywhere, 1.0, 0.35);
  }
}

TEST(Speckle, IsAlignedAndAsLongAsAskedFor) {
  const Speckle speckle(2.0, 2.0, 2);
  const auto* const first = speckle.row({0, 0, 0, 16384}, 4096).data();
  for (std::uint32_t s = 0; s < 8192; s += 37) {
    const auto row = speckle.row({99, s % 5, s, 16384}, 4096);
    EXPECT_EQ(row.size(), 4096u);
    EXPECT_EQ((row.data() - first) % 16, 0);
  }
}

TEST(Speckle, IsSharedByRadarsOfTheSameCorrelation) {
  EXPECT_EQ(speckle_for(5.0, 3.0), speckle_for(5.1, 3.05));
  EXPECT_NE(speckle_for(5.0, 3.0), speckle_for(6.5, 3.0));
  EXPECT_EQ(speckle_for(0.0, 0.1), speckle_for(0.2, 0.0));
  EXPECT_EQ(speckle_for(96.0, 0.0), speckle_for(5000.0, 0.0));
}

TEST(SpeckleLengths, AreThoseOfBeamTimeAndPulse) {
  const RadarModel model = sea_radar(6.0);
  // Two-way voltage pattern of the beam by numbers: its autocorrelation falls to 1/e at this angle.
  const double width = model.set.beam_width_deg;
  const auto pattern = [&](double deg) { return std::exp2(-4.0 * deg * deg / (width * width)); };
  const auto overlap = [&](double apart) {
    double sum = 0.0;
    for (double a = -6.0; a < 6.0; a += 0.001) sum += pattern(a) * pattern(a + apart);
    return sum;
  };
  double apart = 0.0;
  while (overlap(apart) > overlap(0.0) / std::exp(1.0)) apart += 0.001;
  const double steady = speckle_lengths(model, 1e9).spokes;
  EXPECT_NEAR(steady * 360.0 / 4096.0, apart, 0.003);
  // A lifetime of 7.5 ms is 12.3 spokes.
  EXPECT_NEAR(speckle_lengths(model, 7.5e-3).spokes,
              1.0 / std::hypot(1.0 / steady, 1.0 / (7.5e-3 / (2.5 / 4096))), 1e-6);
  EXPECT_NEAR(speckle_lengths(model, 1.0).cells, (1.0 - std::exp(-1.0)) * model.pulse_cells, 1e-9);
}

}  // namespace
}  // namespace skerry::echo
