// Ships as the picture shows them: cross-section, aspect, fluctuation, length.
#include <gtest/gtest.h>

#include "echo/kernel/hash.hpp"
#include "tests/unit/targets/mean_echo.hpp"
#include "tests/unit/targets/targets_support.hpp"

namespace skerry::echo {
namespace {

// Greatest power of the picture about that bearing in one passing.
struct Seen {
  double peak = 0.0;
  int cells = 0, spokes = 0;  // extent over a threshold
};
Seen seen_of(const RadarModel& model, TargetReturns& returns, const Scene& scene,
             std::uint32_t middle, std::uint64_t turn, double threshold) {
  EchoSplat splat(model);
  Seen seen;
  std::vector<bool> cells(model.geometry.cells, false);
  std::vector<PointEcho> echoes;
  for (std::uint64_t first = turn * 4096 + middle - 64; first < turn * 4096 + middle + 64;
       first += 16) {
    returns.prepare(scene, aim_of(scene, model.clock, first),
                    aim_of(scene, model.clock, first + 15), {}, echoes);
    for (const auto& row : rows_of(model, splat, scene, echoes, first)) {
      bool any = false;
      for (std::size_t c = 0; c < row.size(); ++c) {
        const auto power = static_cast<double>(row[c]);
        seen.peak = std::max(seen.peak, power);
        if (power > threshold) cells[c] = any = true;
      }
      seen.spokes += any;
    }
  }
  seen.cells = static_cast<int>(std::count(cells.begin(), cells.end(), true));
  return seen;
}

// A ship that one cell and one beam hold: the power of the cell in the middle of the beam.
std::vector<double> cell_powers(std::uint64_t identity, double heading, int turns) {
  RadarModel model = model_at(96.0);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.artefacts.side_lobes = false;
  const double range = 61.3 * model.cell_m;
  const auto middle = std::uint32_t{1024};
  scene.hulls = {ship_at(place_at(range, 90.0), heading, 50.0, 8.0, identity)};
  EchoSplat splat(model);
  std::vector<double> powers;
  for (int turn = 1; turn <= turns; ++turn) {
    const auto echoes = echoes_about(returns, model, scene, 90.0, static_cast<std::uint64_t>(turn));
    const auto rows =
        rows_of(model, splat, scene, echoes, static_cast<std::uint64_t>(turn) * 4096 + middle - 8);
    powers.push_back(static_cast<double>(rows[8][61] + rows[8][62]) / model.unit_snr * range *
                     range * range * range);
  }
  return powers;
}

TEST(ShipEcho, CrossSectionIsSkolniksOfTenThousandTonnes) {
  // 52 sqrt(9410) 10^1.5 = 1.59514e5 m2 (SOURCES.md "Vectors"); beam chosen for 10 kt.
  const double beam = std::sqrt(10000.0 / (1.025 * 0.7 * 0.4 * 150.0));
  EXPECT_NEAR(ship_cross_section(150.0, beam, 9.41e9) / 1.59514e5, 1.0, 1e-5);
}

TEST(ShipEcho, MedianIsSkolniks) {
  // The median of 4000 exponentials strays by 1 / (sqrt(4000) ln 2) = 2.3 %, that of nine ships'
  // mean by 0.8 %; 5 % is six times as much.
  double sum = 0.0;
  for (std::uint64_t ship = 1; ship <= 9; ++ship) {
    std::vector<double> powers = cell_powers(ship, 75.0, 4000);
    std::nth_element(powers.begin(), powers.begin() + 2000, powers.end());
    sum += powers[2000] / ship_cross_section(50.0, 8.0, 9.41e9) / 9.0;
  }
  EXPECT_NEAR(sum, 1.0, 0.05);
}

TEST(ShipEcho, FluctuatesFromScanToScanAsSwerlingOne) {
  std::vector<double> powers = cell_powers(3, 75.0, 4000);
  double mean = 0.0;
  for (const double p : powers) mean += p / 4000.0;
  for (double& p : powers) p /= mean;
  // The mean is the sample's own, which brings the sample nearer to its law, never farther.
  EXPECT_LT(kolmogorov(powers, exponential_law), kolmogorov_bound(4000));
  double lag = 0.0;
  for (std::size_t k = 1; k < powers.size(); ++k) lag += (powers[k] - 1.0) * (powers[k - 1] - 1.0);
  EXPECT_LT(std::fabs(lag / 4000.0), 5.0 / std::sqrt(4000.0));
}

TEST(ShipEcho, ABroadsideStandsTenToTwentyDecibelsHigher) {
  double least = 1e9, most = 0.0;
  for (std::uint64_t identity = 0; identity < 200; ++identity) {
    const Hull hull = ship_at({0, 3000}, 0.0, 150.0, 22.0, identity);
    const double bow = ship_mean_cross_section(hull, 9.41e9, 0.0);
    const double abeam = decibels(ship_mean_cross_section(hull, 9.41e9, 1.0) / bow);
    least = std::min(least, abeam), most = std::max(most, abeam);
    // Quarter: no more than the median.
    EXPECT_NEAR(ship_mean_cross_section(hull, 9.41e9, 0.7071) / bow, 1.0, 0.01);
    EXPECT_NEAR(decibels(ship_mean_cross_section(hull, 9.41e9, std::sin(78.1 / 57.29578)) / bow),
                abeam - 3.0, 0.4);
  }
  EXPECT_GE(least, 10.0);
  EXPECT_LT(least, 10.5);
  EXPECT_LE(most, 20.0);
  EXPECT_GT(most, 19.0);
}

TEST(ShipEcho, CrossSectionsOfTheSheetAtBothBands) {
  // 10 kt: 1.59514e5 m2 at 9410 MHz, 9.0814e4 at 3050 (SOURCES.md "Vectors"), medians; means are
  // 1/ln 2.
  const double beam = std::sqrt(10000.0 / (1.025 * 0.7 * 0.4 * 150.0));
  Hull hull = ship_at({0, 3000}, 0.0, 150.0, beam);
  EXPECT_NEAR(ship_mean_cross_section(hull, 9.41e9, 0.0) * std::numbers::ln2 / 1.59514e5, 1.0,
              1e-5);
  EXPECT_NEAR(ship_mean_cross_section(hull, 3.05e9, 0.0) * std::numbers::ln2 / 9.0814e4, 1.0, 1e-4);
  hull.cross_section_m2 = 5000.0;
  EXPECT_NEAR(ship_mean_cross_section(hull, 9.41e9, 0.0) * std::numbers::ln2, 5000.0, 1e-6);
  EXPECT_NEAR(ship_mean_cross_section(hull, 3.05e9, 0.0) * std::numbers::ln2,
              5000.0 * std::sqrt(3.05 / 9.41), 1e-6);
}

// The ground a ship covers, and no more than pulse and beam add to it.
TEST(ShipEcho, LengthIsSeenAlongAndAcrossTheLineOfSight) {
  const RadarModel model = model_at(1.5);
  TargetReturns returns(model);
  Scene scene = calm_scene();
  scene.artefacts.side_lobes = false;
  const double range = 1500.0;
  const auto mean_extent = [&](double heading, double length) {
    double cells = 0.0, spokes = 0.0;
    scene.hulls = {ship_at(place_at(range, 90.0), heading, length, length / 7.0)};
    for (std::uint64_t turn = 1; turn <= 40; ++turn) {
      const Seen seen = seen_of(model, returns, scene, 1024, turn, 1e5);
      cells += seen.cells / 40.0, spokes += seen.spokes / 40.0;
    }
    return std::pair{cells * model.cell_m, spokes * model.spoke_radians * range};
  };
  const double pulse = model.pulse_cells * model.cell_m;
  const auto [end_on, end_on_across] = mean_extent(90.0, 200.0);
  EXPECT_NEAR(end_on, 200.0 + pulse, 15.0);
  const auto [abeam_deep, abeam] = mean_extent(0.0, 200.0);
  EXPECT_NEAR(abeam_deep, 200.0 / 7.0 + pulse, 12.0);
  // One beam is 31 m wide there; a strong point two of them.
  EXPECT_GT(abeam, 200.0);
  EXPECT_LT(abeam, 200.0 + 2.5 * 31.4);
  EXPECT_LT(end_on_across, 28.6 + 2.5 * 31.4);
  EXPECT_LT(mean_extent(90.0, 60.0).first, 60.0 + pulse + 10.0);
}

TEST(ShipEcho, StrengthWandersSlowlyAlongTheHullWithTheAspect) {
  std::vector<ShipScatterer> here, near, far;
  const auto distance = [](const std::vector<ShipScatterer>& a,
                           const std::vector<ShipScatterer>& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k)
      sum += 0.5 * std::fabs(static_cast<double>(a[k].share) - static_cast<double>(b[k].share));
    return sum;
  };
  for (std::uint64_t ship = 0; ship < 20; ++ship) {
    ship_shares(ship, {16, 1}, units_at(40.0), here);
    ship_shares(ship, {16, 1}, units_at(41.0), near);
    ship_shares(ship, {16, 1}, units_at(75.0), far);
    EXPECT_LT(distance(here, near), 0.06);
    EXPECT_GT(distance(here, far), 0.05);
  }
}

TEST(ShipEcho, SharesAddUpToOneAtAnyDetail) {
  std::vector<ShipScatterer> figure;
  for (const std::uint32_t along : {2u, 4u, 8u, 16u, 32u, 64u, 256u, 4096u}) {
    for (const std::uint32_t rows : {1u, 3u, 16u}) {
      ship_shares(11, {along, rows}, 12345u, figure);
      ASSERT_EQ(figure.size(), along * rows);
      double sum = 0.0;
      for (const ShipScatterer& s : figure) {
        sum += static_cast<double>(s.share);
        ASSERT_LE(std::fabs(s.forward), 0.5f);
        ASSERT_LE(std::fabs(s.starboard), 0.5f);
      }
      EXPECT_NEAR(sum, 1.0, 2e-5);
    }
  }
}

TEST(ShipEcho, FewScatterersGiveTheMeanEchoOfMany) {
  std::vector<double> in_use, coarse;
  for (const double scale : {1.5, 6.0}) {
    const RadarModel model = model_at(scale);
    for (const ShipStudy& study : ship_studies()) {
      const auto many = mean_echo(model, study, kManyScatterers);
      for (const auto& [errors, per] : {std::pair{&in_use, 2.0}, std::pair{&coarse, 0.5}}) {
        const auto more =
            decibel_errors(mean_echo(model, study, detail_of(model, study, per)), many);
        errors->insert(errors->end(), more.begin(), more.end());
      }
    }
  }
  EXPECT_LT(part_of(in_use, 0.5), 0.2);
  EXPECT_LT(part_of(in_use, 0.95), 2.0);
  EXPECT_GT(part_of(coarse, 0.5), 1.0);  // the knob matters
}

TEST(ShipEcho, DetailIsBoundedAndFollowsWhatTheRadarResolves) {
  const Hull tanker = ship_at({0, 0}, 0, 400.0, 60.0), boat = ship_at({0, 0}, 0, 9.0, 3.0);
  EXPECT_EQ(ship_detail(tanker, 0.0, 1.0, {1.0, 1.0}).along, kMaxAlong);
  EXPECT_EQ(ship_detail(tanker, 0.0, 1.0, {1e6, 1e6}).along, 4u);
  EXPECT_EQ(ship_detail(boat, 0.0, 1.0, {12.0, 30.0}).count(), 2u);
  EXPECT_EQ(ship_detail(tanker, 0.0, 1.0, {75.0, 200.0}).along, 16u);
  EXPECT_EQ(ship_detail(tanker, 1.0, 0.0, {75.0, 200.0}).rows, 3u);
  EXPECT_EQ(ship_detail(tanker, 0.0, 1.0, {150.0, 200.0}).rows, 1u);
}

}  // namespace
}  // namespace skerry::echo
