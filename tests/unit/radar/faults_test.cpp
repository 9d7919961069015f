// What a radar with faults shows.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>
#include <random>

#include "echo/radar/radar_set.hpp"
#include "tests/unit/radar/faulty_radar.hpp"
#include "tests/unit/world/random_faults.hpp"

namespace skerry::server {
namespace {

constexpr double kStepsPerDb = 256.0 / echo::kLogVideoDb;

double mean_of(const std::vector<SpokePtr>& spokes) {
  double sum = 0.0, cells = 0.0;
  for (const SpokePtr& spoke : spokes) {
    sum += std::accumulate(spoke->cells.begin() + 100, spoke->cells.end(), 0.0);
    cells += static_cast<double>(spoke->cells.size()) - 100;
  }
  return sum / cells;
}

// What one cell in a hundred is over.
int bright_of(const std::vector<SpokePtr>& spokes) {
  std::vector<std::uint8_t> cells;
  for (const SpokePtr& spoke : spokes)
    cells.insert(cells.end(), spoke->cells.begin() + 100, spoke->cells.end());
  std::nth_element(cells.begin(), cells.end() - cells.size() / 100, cells.end());
  return *(cells.end() - cells.size() / 100);
}

bool same_cells(const std::vector<SpokePtr>& a, const std::vector<SpokePtr>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const SpokePtr& p, const SpokePtr& q) { return p->cells == q->cells; });
}

TEST(RadarFaults, TheBoatIsWhereItIs) {
  FaultyRadar radar;
  const FaultyRadar::Echo boat = radar.boat();
  std::printf("level %d, %d cells, spoke %.2f, cell %.2f\n", boat.brightest, boat.cells, boat.spoke,
              boat.cell);
  EXPECT_GT(boat.cells, 8);
  EXPECT_GT(boat.brightest, 130);
  EXPECT_LT(boat.brightest, 250);
  EXPECT_NEAR(boat.spoke * 360.0 / FaultyRadar::kTurn, 45.0, 0.3);
}

TEST(RadarFaults, OfOtherThingsChangeNoBitOfThePicture) {
  FaultyRadar radar;
  const auto well = radar.spokes(128, 16);
  wire::Faults others;
  others.set_ais_lost(true);
  others.set_log_bias_kn(3);
  radar.set(others);
  EXPECT_TRUE(same_cells(well, radar.spokes(128, 16)));
}

TEST(RadarFaults, LostPowerAndTuneLowerAnEchoByTheirDecibels) {
  FaultyRadar radar;
  const int well = radar.boat().brightest;
  wire::Faults weak;
  weak.set_radar_power_loss_db(10.0);
  radar.set(weak);
  const int by_power = radar.boat().brightest;
  weak.Clear();
  weak.set_radar_detuned_db(10.0);
  radar.set(weak);
  const int by_tune = radar.boat().brightest;
  weak.set_radar_power_loss_db(3.0);
  weak.set_radar_detuned_db(7.0);
  radar.set(weak);
  const int by_both = radar.boat().brightest;
  std::printf("10 dB: %.2f and %.2f dB\n", (well - by_power) / kStepsPerDb,
              (well - by_tune) / kStepsPerDb);
  EXPECT_NEAR((well - by_power) / kStepsPerDb, 10.0, 0.5);
  EXPECT_EQ(by_power, by_tune);
  EXPECT_NEAR(by_both, by_power, 1);
}

TEST(RadarFaults, NoiseRisesByItsDecibelsAndEchoesDoNot) {
  FaultyRadar radar;
  radar.config().controls.gain = 80.0;
  const double quiet = bright_of(radar.spokes(600, 4));
  wire::Faults noisy;
  noisy.set_radar_noise_db(6.0);
  radar.set(noisy);
  const double loud = bright_of(radar.spokes(600, 4));
  std::printf("6 dB: noise up by %.2f dB\n", (loud - quiet) / kStepsPerDb);
  EXPECT_NEAR((loud - quiet) / kStepsPerDb, 6.0, 0.5);
  radar.config().controls.gain = 50.0;
  const int with = radar.boat().brightest;
  radar.clear();
  EXPECT_NEAR(with, radar.boat().brightest, 1.0 * kStepsPerDb);
}

TEST(RadarFaults, ABearingErrorMovesTheEchoByIt) {
  FaultyRadar radar;
  const double well = radar.boat().spoke;
  for (const double error : {3.0, -2.5}) {
    wire::Faults wrong;
    wrong.set_radar_bearing_error_deg(error);
    radar.set(wrong);
    const double off = (radar.boat().spoke - well) * 360.0 / FaultyRadar::kTurn;
    std::printf("%.1f deg: moved by %.3f\n", error, off);
    EXPECT_NEAR(off, error, 0.1);
  }
}

TEST(RadarFaults, ARangeErrorMovesTheEchoByIt) {
  FaultyRadar radar;
  const double well = radar.boat().cell;
  for (const double error : {100.0, -100.0, 2.0, 900.0, -1000.0}) {
    wire::Faults wrong;
    wrong.set_radar_range_error_m(error);
    radar.set(wrong);
    const double off = (radar.boat().cell - well) * radar.cell_m();
    std::printf("%.0f m: moved by %.2f\n", error, off);
    EXPECT_NEAR(off, error, 0.25 * radar.cell_m());
  }
}

// What lies beyond the range scale comes into it.
TEST(RadarFaults, ANegativeRangeErrorBringsNearWhatIsOutOfRange) {
  FaultyRadar radar;
  radar.config().controls.range_scale = *RangeScale::find(1.5);
  EXPECT_LT(radar.boat().cells, 2);
  wire::Faults wrong;
  wrong.set_radar_range_error_m(-1000.0);
  radar.set(wrong);
  const FaultyRadar::Echo boat = radar.boat();
  EXPECT_GT(boat.cells, 8);
  EXPECT_NEAR(boat.cell * radar.cell_m(), 2.0 * 1852.0 - 1000.0, 30.0);
}

