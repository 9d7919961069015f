// MSC.192(79) 5.3 and 5.4 on the finished video: range within 30 m or 1 % of the scale, bearing
// within 1 deg, two points 40 m or 2.5 deg apart told apart.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "protocol/quantity/bearing.hpp"
#include "tests/validation/target_trial.hpp"

namespace skerry::validation {
namespace {

echo::PointTarget reflector_at(PlanePoint place, std::uint64_t identity) {
  echo::PointTarget point;
  point.place = place;
  point.height_m = 4.0;
  point.x_band_m2 = 10.0;
  point.s_band_m2 = 1.0;
  point.fluctuation = echo::Fluctuation::steady;
  point.identity = identity;
  return point;
}

// Rough enough that no target stands in a null of the sea's reflection.
constexpr double kWaves = 1.0;

// The beginning of an echo and the middle of its bearings, in a window of video.
struct Echo {
  double range_m = 0.0;
  double bearing_deg = 0.0;
  bool seen = false;
};

Echo find_echo(TargetTrial& trial, double range_m, double bearing_deg) {
  const ScanGeometry& g = trial.geometry();
  const double per_deg = g.spokes_per_turn / 360.0;
  const auto first = static_cast<std::uint32_t>((bearing_deg - 4.0) * per_deg);
  const auto count = static_cast<std::uint32_t>(8.0 * per_deg);
  const std::vector<std::uint8_t> video = trial.video(0, first, count);
  // Only around where it must be: noise sparkles elsewhere.
  const auto window =
      static_cast<std::int64_t>(std::max(60.0, 0.02 * g.cells * trial.cell_m()) / trial.cell_m());
  const auto middle = static_cast<std::int64_t>(range_m / trial.cell_m());
  const auto from = std::max<std::int64_t>(0, middle - window);
  const auto to = std::min<std::int64_t>(g.cells, middle + window);
  Echo echo;
  double sum = 0.0, weighted = 0.0;
  std::int64_t nearest = to;
  for (std::uint32_t k = 0; k < count; ++k) {
    for (std::int64_t i = from; i < to; ++i) {
      const double value = video[k * g.cells + static_cast<std::size_t>(i)];
      if (value < 60.0) continue;  // well over the noise
      sum += value;
      weighted += value * k;
      nearest = std::min(nearest, i);
    }
  }
  echo.seen = sum > 0.0;
  if (!echo.seen) return echo;
  echo.bearing_deg = (first + weighted / sum) / per_deg;
  echo.range_m = static_cast<double>(nearest) * trial.cell_m();
  return echo;
}

class Accuracy : public ::testing::TestWithParam<double> {};

TEST_P(Accuracy, RangeAndBearingOfTheEchoAreThoseOfTheTarget) {
  const RangeScale scale = *RangeScale::find(GetParam());
  const double reach = scale.length().in_metres();
  double worst_range = 0.0, worst_bearing = 0.0;
  for (const double share : {0.31, 0.52, 0.77, 0.93}) {
    for (const double bearing : {12.3, 97.07, 201.9, 333.33}) {
      const double range = share * reach;
      if (range > 8000.0) continue;  // 10 m2 are seen to about there
      TargetTrial trial({.set = {}, .scale = scale}, [&](echo::Scene& scene) {
        scene.points.push_back(reflector_at(off(scene.own_ship, range, bearing), 1));
      });
      const Echo echo = find_echo(trial, range, bearing);
      ASSERT_TRUE(echo.seen) << range << " m, " << bearing << " deg";
      worst_range = std::max(worst_range, std::fabs(echo.range_m - range));
      worst_bearing = std::max(worst_bearing, std::fabs(echo.bearing_deg - bearing));
    }
  }
  std::printf("%6.3f NM: range within %.1f m (allowed %.1f), bearing within %.3f deg\n", GetParam(),
              worst_range, std::max(30.0, 0.01 * reach), worst_bearing);
  EXPECT_LE(worst_range, std::max(30.0, 0.01 * reach));
  EXPECT_LE(worst_bearing, 1.0);
}

INSTANTIATE_TEST_SUITE_P(Scales, Accuracy, ::testing::Values(0.25, 0.5, 0.75, 1.5, 3.0, 6.0, 12.0));

// Depth of the gap between two echoes: the least of the greatest values between them, over the
// lesser of the two.
template <typename At>
double gap(std::int64_t a, std::int64_t b, const At& at) {
  double least = 1e9;
  for (std::int64_t i = a; i <= b; ++i) least = std::min(least, at(i));
  return least / std::min(at(a), at(b));
}

class Discrimination : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Discrimination, TwoPointsFortyMetresApartAreTwoEchoes) {
  const auto [nm, share] = GetParam();
  const RangeScale scale = *RangeScale::find(nm);
  const double range = share * scale.length().in_metres() - 70.0, bearing = 63.0;
  TargetTrial trial({.set = {}, .scale = scale, .sea = 60.0}, [&](echo::Scene& scene) {
    scene.wave_height_m = kWaves;
    scene.points.push_back(reflector_at(off(scene.own_ship, range, bearing), 1));
    scene.points.push_back(reflector_at(off(scene.own_ship, range + 40.0, bearing), 2));
  });
  const std::uint32_t spoke =
      RelativeBearing::from(degrees(bearing)).nearest_spoke(trial.geometry().spokes_per_turn);
  const auto row = trial.video(0, spoke, 1);
  // The brightest cell of each pulse.
  const auto peak = [&](double at) {
    const auto from = static_cast<std::int64_t>(at / trial.cell_m());
    const auto to = static_cast<std::int64_t>((at + 20.0) / trial.cell_m());
    return std::max_element(row.begin() + from, row.begin() + to + 1) - row.begin();
  };
  const double depth = gap(peak(range), peak(range + 40.0), [&](std::int64_t i) {
    return static_cast<double>(row[static_cast<std::size_t>(i)]);
  });
  std::printf("%.3f NM at %3.0f %%: 40 m apart, the gap falls to %.0f %% of the echoes\n", nm,
              100.0 * share, 100.0 * depth);
  EXPECT_LT(depth, 0.5);
}

TEST_P(Discrimination, TwoPointsTwoAndAHalfDegreesApartAreTwoEchoes) {
  const auto [nm, share] = GetParam();
  const RangeScale scale = *RangeScale::find(nm);
  const double range = share * scale.length().in_metres() - 30.0, bearing = 63.0;
  TargetTrial trial({.set = {}, .scale = scale, .sea = 60.0}, [&](echo::Scene& scene) {
    scene.wave_height_m = kWaves;
    scene.points.push_back(reflector_at(off(scene.own_ship, range, bearing), 1));
    scene.points.push_back(reflector_at(off(scene.own_ship, range, bearing + 2.5), 2));
  });
  const std::uint32_t turn = trial.geometry().spokes_per_turn;
  const std::uint32_t a = RelativeBearing::from(degrees(bearing)).nearest_spoke(turn);
  const std::uint32_t b = RelativeBearing::from(degrees(bearing + 2.5)).nearest_spoke(turn);
  const std::uint32_t cells = trial.geometry().cells;
  const auto video = trial.video(0, a, b - a + 1);
  const auto cell = static_cast<std::uint32_t>((range + 4.0) / trial.cell_m());
  const double depth = gap(0, b - a, [&](std::int64_t k) {
    double most = 0.0;  // the pulse may fill either
    for (std::uint32_t i = cell; i < std::min(cells, cell + 2); ++i) {
      most = std::max(most, double{1} * video[static_cast<std::size_t>(k) * cells + i]);
    }
    return most;
  });
  std::printf("%.3f NM at %3.0f %%: 2.5 deg apart, the gap falls to %.0f %% of the echoes\n", nm,
              100.0 * share, 100.0 * depth);
  EXPECT_LT(depth, 0.5);
}

INSTANTIATE_TEST_SUITE_P(Scales, Discrimination,
                         ::testing::Combine(::testing::Values(0.25, 0.5, 0.75, 1.5),
                                            ::testing::Values(0.5, 0.75, 1.0)));

}  // namespace
}  // namespace skerry::validation
