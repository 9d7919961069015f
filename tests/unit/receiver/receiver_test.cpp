#include "echo/receiver/receiver.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numeric>

namespace skerry::echo {
namespace {

const ScanGeometry kGeometry{2048, 1024, 8};

ViewControls controls(double nm, double gain, double sea = 0.0, double rain = 0.0) {
  return {*RangeScale::find(nm), gain, sea, rain};
}

std::vector<std::uint8_t> video_of(const Receiver& receiver, const std::vector<float>& power,
                                   std::uint32_t spoke = 0) {
  std::vector<std::uint8_t> video(power.size());
  receiver.receive(power, noise_key(1, 0, 0, spoke), video);
  return video;
}

double share_on(double gain) {
  const Receiver receiver(kGeometry, controls(6, gain));
  const std::vector<float> silence(1024, 0.0f);
  double on = 0;
  for (std::uint32_t s = 0; s < 512; ++s) {
    for (std::uint8_t v : video_of(receiver, silence, s)) on += v > 0;
  }
  return on / (512.0 * 1024.0);
}

// recordings.md (h): under 1 % of cells at normal gain, about half at gain 95.
TEST(Receiver, NoiseSparklesAsOnARealSet) {
  const double normal = share_on(50.0), high = share_on(95.0);
  std::printf("cells on by noise: %.5f at gain 50, %.3f at gain 95\n", normal, high);
  EXPECT_LT(normal, 0.001);
  EXPECT_GT(normal, 1e-6);
  EXPECT_NEAR(high, 0.49, 0.03);
}

// Gain is an offset on log video: raising it lifts an echo by as many decibels.
TEST(Receiver, GainLiftsAnEchoByItsDecibels) {
  const std::vector<float> echo(1024, 1000.0f);  // 30 dB over noise
  const auto level = [&](double gain) {
    const auto v = video_of(Receiver(kGeometry, controls(6, gain)), echo);
    return std::accumulate(v.begin(), v.end(), 0.0) / 1024.0 * kDynamicRangeDb / 256.0;
  };
  EXPECT_NEAR(level(60.0) - level(40.0), threshold_db(40.0) - threshold_db(60.0),
              kDynamicRangeDb / 256.0);
}

TEST(Receiver, StcFollowsTheCubeOfRangeAndEndsWhereItSays) {
  EXPECT_NEAR(stc_db(50.0, 2000.0) - stc_db(50.0, 4000.0), 30.0 * std::log10(2.0), 1e-9);
  EXPECT_EQ(stc_db(50.0, 4.0 * 1852.0), 0.0);
  EXPECT_GT(stc_db(50.0, 3.99 * 1852.0), 0.0);
  EXPECT_EQ(stc_db(0.0, 10.0), 0.0);
  EXPECT_EQ(stc_db(100.0, 0.0), kMaxStcDb);
}

TEST(Receiver, StcKeepsASurfaceEchoLevelAcrossRange) {
  const ViewControls set = controls(3, 50.0, 60.0);
  std::vector<float> clutter(1024);
  const double cell = kGeometry.cell_size(set.range_scale).in_metres();
  for (std::size_t i = 0; i < 1024; ++i)
    clutter[i] = static_cast<float>(1e13 / std::pow((static_cast<double>(i) + 0.5) * cell, 3));
  const auto v = video_of(Receiver(kGeometry, set), clutter);
  EXPECT_NEAR(v[300], v[1000], 2);
}

TEST(Receiver, FourBitsUseSixteenLevels) {
  const Receiver receiver({2048, 1024, 4}, controls(6, 50.0));
  std::vector<float> power(1024);
  for (std::size_t i = 0; i < 1024; ++i) power[i] = std::exp2(static_cast<float>(i) * 0.03f);
  int top = 0;
  for (std::uint8_t v : video_of(receiver, power)) top = std::max<int>(top, v);
  EXPECT_EQ(top, 15);
}

TEST(Receiver, RainControlKeepsFrontsAndTakesDepth) {
  std::vector<float> power(1024, 0.0f);
  std::fill(power.begin() + 300, power.begin() + 800, 1000.0f);
  const auto plain = video_of(Receiver(kGeometry, controls(6, 50.0)), power);
  const auto dry = video_of(Receiver(kGeometry, controls(6, 50.0, 0.0, 80.0)), power);
  EXPECT_EQ(plain[300], dry[300]);
  EXPECT_LT(dry[700], 0.5 * plain[700]);
  EXPECT_GT(plain[700], 50);
}

}  // namespace
}  // namespace skerry::echo