TEST(RadarFaults, NothingButNoiseIsInABlindSectorNorWithoutATrigger) {
  FaultyRadar radar;
  radar.config().controls.gain = 80.0;
  const auto spokes = [&] { return radar.spokes(128, 16); };
  const double noise = mean_of(radar.spokes(600, 16));
  wire::Faults blind;
  blind.set_radar_blind_from_deg(20.0);
  blind.set_radar_blind_width_deg(60.0);
  radar.set(blind);
  const auto none = spokes();
  EXPECT_NEAR(mean_of(none), noise, 0.5);
  wire::Faults silent;
  silent.set_radar_trigger_lost(true);
  radar.set(silent);
  EXPECT_TRUE(same_cells(none, spokes())) << "the same noise";
  blind.set_radar_blind_from_deg(350.0);  // through the bow, and not as far as the boat
  blind.set_radar_blind_width_deg(40.0);
  radar.set(blind);
  EXPECT_GT(radar.boat().brightest, 200);
}

TEST(RadarFaults, SpokesComeEmptyByTheShareLost) {
  FaultyRadar radar;
  radar.config().controls.gain = 80.0;
  const auto lost = [&](double percent) {
    wire::Faults loss;
    loss.set_radar_spoke_loss_percent(percent);
    radar.set(loss);
    int empty = 0;
    for (const SpokePtr& spoke : radar.spokes(0, 64)) {
      empty += std::all_of(spoke->cells.begin(), spoke->cells.end(),
                           [](std::uint8_t cell) { return cell == 0; });
    }
    return 100.0 * empty / 1024;
  };
  EXPECT_EQ(lost(0.0), 0.0);
  const double share = lost(30.0);
  std::printf("30 %%: %.1f\n", share);
  EXPECT_NEAR(share, 30.0, 5.0);  // three deviations and a half
  EXPECT_EQ(lost(100.0), 100.0);
  EXPECT_EQ(lost(30.0), share) << "the same ones";
}

TEST(RadarFaults, InABlackoutThereIsNoVideoAndAfterItThePictureIsBack) {
  FaultyRadar radar;
  const auto well = radar.spokes(128, 4);
  wire::Faults dark;
  dark.set_blackout(true);
  radar.set(dark);
  EXPECT_EQ(mean_of(radar.spokes(128, 4)), 0.0);
  radar.clear();
  EXPECT_TRUE(same_cells(well, radar.spokes(128, 4)));
}

TEST(RadarFaults, SpokesAreStampedWithWhatGyroAndReceiverSay) {
  FaultyRadar radar;
  wire::Faults wrong;
  wrong.set_gyro_bias_deg(-5.0);
  wrong.set_gyro_drift_deg_min(2.0);
  wrong.set_gnss_north_m(1852.0);
  wrong.set_gnss_drift_kn(60.0);
  wrong.set_gnss_drift_deg(180.0);
  radar.set(wrong);
  radar.state().exercise = std::chrono::seconds(60);
  const auto spokes = radar.spokes(128, 1);
  EXPECT_NEAR(spokes.front()->header.heading.in_degrees(), 357.0, 0.01);
  EXPECT_NEAR(spokes.front()->header.own_ship.latitude_deg, 60.0, 1e-4) << "a mile up, one down";
  radar.clear();
  const auto well = radar.spokes(128, 1);
  EXPECT_EQ(well.front()->header.heading.in_degrees(), 0.0);
  EXPECT_TRUE(same_cells(spokes, well)) << "the antenna looks where it did";
  // A clock of the exercise that stands does not move what is told.
  radar.set(wrong);
  radar.ship().pace = 0.0;
  const auto frozen = radar.spokes(128 + 1024, 1);
  EXPECT_NEAR(frozen.front()->header.heading.in_degrees(), 357.0, 1e-6);
}

TEST(RadarFaults, WithoutGyroAndReceiverTheLastStampStays) {
  FaultyRadar radar;
  wire::Faults lost;
  lost.set_gyro_lost(true);
  lost.set_gnss_lost(true);
  radar.held_heading_deg = 123.0;
  radar.held_position = GeoPoint{61.0, 4.0};
  radar.set(lost);
  for (const SpokePtr& spoke : radar.spokes(128, 2)) {
    EXPECT_NEAR(spoke->header.heading.in_degrees(), 123.0, 1e-6);
    EXPECT_EQ(spoke->header.own_ship, (GeoPoint{61.0, 4.0}));
  }
}

// Whatever is wrong, at whatever time: spokes of the right sizes, stamped within their ranges.
TEST(RadarFaults, NoFaultsBreakAPicture) {
  std::mt19937_64 random(9);
  FaultyRadar radar;
  for (int i = 0; i < 60; ++i) {
    const wire::Faults faults = random_faults(random);
    radar.set(faults);
    radar.state().exercise = std::chrono::seconds(random() % 400'000);
    for (const SpokePtr& spoke : radar.spokes(random() % 4096 / 16 * 16, 1)) {
      ASSERT_EQ(spoke->cells.size(), FaultyRadar::kCells);
      const double heading = spoke->header.heading.in_degrees();
      ASSERT_TRUE(heading >= 0.0 && heading < 360.0);
      ASSERT_LE(std::fabs(spoke->header.own_ship.latitude_deg), 90.0) << faults.DebugString();
      ASSERT_LE(std::fabs(spoke->header.own_ship.longitude_deg), 180.0);
    }
  }
}

}  // namespace
}  // namespace skerry::server
