// Statistics of real radar pictures that do not depend on the site (SOURCES.md "Pictures (e) to
// (h)"), for sets like the recorded ones.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "echo/kernel/hash.hpp"
#include "echo/measure/picture_score.hpp"
#include "echo/radar/shipped_sets.hpp"
#include "tests/scenes/moving_scene.hpp"
#include "tests/validation/target_trial.hpp"

namespace skerry::validation {
namespace {

// ---- e) Azimuth extent of points by strength --------------------------------------------------

struct Extents {
  std::vector<double> strong, medium, weak;  // degrees
};

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return std::nan("");
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Points of 0.1 to 50 m2, rings of them 1.8 km off, 10 deg apart: the longest run of spokes on
// which each is seen, by the level it reaches: saturated, upper or lower half of the levels.
Extents extents_of(const std::string& set_name) {
  Extents extents;
  for (std::uint64_t ring = 0; ring < 12; ++ring) {
    const double range = 1800.0;
    TargetTrial trial({.set = echo::find_set(set_name),
                       .scale = *RangeScale::find(1.5),
                       .antenna_height_m = 10.0,
                       .gain = 50.0,
                       .integration = 100.0,
                       .geometry = {2048, 1024, 4}},
                      [&](echo::Scene& scene) {
                        scene.wave_height_m = 0.5;
                        for (std::uint64_t i = 0; i < 36; ++i) {
                          echo::PointTarget point;
                          point.place = off(scene.own_ship, range, 10.0 * double(i));
                          point.identity = ring * 36 + i;
                          point.x_band_m2 =
                              0.1 * std::pow(500.0, echo::as_unit(echo::mixed(5, point.identity)));
                          scene.points.push_back(point);
                        }
                      });
    const auto video = trial.video(0, 0, 2048);
    const auto first = static_cast<std::uint32_t>((range - 5.0) / trial.cell_m());
    const auto last = static_cast<std::uint32_t>((range + 25.0) / trial.cell_m());
    for (std::uint32_t i = 1; i < 35; ++i) {
      const auto middle = static_cast<std::int64_t>(i * 10.0 / 360.0 * 2048.0);
      std::uint8_t peak = 0;
      std::uint32_t run = 0, longest = 0, gap = 0;
      for (std::int64_t k = middle - 28; k <= middle + 28; ++k) {
        std::uint8_t most = 0;
        for (std::uint32_t cell = first; cell <= last; ++cell) {
          most = std::max(most, video[static_cast<std::size_t>(k) * 1024 + cell]);
        }
        peak = std::max(peak, most);
        gap = most > 0 ? 0 : gap + 1;
        if (gap > 1) run = 0;
        if (most > 0) longest = std::max(longest, ++run);
      }
      if (peak == 0) continue;
      (peak == 15  ? extents.strong
       : peak >= 8 ? extents.medium
                   : extents.weak)
          .push_back(longest * 360.0 / 2048.0);
    }
  }
  return extents;
}

class AzimuthExtent : public ::testing::TestWithParam<std::string> {};

// Recorded: saturated points are 1.0 to 1.5 beams wide, weak ones about a quarter (e).
TEST_P(AzimuthExtent, OfAPointGrowsWithItsStrengthAsRecorded) {
  const double beam = echo::find_set(GetParam()).beam_width_deg;
  const Extents found = extents_of(GetParam());
  std::printf(
      "%-10s beam %.1f deg: strong %.1f/%.1f/%.1f medium %.1f/%.1f/%.1f weak "
      "%.1f/%.1f/%.1f deg (p10/50/90; %zu, %zu, %zu points)\n",
      GetParam().c_str(), beam, quantile(found.strong, 0.1), quantile(found.strong, 0.5),
      quantile(found.strong, 0.9), quantile(found.medium, 0.1), quantile(found.medium, 0.5),
      quantile(found.medium, 0.9), quantile(found.weak, 0.1), quantile(found.weak, 0.5),
      quantile(found.weak, 0.9), found.strong.size(), found.medium.size(), found.weak.size());
  ASSERT_GT(found.strong.size(), 20u);
  ASSERT_GT(found.medium.size(), 20u);
  ASSERT_GT(found.weak.size(), 20u);
  // The spread of all recordings: strong 0.96 to 1.6 beams at the median, medium 0.48 to 0.88, weak
  // 0.19 to 0.35.
  EXPECT_GT(quantile(found.strong, 0.5), 0.96 * beam);
  EXPECT_LT(quantile(found.strong, 0.5), 1.7 * beam);
  EXPECT_GT(quantile(found.medium, 0.5), 0.45 * beam);
  EXPECT_LT(quantile(found.medium, 0.5), 1.05 * beam);
  EXPECT_GT(quantile(found.weak, 0.5), 0.1 * beam);
  EXPECT_LT(quantile(found.weak, 0.5), 0.65 * beam);
}

INSTANTIATE_TEST_SUITE_P(Recorded, AzimuthExtent, ::testing::Values("HALO20", "3G", "BR24", "4G"),
                         [](const auto& param) {
                           std::string name = param.param;
                           std::erase(name, ' ');
                           return "Of" + name;
                         });

// ---- f), g) Correlation inside the coast's echo -----------------------------------------------

struct CoastTurns {
  ScanGeometry geometry;
  double cell_m = 1.0;
  std::vector<std::vector<std::uint8_t>> turns;
};

CoastTurns coast_turns(const std::string& set_name, std::uint32_t count) {
  scenes::NamedScene named;
  named.geometry = {2048, 1024, 4};
  named.set = echo::find_set(set_name);
  named.set.antenna_height_m = 10.0;
  named.rpm = named.set.rpm;
  named.controls.range_scale = *RangeScale::find(1.5);
  named.controls.integration = 100.0;
  auto chart = scenes::world_chart(scenes::kBergen, named.controls.range_scale.length() * 1.3);
  CoastTurns found{named.geometry, 0.0, {}};
  if (!chart) return found;
  auto scene = std::make_shared<echo::Scene>(*scenes::scene_at(
      std::move(*chart), scenes::kBergen, named.controls.range_scale, named.geometry));
  scene->own_velocity = {};  // at berth, as recorded
  named.scene = std::move(scene);
  found.cell_m = named.geometry.cell_size(named.controls.range_scale).in_metres();
  const auto all = scenes::render_scans(named, count);
  const std::size_t turn = std::size_t{named.geometry.spokes_per_turn} * named.geometry.cells;
  for (std::uint32_t t = 0; t < count; ++t) {
    found.turns.emplace_back(all.begin() + static_cast<std::ptrdiff_t>(t * turn),
                             all.begin() + static_cast<std::ptrdiff_t>((t + 1) * turn));
  }
  return found;
}

echo::PictureTurn picture_of(const CoastTurns& found, std::size_t turn, double beam_deg) {
  return {found.geometry.spokes_per_turn,
          found.geometry.cells,
          found.cell_m,
          beam_deg,
          15,
          found.turns[turn]};
}

// Recorded (f), spoke lags 1 2 4 8 16: HALO20 .990 .964 .875 .641 .274; 3G .979 .938 .822 .583
// .274; range lags: HALO20 .983 .939 .798 .532 .258; 3G .882 .712 .461 .206 .097 (cells of 3.1
// and 1.6 m and pulses of their own).
TEST(LandCorrelation, FromSpokeToSpokeAndCellToCellIsNearTheRecordedOne) {
  const CoastTurns found = coast_turns("HALO20", 1);
  if (found.turns.empty()) GTEST_SKIP() << "no chart installed";
  const echo::PictureCorrelation correlation =
      echo::picture_correlation(picture_of(found, 0, 4.9), {.from_m = 100.0, .threshold = 0.05});
  std::printf("spoke lag 1 2 4 8 16 32: ");
  for (const double c : correlation.spoke) std::printf(" %.3f", c);
  std::printf("\nrange lag 1 2 4 8 16 32: ");
  for (const double c : correlation.range) std::printf(" %.3f", c);
  std::printf("\n");
  constexpr std::array<double, 5> kHalo = {.990, .964, .875, .641, .274};
  constexpr std::array<double, 5> k3G = {.979, .938, .822, .583, .274};
  for (std::size_t i = 0; i < kHalo.size(); ++i) {
    // Two recordings are up to .06 apart; as much again either way for the site, and twice at 8 and
    // 16 spokes, where what counts is how long the stretches of coast are.
    EXPECT_GT(correlation.spoke[i], k3G[i] - (i < 3 ? 0.08 : 0.16))
        << "lag " << echo::kCorrelationLags[i];
    EXPECT_LT(correlation.spoke[i], std::min(1.0, kHalo[i] + 0.12))
        << "lag " << echo::kCorrelationLags[i];
  }
  // Short of the recorded .882 and .983: pulses here have sharp ends.
  EXPECT_GT(correlation.range[0], 0.78);
  EXPECT_GT(correlation.range[0], correlation.range[1]);
  EXPECT_GT(correlation.range[1], correlation.range[2]);
  EXPECT_GT(correlation.range[2], correlation.range[3]);
}

double correlation_of(const std::vector<std::uint8_t>& a, const std::vector<std::uint8_t>& b,
                      std::size_t blind) {
  double n = 0.0, x = 0.0, y = 0.0, xx = 0.0, yy = 0.0, xy = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    // Counts the cells in which the coast echoes in either turn.
    if (i % 1024 < blind || (a[i] == 0 && b[i] == 0)) continue;
    const double p = a[i], q = b[i];
    n += 1.0, x += p, y += q, xx += p * p, yy += q * q, xy += p * q;
  }
  return (xy - x * y / n) / std::sqrt((xx - x * x / n) * (yy - y * y / n));
}

// Recorded (g): a static pattern, and speckle that is new every turn.  By this very measure the
// turns of the BR24, 3G and HALO20 have .23 to .66 (median .40), and of the cells that are on .09
// to .31 (median .15) are off a turn later.
TEST(LandCorrelation, FromTurnToTurnIsAStaticPatternAndFreshSpeckle) {
  const CoastTurns found = coast_turns("3G", 6);
  if (found.turns.empty()) GTEST_SKIP() << "no chart installed";
  std::vector<double> by_lag;
  for (std::size_t lag = 1; lag < found.turns.size(); ++lag) {
    double sum = 0.0;  // over all pairs of turns so far apart
    for (std::size_t t = 0; t + lag < found.turns.size(); ++t)
      sum += correlation_of(found.turns[t], found.turns[t + lag], 40);
    by_lag.push_back(sum / static_cast<double>(found.turns.size() - lag));
    std::printf("turn lag %zu: %.3f\n", lag, by_lag.back());
  }
  double on = 0.0, off = 0.0;
  for (std::size_t i = 0; i < found.turns[0].size(); ++i) {
    if (i % 1024 < 40 || found.turns[0][i] == 0) continue;
    on += 1.0;
    off += found.turns[1][i] == 0;
  }
  std::printf("off a turn later: %.3f of the cells that are on\n", off / on);
  for (const double c : by_lag) {
    EXPECT_GT(c, 0.23);
    EXPECT_LT(c, 0.70);
    EXPECT_NEAR(c, by_lag[0], 0.02) << "the fluctuation is white from turn to turn";
  }
  EXPECT_GT(off / on, 0.05);
  EXPECT_LT(off / on, 0.31);
}

// ---- h) Receiver noise ------------------------------------------------------------------------

TEST(NoiseOccupancy, IsHalfOfAllCellsAtGain95AndAHundredthAtMostAtNormalGain) {
  const auto share = [](double gain) {
    TargetTrial trial({.set = echo::find_set("Quantum 2"),
                       .scale = *RangeScale::find(3.0),
                       .gain = gain,
                       .geometry = {256, 256, 8}},
                      [](echo::Scene&) {});
    const auto video = trial.video(0, 0, 256);
    const auto on = std::count_if(video.begin(), video.end(), [](std::uint8_t v) { return v > 0; });
    return static_cast<double>(on) / static_cast<double>(video.size());
  };
  const double high = share(95.0), normal = share(50.0);
  std::printf("on at gain 95: %.1f %%, at gain 50: %.4f %%\n", 100.0 * high, 100.0 * normal);
  // Recorded: 49 %.  With the blind cells and a cell of one and a half samples, whose peak is
  // shown.
  EXPECT_NEAR(high, 0.49, 0.12);
  EXPECT_LT(normal, 0.01);
}

}  // namespace
}  // namespace skerry::validation
