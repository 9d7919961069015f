// The controls that displays of other makers have: what each does to the picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "echo/kernel/isa.hpp"
#include "tests/unit/receiver/view_setup.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kShip = 400;  // cell of all echoes here

// A point echo as the two-way beam of model_of() draws it about a spoke.
double in_beam(std::uint64_t spoke, double middle, double beam_spokes = 1.25 * kSpokes / 360.0) {
  const double off = (static_cast<double>(spoke) - middle) / beam_spokes;
  return std::exp(-8.0 * std::log(2.0) * off * off);
}

// Spokes that show anything in the cell of the ships.
std::vector<std::uint32_t> shown(std::span<const std::uint8_t> video, int least = 60) {
  std::vector<std::uint32_t> spokes;
  for (std::uint32_t s = 0; s * kCells < video.size(); ++s) {
    if (video[std::size_t{s} * kCells + kShip] >= least) spokes.push_back(s);
  }
  return spokes;
}

// Rows of a call with those that come ahead, as a radar gives them.
std::vector<std::uint8_t> video_ahead(const ViewControls& controls, const Echo& echo,
                                      std::uint32_t count, std::uint32_t sector = 16) {
  ViewReceiver receiver(model_of(6.0), controls);
  const std::uint32_t ahead = receiver.rows_ahead();
  const std::size_t pitch = kCells + 16;
  std::vector<float> rows((sector + ahead) * pitch);
  std::vector<std::uint8_t> video(std::size_t{count} * kCells);
  for (std::uint32_t done = 0; done < count; done += sector) {
    for (std::uint32_t k = 0; k < sector + ahead; ++k) {
      for (std::uint32_t i = 0; i < kCells; ++i)
        rows[k * pitch + i] = static_cast<float>(echo(done + k, i));
    }
    receiver.receive(
        rows, pitch, done, sector, 1, serial_for,
        std::span(video).subspan(std::size_t{done} * kCells, std::size_t{sector} * kCells), ahead);
  }
  return video;
}

TEST(DisplayControls, TargetSeparationHalvesTheBeamAndKeepsItsMiddle) {
  const Echo ship = [](std::uint64_t spoke, std::uint32_t cell) {
    return cell == kShip ? 1e4 * in_beam(spoke, 100.0) : 0.0;
  };
  ViewControls controls = controls_of(6.0);
  const auto wide = shown(video_ahead(controls, ship, 208));
  std::size_t before = wide.size();
  for (const double separation : {33.0, 66.0, 100.0}) {
    controls.target_separation = separation;
    const auto narrow = shown(video_ahead(controls, ship, 208));
    EXPECT_LT(narrow.size(), before) << separation;
    before = narrow.size();
    EXPECT_NEAR(0.5 * (narrow.front() + narrow.back()), 100.0, 0.6) << separation;
  }
  EXPECT_NEAR(static_cast<double>(before), 0.5 * static_cast<double>(wide.size()), 2.0);
}

TEST(DisplayControls, TargetSeparationParesTwoShipsApart) {
  const double apart = 0.9 * 1.25 * kSpokes / 360.0;  // nine tenths of the beam
  const Echo ships = [&](std::uint64_t spoke, std::uint32_t cell) {
    if (cell != kShip) return 0.0;
    return 1e4 * (in_beam(spoke, 100.0 - 0.5 * apart) + in_beam(spoke, 100.0 + 0.5 * apart));
  };
  ViewControls controls = controls_of(6.0);
  const auto dip = [&] {
    const auto video = video_ahead(controls, ships, 208);
    const auto at = [&](double spoke) {
      return static_cast<int>(video[static_cast<std::size_t>(spoke) * kCells + kShip]);
    };
    return at(100.0 - 0.5 * apart) - at(100.0);
  };
  const int plain = dip();
  controls.target_separation = 100.0;
  EXPECT_GT(dip(), plain + 10);
}

