#include "echo/receiver/view_receiver.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "echo/kernel/isa.hpp"
#include "tests/unit/receiver/detection.hpp"
#include "tests/unit/receiver/view_setup.hpp"

namespace skerry::echo {
namespace {

ViewControls with_everything(double nm) {
  ViewControls controls = controls_of(nm, 80.0);
  controls.sea = 50.0;
  controls.sea_auto = true;
  controls.rain = 40.0;
  controls.interference_rejection = 60.0;
  controls.integration = 100.0;
  controls.echo_stretch = 70.0;
  controls.stretch_bearing = true;
  return controls;
}

double busy(std::uint64_t spoke, std::uint32_t cell) {
  const double clutter = 1e4 / std::pow(1.0 + cell / 20.0, 3.0) * fluctuation(spoke, cell);
  const bool ship = spoke % 200 < 14 && cell % 170 < 5;
  const bool strobe = spoke % 97 == 0 && cell > 500;
  return clutter + (ship ? 3e6 : 0.0) + (strobe ? 1e4 : 0.0);
}

// SOURCES.md "Pictures (h)": 49 % at gain 95.  At gain 50 a cell shows one step above 10 dB:
// exp(-10.41).
TEST(ViewReceiver, NoiseSparklesAsOnARealSet) {
  const RadarModel model = model_of(6.0);
  const double high = share_on(video_of(model, controls_of(6.0, 95.0), silence, 400), 20);
  const double normal = share_on(video_of(model, controls_of(6.0, 50.0), silence, 4096), 20);
  std::printf("cells on by noise: %.3f at gain 95, %.2e at gain 50\n", high, normal);
  EXPECT_NEAR(high, 0.49, 0.02);
  EXPECT_NEAR(normal, 3.0e-5, 0.9e-5);
}

// SOURCES.md "Receiver": raising gain by x dB lifts noise by x dB; here its upper decile, which no
// setting of the two clips.
TEST(ViewReceiver, GainLiftsNoiseByItsDecibels) {
  const RadarModel model = model_of(6.0);
  const auto decile = [&](double gain) {
    auto video = video_of(model, controls_of(6.0, gain), silence, 400);
    const auto at = video.begin() + static_cast<std::ptrdiff_t>(video.size() * 9 / 10);
    std::nth_element(video.begin(), at, video.end());
    return *at * kStepDb;
  };
  EXPECT_NEAR(decile(100.0) - decile(85.0), threshold_db(85.0) - threshold_db(100.0), 2 * kStepDb);
}

TEST(ViewReceiver, ReadsDecibels) {
  const RadarModel model = model_of(6.0);
  ViewReceiver receiver(model, controls_of(6.0));
  for (double db : {15.0, 30.0, 50.0}) {
    const double power = std::pow(10.0, db / 10.0);
    EXPECT_NEAR(receiver.level_of(power, 500) * kStepDb, db - threshold_db(50.0), 1e-5);
    const auto video = video_of(
        model, controls_of(6.0), [&](auto, auto) { return power; }, 16);
    double sum = 0.0;
    for (std::uint32_t i = 100; i < kCells; ++i) sum += video[i] + 0.5;
    EXPECT_NEAR(sum / (kCells - 100) * kStepDb, db - threshold_db(50.0), db < 20.0 ? 0.6 : 0.3);
  }
}

TEST(ViewReceiver, StcKeepsASurfaceEchoLevelAcrossRange) {
  ViewControls controls = controls_of(3.0);
  controls.sea = 60.0;
  const auto video = video_of(
      model_of(3.0), controls,
      [](auto, std::uint32_t i) { return 1e14 / std::pow((i + 0.5) * 3.0 * 1852.0 / kCells, 3.0); },
      16);
  EXPECT_GT(video[300], 20);
  EXPECT_NEAR(video[300], video[1000], 3);
}

// SOURCES.md "Receiver": c/2 (tau + recovery) = 22.5 m for 0.05 us and 0.1 us.
TEST(ViewReceiver, IsBlindBeforeTheMinimumRange) {
  RadarSet set;
  set.pulses = {{0.05e-6, 20e6, 3000.0, 96.0}};
  const RadarModel model =
      radar_model(set, {kSpokes, kCells, 8}, *RangeScale::find(0.25), SpokeClock(24.0, kSpokes), 0);
  for (double nm : {0.25, 0.125}) {
    const double cell_m = nm * 1852.0 / kCells;
    const auto video = video_of(
        model, controls_of(nm, 80.0), [](auto, auto) { return 1e4; }, 16);
    std::uint32_t first = 0;
    while (first < kCells && video[first] == 0) ++first;
    std::printf("%.3f NM: first echo at %.2f m\n", nm, first * cell_m);
    EXPECT_NEAR(first * cell_m, 22.5, 0.25 * 1852.0 / kCells + cell_m);
  }
}

TEST(ViewReceiver, FourBitsAreTheUpperHalfOfEight) {
  ViewControls controls = with_everything(6.0);
  const auto eight = video_of(model_of(6.0), controls, busy, 320);
  const auto four = video_of(model_of(6.0, 1.25, kSpokes, 4), controls, busy, 320);
  std::uint8_t top = 0;
  for (std::size_t i = 0; i < eight.size(); ++i) {
    ASSERT_EQ(four[i], eight[i] >> 4);
    top = std::max(top, four[i]);
  }
  EXPECT_EQ(top, 15);
}

TEST(ViewReceiver, VideoIsTheSameForAnyNumberOfSpokesToACallAndAnyOrderOfWork) {
  const RadarModel model = model_of(6.0);
  const ParallelFor backwards = [](std::size_t n, const std::function<void(std::size_t)>& body) {
    while (n-- > 0) body(n);
  };
  for (double nm : {6.0, 3.0, 12.0}) {
    const auto expected = video_of(model, with_everything(nm), busy, 700);
    for (std::uint32_t sector : {1u, 7u, 64u, 150u})
      EXPECT_EQ(video_of(model, with_everything(nm), busy, 700, sector), expected) << sector;
    EXPECT_EQ(video_of(model, with_everything(nm), busy, 700, 16, backwards), expected);
  }
}

TEST(ViewReceiver, VideoIsTheSameOnEveryInstructionSet) {
  const RadarModel model = model_of(6.0);
  for (double nm : {6.0, 0.5, 12.0}) {
    std::vector<std::uint8_t> expected;
    for (Isa isa : {Isa::baseline, Isa::avx2, Isa::avx512}) {
      force_isa(isa);
      const auto video = video_of(model, with_everything(nm), busy, 300);
      if (expected.empty()) expected = video;
      EXPECT_EQ(video, expected) << name_of(isa);
    }
    force_isa(best_isa());
  }
}

TEST(ViewReceiver, GainLeavesWhatTheReceiverHasLearnt) {
  const RadarModel model = model_of(6.0);
  const ViewControls controls = with_everything(6.0);
  ViewReceiver turned(model, controls), steady(model, controls);
  (void)video_of(turned, busy, 0, 320);
  (void)video_of(steady, busy, 0, 320);
  ViewControls other = controls;
  other.gain = 40.0;
  turned.set_controls(other);
  turned.set_controls(controls);
  EXPECT_EQ(video_of(turned, busy, 320, 64), video_of(steady, busy, 320, 64));
}

TEST(ViewReceiver, ViewsOfOneRadarShareItsNoise) {
  const RadarModel model = model_of(6.0);
  const auto low = video_of(model, controls_of(6.0, 80.0), silence, 64);
  const auto high = video_of(model, controls_of(6.0, 100.0), silence, 64);
  const double lift = (threshold_db(80.0) - threshold_db(100.0)) / kStepDb;
  for (std::size_t i = 0; i < low.size(); ++i) {
    if (low[i] == 0) continue;
    ASSERT_NEAR(high[i], std::min(255.0, low[i] + lift), 1.01);
  }
}

// A point stays where it is, on a view of any scale.
TEST(ViewReceiver, AViewShowsAnEchoAtItsRange) {
  const RadarModel model = model_of(6.0);
  const double cell_m = 6.0 * 1852.0 / kCells;
  const std::uint32_t where = 100;
  const auto point = [](auto, std::uint32_t cell) { return cell == where ? 1e4 : 0.0; };
  for (double nm : {0.75, 1.5, 3.0, 6.0, 12.0, 24.0, 72.0}) {
    for (Decimation decimation : {Decimation::peak, Decimation::mean}) {
      ViewControls controls = controls_of(nm, 40.0);
      controls.decimation = decimation;
      const auto video = video_of(model, controls, point, 16);
      const auto peak = static_cast<std::uint32_t>(
          std::max_element(video.begin(), video.begin() + kCells) - video.begin());
      const double view_cell = nm * 1852.0 / kCells;
      EXPECT_NEAR((peak + 0.5) * view_cell, (where + 0.5) * cell_m, 0.5 * (cell_m + view_cell))
          << nm;
    }
  }
}

TEST(ViewReceiver, SaysWhatTheRadarDoesNotReachAndShowsNothingThere) {
  const RadarModel model = model_of(6.0);
  const auto loud = [](auto, auto) { return 1e3; };
  EXPECT_TRUE(ViewReceiver(model, controls_of(6.0)).reaches());
  EXPECT_TRUE(ViewReceiver(model, controls_of(0.75)).reaches());
  for (double nm : {12.0, 24.0, 72.0}) {
    EXPECT_FALSE(ViewReceiver(model, controls_of(nm)).reaches());
    const auto video = video_of(model, controls_of(nm, 100.0), loud, 16);
    const auto reach = static_cast<std::uint32_t>(kCells * 6.0 / nm);
    for (std::uint32_t i = 10; i < kCells; ++i) {
      if (i < reach) {
        EXPECT_GT(video[i], 100) << i;
      } else {
        EXPECT_EQ(video[i], 0) << i;
      }
    }
  }
}

TEST(ViewReceiver, PeaksKeepAPointThatMeansLose) {
  const RadarModel model = model_of(6.0);
  const auto point = [](auto, std::uint32_t cell) { return cell == 401 ? 1e4 : 0.0; };
  ViewControls controls = controls_of(24.0, 60.0);
  const auto level = [&] {
    const auto video = video_of(model, controls, point, 16);
    return *std::max_element(video.begin(), video.begin() + kCells) * kStepDb;
  };
  const double peak = level();
  controls.decimation = Decimation::mean;
  EXPECT_NEAR(peak - level(), 10.0 * std::log10(4.0), 1.0);
}

}  // namespace
}  // namespace skerry::echo
