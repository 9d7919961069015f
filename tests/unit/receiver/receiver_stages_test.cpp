#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "echo/receiver/azimuth_memory.hpp"
#include "tests/unit/receiver/detection.hpp"
#include "tests/unit/receiver/view_setup.hpp"

namespace skerry::echo {
namespace {

// Power of a ship of the given peak as the two-way beam passes her at `bearing` spokes.
double passing_power(double peak, double spoke, double bearing, double beam_spokes) {
  const double off = (spoke - bearing) / beam_spokes;  // of the -3 dB width, one way
  return std::fabs(off) > 1.3 ? 0.0 : peak * std::exp2(-8.0 * off * off);
}

TEST(Rejection, TakesAwayAStrobeAndLeavesAShip) {
  const RadarModel model = model_of(6.0);
  const double beam_spokes = 1.25 / (360.0 / kSpokes);
  const auto scene = [&](std::uint64_t spoke, std::uint32_t cell) {
    double power = 0.0;
    if (cell >= 300 && cell < 303)
      power += passing_power(1e5, static_cast<double>(spoke), 100.0, beam_spokes);
    if (spoke == 60 && cell > 500) power += 1e3;
    return power;
  };
  ViewControls controls = controls_of(6.0);
  const auto plain = video_of(model, controls, scene, 200);
  controls.interference_rejection = 50.0;
  const auto clean = video_of(model, controls, scene, 200);
  const auto strobe = [](const auto& video) {
    return share_on(std::span(video).subspan(60 * kCells, kCells), 501);
  };
  EXPECT_GT(strobe(plain), 0.95);
  EXPECT_LT(strobe(clean), 0.01);
  const auto extent = [](const auto& video) {
    int spokes = 0;
    for (std::size_t s = 0; s < 200; ++s) spokes += video[s * kCells + 301] > 0;
    return spokes;
  };
  std::printf("ship: %d spokes, %d with rejection\n", extent(plain), extent(clean));
  EXPECT_GT(extent(plain), 15);
  EXPECT_GE(extent(clean), extent(plain) - 1);
  for (std::size_t s = 95; s <= 105; ++s)
    EXPECT_EQ(clean[s * kCells + 301], plain[s * kCells + 301]);
}

TEST(Rejection, GrowsWithItsControlAndIsOffWhereABeamIsOneSpoke) {
  EXPECT_EQ(azimuth_stages(1.25, 4096, 0.0, 0.0, 0).rejection_db, 0.0);
  EXPECT_NEAR(azimuth_stages(1.25, 4096, 1.0, 0.0, 0).rejection_db, 20.0, 0.2);
  EXPECT_NEAR(azimuth_stages(1.25, 4096, 100.0, 0.0, 0).rejection_db, 6.0, 1e-9);
  EXPECT_EQ(azimuth_stages(1.25, 512, 100.0, 0.0, 0).rejection_db, 0.0);
}

// P that the sum of k exponentials passes t: that of fewer than k events of a Poisson of mean t.
double sum_passes(int k, double t) {
  double event = std::exp(-t), sum = event;
  for (int i = 1; i < k; ++i) event *= t / i, sum += event;
  return sum;
}

// SOURCES.md "Vectors": ten pulses of a steady target need 3.353 dB each where one needs 10.984, by
// Albersheim; SOURCES.md "Receiver": non-coherent gain n^0.7 .. n^0.8.  The exact Pd at 3.353 dB is
// a Poisson sum.
TEST(Integration, OverTenSpokesGainsWhatTheoryGives) {
  double low = 0.0, high = 10.0;
  while (high - low > 1e-9) {
    const double t = 0.5 * (low + high);
    (sum_passes(10, 10.0 * t) > 1e-4 ? low : high) = t;
  }
  const double snr = 10.0 * std::pow(10.0, 0.3353);
  double chance = std::exp(-snr), theory = 0.0;
  for (int k = 0; k < 200; ++k) {
    theory += chance * sum_passes(10 + k, 10.0 * low);
    chance *= snr / (k + 1);
  }
  const RadarModel model = model_of(6.0);
  ViewControls controls = controls_of(6.0);
  controls.integration = 100.0;
  ASSERT_EQ(azimuth_stages(1.25, kSpokes, 0.0, 100.0, 0).integrated, 10u);
  // The threshold is where video reads 30.
  constexpr int kRead = 30;
  controls.gain = (threshold_db(0.0) - 10.0 * std::log10(low) + kRead * kStepDb) /
                  (threshold_db(0.0) - threshold_db(1.0));
  ASSERT_LE(controls.gain, 100.0);
  const auto steady = [](auto, auto) { return std::pow(10.0, 0.3353); };
  const auto over = [&](const Echo& echo, std::uint32_t spokes) {
    const auto video = video_of(model, controls, echo, spokes);
    double on = 0.0, all = 0.0;
    for (std::size_t s = 16; s < spokes; ++s) {
      for (std::uint32_t i = 20; i < kCells; ++i) on += video[s * kCells + i] >= kRead, all += 1.0;
    }
    return on / all;
  };
  const double pfa = over(silence, 2000), pd = over(steady, 300);
  std::printf("10 spokes at 3.353 dB each: Pfa %.2e, Pd %.3f (exact %.3f); gain n^%.3f\n", pfa, pd,
              theory, (10.984 - 3.353) / 10.0);
  EXPECT_NEAR(pfa, 1e-4, 0.6e-4);
  EXPECT_NEAR(pd, theory, 0.02);
  EXPECT_NEAR(pd, 0.8, 0.05);
}

TEST(Integration, LeavesNothingOfAStrongEchoBehind) {
  const RadarModel model = model_of(6.0);
  ViewControls controls = controls_of(6.0, 95.0);
  controls.integration = 100.0;
  const auto loud_once = [](std::uint64_t spoke, auto) { return spoke == 50 ? 1e12 : 0.0; };
  const auto quiet = video_of(model, controls, silence, 200);
  const auto loud = video_of(model, controls, loud_once, 200);
  for (std::size_t s = 0; s < 200; ++s) {
    const bool holds = s >= 50 && s < 60;
    EXPECT_EQ(std::equal(quiet.begin() + static_cast<std::ptrdiff_t>(s * kCells),
                         quiet.begin() + static_cast<std::ptrdiff_t>((s + 1) * kCells),
                         loud.begin() + static_cast<std::ptrdiff_t>(s * kCells)),
              !holds)
        << s;
  }
}

// Video of spokes `first` .. with the rows ahead that the receiver asks for, in calls of `sector`.
std::vector<std::uint8_t> video_ahead(ViewReceiver& receiver, const Echo& echo, std::uint64_t first,
                                      std::uint32_t count, std::uint32_t sector) {
  const std::size_t pitch = kCells + 16;
  const std::uint32_t ahead = receiver.rows_ahead();
  std::vector<float> rows((sector + ahead) * pitch);
  std::vector<std::uint8_t> video(std::size_t{count} * kCells);
  for (std::uint32_t done = 0; done < count; done += sector) {
    const std::uint32_t n = std::min(sector, count - done);
    for (std::uint32_t k = 0; k < n + ahead; ++k) {
      for (std::uint32_t i = 0; i < kCells; ++i)
        rows[k * pitch + i] = static_cast<float>(echo(first + done + k, i));
    }
    receiver.receive(rows, pitch, first + done, n, 1, serial_for,
                     std::span(video).subspan(std::size_t{done} * kCells, std::size_t{n} * kCells),
                     ahead);
  }
  return video;
}

TEST(Integration, LiesOnTheEchoesOwnBearingWhereRowsAheadAreGiven) {
  const RadarModel model = model_of(6.0);
  ViewControls controls = controls_of(6.0);
  controls.integration = 100.0;
  const auto once = [](std::uint64_t spoke, std::uint32_t cell) {
    return cell == 400 && (spoke == 50 || spoke == 1003) ? 1e6 : 0.0;
  };
  std::vector<std::uint8_t> first;
  for (const std::uint32_t sector : {16u, 1u, 7u, 64u, 200u}) {
    ViewReceiver receiver(model, controls);
    ASSERT_EQ(receiver.rows_ahead(), 4u);  // of ten spokes
    const auto video = video_ahead(receiver, once, 0, 200, sector);
    for (std::uint32_t s = 0; s < 200; ++s)
      EXPECT_EQ(video[s * kCells + 400] > 0, s >= 46 && s <= 55) << s << " in " << sector;
    // And behind a jump.
    const auto after = video_ahead(receiver, once, 1000, 40, sector);
    for (std::uint32_t s = 0; s < 40; ++s)
      EXPECT_EQ(after[s * kCells + 400] > 0, s <= 8) << s << " in " << sector;
    if (first.empty()) first = video;
    EXPECT_EQ(video, first) << sector;
  }
}

TEST(Integration, OfTheSetHoldsWhateverTheViewAsksForLess) {
  RadarModel model = model_of(6.0);
  ViewControls controls = controls_of(6.0, 95.0);
  controls.integration = 100.0;
  const auto asked = video_of(model, controls, silence, 100);
  model.set.integration = 100.0;
  controls.integration = 30.0;
  EXPECT_EQ(video_of(model, controls, silence, 100), asked);
  model.set.integration = 0.0;
  EXPECT_NE(video_of(model, controls, silence, 100), asked);
}

// One cell of one spoke, saturated, with and without integration beside the smoothing.
TEST(VideoSmoothing, LiesOnTheEchoesOwnBearing) {
  RadarModel model = model_of(6.0);
  model.set.video_smoothing = 4;
  ViewControls controls = controls_of(6.0, 0.0);
  const auto once = [](std::uint64_t spoke, std::uint32_t cell) {
    return cell == 400 && spoke == 50 ? 1e9 : 0.0;
  };
  const double weights[] = {1, 2, 3, 4, 3, 2, 1};
  std::vector<std::uint8_t> first;
  for (const std::uint32_t sector : {16u, 1u, 5u, 64u, 128u}) {
    ViewReceiver receiver(model, controls);
    ASSERT_EQ(receiver.rows_ahead(), 3u);
    const auto video = video_ahead(receiver, once, 0, 128, sector);
    for (std::uint32_t s = 44; s < 57; ++s) {
      for (std::uint32_t c = 394; c < 407; ++c) {
        const bool near = s >= 47 && s < 54 && c >= 397 && c < 404;
        const double exact = near ? 255.0 * weights[s - 47] * weights[c - 397] / 256.0 : 0.0;
        EXPECT_NEAR(video[s * kCells + c], exact, 0.75) << s << ", " << c << " in " << sector;
      }
    }
    if (first.empty()) first = video;
    EXPECT_EQ(video, first) << sector;
  }
  controls.integration = 100.0;
  ViewReceiver receiver(model, controls);
  EXPECT_EQ(receiver.rows_ahead(), 4u + 3u);
}

TEST(VideoSmoothing, ShowsNothingWhereTheReceiverIsBlind) {
  RadarModel model = model_of(6.0);
  model.blind_cells = 20;
  const ViewControls controls = controls_of(6.0, 0.0);
  const auto ring = [](std::uint64_t, std::uint32_t cell) { return cell == 21 ? 1e9 : 0.0; };
  model.set.video_smoothing = 4;
  const auto video = video_of(model, controls, ring, 16);
  EXPECT_EQ(video[15 * kCells + 19], 0);
  EXPECT_GT(video[15 * kCells + 20], 0);
}

// Echoes of every level of the video, one cell each, so strong that noise does not matter.
TEST(VideoLevels, OfTheSetAreWhereItHasThem) {
  for (const std::uint32_t bits : {4u, 8u}) {
    RadarModel model = model_of(6.0, 1.25, kSpokes, bits);
    model.set.levels = {{0.25, 1}, {0.5, 2}, {0.75, 15}};
    ViewControls controls = controls_of(6.0, 0.0);
    const ViewReceiver receiver(model, controls);
    const auto ladder = [&](auto, std::uint32_t cell) {
      // The power whose even level is cell - 100, of 256.
      return std::pow(10.0, 0.1 * (threshold_db(0.0) + kStepDb * (cell - 100.0 + 0.5)));
    };
    const auto video = video_of(model, controls, ladder, 1);
    const std::uint32_t unit = bits == 4 ? 1 : 16;
    for (const auto& [even, shown] : {std::pair{20u, 0u},
                                      {60u, 0u},
                                      {68u, 1u},
                                      {124u, 1u},
                                      {132u, 2u},
                                      {188u, 2u},
                                      {196u, 15u},
                                      {250u, 15u}})
      EXPECT_EQ(video[100 + even] / unit, shown) << even << " of " << bits << " bits";
  }
}

TEST(Stretch, WidensAPointInRangeAndBearing) {
  const RadarModel model = model_of(6.0);
  const auto point = [](std::uint64_t spoke, std::uint32_t cell) {
    return spoke == 40 && cell == 400 ? 1e4 : 0.0;
  };
  for (const auto& [control, cells] : {std::pair{0.0, 1}, {1.0, 3}, {50.0, 5}, {100.0, 7}}) {
    for (bool bearing : {false, true}) {
      ViewControls controls = controls_of(6.0, 40.0);
      controls.echo_stretch = control;
      controls.stretch_bearing = bearing;
      ViewReceiver receiver(model, controls);
      const auto video = video_of(receiver, point, 0, 100);
      int wide = 0, long_ = 0;
      for (std::uint32_t i = 390; i < 411; ++i) wide += video[40 * kCells + i] > 50;
      double sum = 0.0;
      for (std::uint32_t s = 0; s < 100; ++s) {
        if (video[s * kCells + 400] > 50) ++long_, sum += s;
      }
      EXPECT_EQ(wide, cells);
      EXPECT_EQ(long_, bearing ? cells : 1);
      EXPECT_NEAR(sum / long_, 40.0 + (bearing ? (cells - 1) / 2 : 0), 1e-9);  // only looks back
    }
  }
}

TEST(RainControl, KeepsFrontsAndTakesDepth) {
  const RadarModel model = model_of(6.0);
  const auto slab = [](std::uint64_t s, std::uint32_t i) {
    return i >= 300 && i < 800 ? 1e3 * fluctuation(s, i) : 0.0;
  };
  ViewControls controls = controls_of(6.0);
  const auto plain = video_of(model, controls, slab, 200);
  controls.rain = 100.0;
  const auto dry = video_of(model, controls, slab, 200);
  double front = 0, depth = 0, plain_depth = 0;
  for (std::size_t s = 0; s < 200; ++s) {
    front += std::abs(dry[s * kCells + 300] - plain[s * kCells + 300]);
    for (std::size_t i = 400; i < 800; ++i)
      depth += dry[s * kCells + i], plain_depth += plain[s * kCells + i];
  }
  EXPECT_EQ(front, 0.0);
  EXPECT_LT(depth, 0.25 * plain_depth);
  EXPECT_GT(share_on(plain, 400, 800), 0.95);
}

// SOURCES.md "Receiver": log-FTC is CFAR for Rayleigh clutter: what is left does not depend on its
// level.
TEST(RainControl, KeepsTheFalseAlarmRateWhateverTheClutter) {
  const RadarModel model = model_of(6.0);
  ViewControls controls = controls_of(6.0);
  controls.rain = 100.0;
  const auto left = [&](double db) {
    const double mean = std::pow(10.0, db / 10.0);
    const auto video = video_of(
        model, controls, [&](auto s, auto i) { return mean * fluctuation(s, i); }, 400);
    double over = 0.0, all = 0.0;
    for (std::size_t s = 0; s < 400; ++s) {
      for (std::size_t i = 200; i < kCells; ++i)
        over += video[s * kCells + i] > 6.0 / kStepDb, all += 1.0;
    }
    return over / all;
  };
  const double weak = left(32.0), middle = left(37.0), strong = left(42.0);
  std::printf("6 dB over the local mean: %.4f, %.4f, %.4f of cells at 32, 37, 42 dB\n", weak,
              middle, strong);
  EXPECT_GT(middle, 0.03);
  EXPECT_NEAR(weak / middle, 1.0, 0.1);
  EXPECT_NEAR(strong / middle, 1.0, 0.1);
}

}  // namespace
}  // namespace skerry::echo