TEST(DisplayControls, SideLobeSuppressionTakesWhatAStrongEchoThrowsAllRound) {
  // 80 dB over noise, and its side lobes 57 dB below that, half a turn away; a boat that is no side
  // lobe stands there too, in another cell.
  const Echo echo = [](std::uint64_t spoke, std::uint32_t cell) {
    if (cell == 700) return spoke > 2000 && spoke < 2020 ? 200.0 : 0.0;
    if (cell != kShip) return 0.0;
    return spoke >= 100 && spoke < 114 ? 1e8 : 200.0;
  };
  ViewControls controls = controls_of(6.0);
  const auto level = [&](std::uint32_t cell) {
    const auto video = video_of(model_of(6.0), controls, echo, 2032);
    double sum = 0.0;
    for (std::uint32_t s = 2001; s < 2019; ++s) sum += video[std::size_t{s} * kCells + cell];
    return sum / 18.0;
  };
  EXPECT_GT(level(kShip), 50.0);
  controls.side_lobe_suppression = 60.0;
  EXPECT_LT(level(kShip), 2.0);
  EXPECT_GT(level(700), 50.0);
  controls.side_lobe_suppression = 5.0;
  EXPECT_GT(level(kShip), 50.0) << "little suppression leaves what stands out";
  controls.side_lobe_suppression = 0.0;
  controls.side_lobe_auto = true;
  EXPECT_LT(level(kShip), 2.0);
}

TEST(DisplayControls, SideLobeSuppressionForgetsAStrongEchoATurnAfterItHasGone) {
  ViewControls controls = controls_of(6.0);
  controls.side_lobe_suppression = 60.0;
  const auto video = video_of(
      model_of(6.0), controls,
      [](std::uint64_t spoke, std::uint32_t cell) {
        return cell != kShip ? 0.0 : spoke < 16 ? 1e8 : 200.0;
      },
      3 * kSpokes);
  const auto at = [&](std::uint32_t spoke) { return video[std::size_t{spoke} * kCells + kShip]; };
  EXPECT_LT(at(kSpokes + 1000), 5);
  EXPECT_GT(at(2 * kSpokes + 1000), 30);
}

TEST(DisplayControls, NoiseRejectionTakesNoiseAndLeavesEchoesAsStrongAsTheyAre) {
  ViewControls controls = controls_of(6.0, 95.0);
  const Echo boat = [](std::uint64_t, std::uint32_t cell) { return cell == kShip ? 300.0 : 0.0; };
  const auto noisy = video_of(model_of(6.0), controls, boat, 64);
  double before = share_on(noisy, 20, 300);
  EXPECT_GT(before, 0.4);
  for (const double rejection : {25.0, 50.0, 100.0}) {
    controls.noise_rejection = rejection;
    const auto clean = video_of(model_of(6.0), controls, boat, 64);
    EXPECT_LT(share_on(clean, 20, 300), 0.7 * before) << rejection;
    before = share_on(clean, 20, 300);
    for (std::size_t s = 0; s < 64; ++s)
      EXPECT_EQ(clean[s * kCells + kShip], noisy[s * kCells + kShip]) << rejection;
  }
  EXPECT_LT(before, 1e-4);
}

TEST(DisplayControls, TargetBoostRaisesSmallEchoesAndNotStrongOnes) {
  ViewControls controls = controls_of(6.0);
  const auto level = [&](double power) {
    return static_cast<double>(video_of(
               model_of(6.0), controls, [&](auto, auto) { return power; }, 1)[kShip]) *
           kStepDb;
  };
  const double small = level(300.0), strong = level(3e5);
  controls.target_boost = 100.0;
  EXPECT_GT(level(300.0), small + 5.0);
  EXPECT_LT(level(300.0), small + 10.0);
  EXPECT_NEAR(level(3e5), strong, 0.6);
  // Noise alone is not boosted: as much of it shows at a gain that lets some of it through.
  controls.gain = 80.0;
  const double boosted = share_on(video_of(model_of(6.0), controls, silence, 400), 20);
  controls.target_boost = 0.0;
  const double plain = share_on(video_of(model_of(6.0), controls, silence, 400), 20);
  EXPECT_GT(plain, 1e-3);
  EXPECT_LT(boosted, 1.1 * plain);
}

