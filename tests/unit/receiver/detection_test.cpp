#include "tests/unit/receiver/detection.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <vector>

#include "echo/receiver/log_video.hpp"
#include "echo/receiver/receiver_noise.hpp"
#include "tests/unit/receiver/view_setup.hpp"

namespace skerry::echo {
namespace {

// SOURCES.md "Vectors".
TEST(Detection, HasTheTestVectors) {
  EXPECT_NEAR(cfar_multiplier(16, 1e-4), 12.4525, 5e-5);
  EXPECT_NEAR(cfar_multiplier(32, 1e-6), 17.2776, 5e-5);
  EXPECT_NEAR(10.0 * std::log10(swerling1_snr(0.8, 1e-4)), 16.050, 5e-4);
  EXPECT_NEAR(albersheim_snr_db(0.8, 1e-4, 1), 10.984, 5e-4);
  EXPECT_NEAR(albersheim_snr_db(0.8, 1e-4, 10), 3.353, 5e-4);
  EXPECT_NEAR(swerling1_pd(swerling1_snr(0.8, 1e-4), 1e-4), 0.8, 1e-12);
}

TEST(Detection, MarcumsFunctionAgreesWithAlbersheimAndItsLimits) {
  EXPECT_NEAR(steady_pd(0.0, detection_threshold(1e-4)), 1e-4, 1e-12);
  EXPECT_NEAR(steady_pd(500.0, 10.0), 1.0, 1e-9);
  const double pd = steady_pd(std::pow(10.0, 1.0984), detection_threshold(1e-4));
  std::printf("Pd of a steady echo 10.984 dB over noise at Pfa 1e-4: %.4f\n", pd);
  EXPECT_NEAR(pd, 0.8, 0.02);
}

TEST(Detection, TheGainForAFalseAlarmRatePutsTheThresholdThere) {
  const double gain = gain_for_pfa(1e-4);
  EXPECT_NEAR(threshold_db(gain), 10.0 * std::log10(-std::log(1e-4)), 1e-9);
  EXPECT_GT(gain, 0.0);
  EXPECT_LT(gain, 100.0);
}

struct Monte {
  double detected = 0.0, cells = 0.0;
  double pd() const { return detected / cells; }
};

// Through the receiver's own kernel: an echo of its own power in each cell, white noise.
Monte trial(const auto& echo_power, double threshold) {
  const ReceiverNoise noise(1.0, Decimation::peak);
  std::vector<float> power(kCells), total(kCells);
  Monte monte;
  for (std::uint32_t spoke = 0; spoke < 1000; ++spoke) {
    for (std::uint32_t i = 0; i < kCells; ++i) power[i] = echo_power(spoke, i);
    receive_power(power, 1.0f, noise.row(noise_key(3, 0, 0, spoke)), total);
    for (float p : total) monte.detected += static_cast<double>(p) > threshold;
    monte.cells += kCells;
  }
  return monte;
}

// A million trials: standard deviation 0.0004; the noise itself is within 0.003 of its law.
TEST(Detection, ASteadyEchoIsRician) {
  const auto steady = static_cast<float>(std::pow(10.0, 1.0984));
  const double threshold = detection_threshold(1e-4);
  const double pd = trial([&](auto, auto) { return steady; }, threshold).pd();
  std::printf("Pd %.4f, Marcum %.4f\n", pd, steady_pd(static_cast<double>(steady), threshold));
  EXPECT_NEAR(pd, steady_pd(static_cast<double>(steady), threshold), 0.005);
  EXPECT_NEAR(pd, 0.8, 0.02);
}

TEST(Detection, AnExponentialEchoStaysExponential) {
  const double snr = swerling1_snr(0.8, 1e-4), threshold = detection_threshold(1e-4);
  const auto echo = [&](std::uint32_t spoke, std::uint32_t i) {
    return static_cast<float>(snr * unit_noise_reference(noise_key(99, 0, 1, spoke), i));
  };
  const double pd = trial(echo, threshold).pd();
  std::printf("Swerling 1 at 16.050 dB: Pd %.4f\n", pd);
  EXPECT_NEAR(pd, 0.8, 0.003);
  for (double level : {1.0, 3.0})
    EXPECT_NEAR(trial(echo, level * (snr + 1.0)).pd(), std::exp(-level), 0.005);
}

// Cell averaging over 8 cells to either side, one left out next to the cell under test.
TEST(Detection, CellAveragingKeepsItsFalseAlarmRate) {
  const ReceiverNoise noise(1.0, Decimation::peak);
  const std::vector<float> silence(kCells, 0.0f);
  std::vector<float> total(kCells);
  const double alpha = cfar_multiplier(16, 1e-3);
  double alarms = 0, tests = 0;
  for (std::uint32_t spoke = 0; spoke < 2000; ++spoke) {
    receive_power(silence, 1.0f, noise.row(noise_key(4, 0, 0, spoke)), total);
    for (std::uint32_t i = 9; i + 9 < kCells; ++i) {
      double sum = 0.0;
      for (std::uint32_t k = 2; k <= 9; ++k)
        sum += static_cast<double>(total[i - k]) + static_cast<double>(total[i + k]);
      alarms += static_cast<double>(total[i]) > alpha * sum / 16.0;
      tests += 1.0;
    }
  }
  std::printf("false alarm rate %.3e for 1e-3\n", alarms / tests);
  EXPECT_NEAR(alarms / tests, 1e-3, 1e-4 + 4.0 * std::sqrt(1e-3 / tests));
}

}  // namespace
}  // namespace skerry::echo