TEST(DisplayControls, AutomaticGainIsGainFiftyOnOpenWaterAndLessInTheRain) {
  ViewControls automatic = controls_of(6.0, 90.0);
  automatic.gain_auto = true;
  const std::uint32_t three = 3 * kSpokes;
  const auto last_turn = [&](const ViewControls& controls, const Echo& echo) {
    auto video = video_of(model_of(6.0), controls, echo, three);
    return share_on(std::span(video).last(std::size_t{kSpokes} * kCells), 40);
  };
  const double open = last_turn(automatic, silence);
  EXPECT_LT(open, 2e-4);
  const Echo rain = [](std::uint64_t spoke, std::uint32_t cell) {
    return 30.0 * fluctuation(spoke, cell);
  };
  EXPECT_LT(last_turn(automatic, rain), 0.5 * last_turn(controls_of(6.0, 50.0), rain));
}

TEST(DisplayControls, AutomaticGainWeighsWhatTheSeaControlLeaves) {
  ViewControls automatic = controls_of(6.0);
  automatic.gain_auto = true;
  automatic.sea = 100.0;  // takes 30 dB off and more, everywhere
  const Echo boat = [](std::uint64_t spoke, std::uint32_t cell) {
    return cell == kShip && spoke % 512 < 14 ? 1e7 : 0.0;
  };
  ViewControls manual = automatic;
  manual.gain_auto = false;
  ViewReceiver one(model_of(6.0), automatic), other(model_of(6.0), manual);
  const auto a = video_of(one, boat, 0, 2 * kSpokes), b = video_of(other, boat, 0, 2 * kSpokes);
  EXPECT_GE(a[std::size_t{kSpokes + 5} * kCells + kShip],
            b[std::size_t{kSpokes + 5} * kCells + kShip]);
}

TEST(DisplayControls, VideoIsTheSameHoweverWorkIsCut) {
  ViewControls controls = controls_of(6.0, 70.0);
  controls.gain_auto = true;
  controls.side_lobe_auto = true;
  controls.noise_rejection = 30.0;
  controls.target_boost = 50.0;
  controls.interference_rejection = 40.0;
  const Echo busy = [](std::uint64_t spoke, std::uint32_t cell) {
    return 50.0 * fluctuation(spoke, cell) + (spoke % 300 < 14 && cell % 90 < 3 ? 1e6 : 0.0);
  };
  const ParallelFor backwards = [](std::size_t n, const std::function<void(std::size_t)>& body) {
    while (n-- > 0) body(n);
  };
  const RadarModel model = model_of(6.0, 5.0, 512);
  const std::uint32_t count = 1100;  // two turns
  for (const double nm : {6.0, 3.0}) {
    controls.range_scale = *RangeScale::find(nm);
    const auto expected = video_of(model, controls, busy, count);
    for (const std::uint32_t sector : {1u, 64u})
      EXPECT_EQ(video_of(model, controls, busy, count, sector), expected);
    EXPECT_EQ(video_of(model, controls, busy, count, 16, backwards), expected);
    force_isa(Isa::baseline);
    EXPECT_EQ(video_of(model, controls, busy, count), expected);
    force_isa(best_isa());
  }
}

TEST(DisplayControls, ModesDecideWhatTheyAreForAndLeaveTheRest) {
  ViewControls asked = controls_of(6.0, 11.0);
  asked.mode = PictureMode::custom;
  EXPECT_EQ(effective_controls(asked), asked);
  asked.doppler = DopplerMode::both;
  asked.instrumented_range_m = 15'000.0;
  asked.decimation = Decimation::mean;
  std::vector<ViewControls> seen = {asked};
  for (const PictureMode mode : {PictureMode::harbour, PictureMode::offshore, PictureMode::buoy,
                                 PictureMode::weather, PictureMode::bird}) {
    asked.mode = mode;
    const ViewControls made = effective_controls(asked);
    EXPECT_EQ(fault_of(made), std::nullopt);
    EXPECT_EQ(made.mode, PictureMode::custom);
    EXPECT_EQ(made.doppler, DopplerMode::both);
    EXPECT_EQ(made.instrumented_range_m, 15'000.0);
    EXPECT_EQ(made.decimation, Decimation::mean);
    EXPECT_EQ(std::count(seen.begin(), seen.end(), made), 0) << "no two modes are alike";
    seen.push_back(made);
    ViewControls other = asked;
    other.gain = 88.0, other.sea = 3.0, other.rain = 70.0, other.integration = 90.0;
    EXPECT_EQ(effective_controls(other), made) << "a mode decides by itself";
  }
}

}  // namespace
}  // namespace skerry::echo
