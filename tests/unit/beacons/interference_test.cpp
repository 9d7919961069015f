#include "echo/beacons/interference.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/beacons/pulse_train.hpp"
#include "echo/radar/beam.hpp"
#include "tests/unit/beacons/beacon_scene.hpp"

namespace skerry::echo {
namespace {

using beacons::at;
using beacons::hear;
using beacons::hear_turn;
using beacons::model_at;
using beacons::Picture;
using beacons::propagation_of;

// On the own frequency, its beam in step with the own one and towards us when ours is towards it.
Scene with_emitter(double range_m, double prf_hz) {
  Scene scene;
  Emitter emitter;
  emitter.place = at(0.0, range_m);
  emitter.prf_hz = prf_hz;
  emitter.bearing_deg = 180.0;
  emitter.identity = 11;
  scene.emitters = {emitter};
  return scene;
}

// Beginnings of dots, cells, in the order heard; parts of cells from their share.
struct Heard {
  std::size_t spoke;
  double from_m;
};
std::vector<Heard> dots_of(const RadarModel& model, const Picture& picture) {
  std::vector<Heard> out;
  for (std::size_t s = 0; s < picture.spokes(); ++s) {
    const auto row = picture.row(s);
    for (std::size_t i = 0; i + 1 < row.size(); ++i) {
      if (!(row[i] > 0.0f) || (i > 0 && row[i - 1] > 0.0f)) continue;
      // The first cell is covered in part, the next one whole.
      const double part = std::min(1.0, static_cast<double>(row[i] / row[i + 1]));
      out.push_back({s, (static_cast<double>(i) + 1.0 - part) * model.cell_m});
    }
  }
  return out;
}

TEST(Interference, EqualPrfMakesARing) {
  const RadarModel model = model_at(48.0);  // 600 Hz, one pulse in 2.7 spokes
  Scene scene = with_emitter(2000.0, model.pulse.prf_hz);
  for (std::uint64_t identity = 0;; ++identity) {  // one whose pulses fall into the window
    scene.emitters[0].identity = identity;
    const auto dots = dots_of(model, hear(model, scene, 0, 64));
    if (dots.empty() || dots[0].from_m > 80e3) continue;
    const auto ring = dots_of(model, hear_turn(model, scene));
    EXPECT_NEAR(static_cast<double>(ring.size()), 600.0 * 2.5, 15.0);  // less some in nulls
    for (const Heard& dot : ring) ASSERT_NEAR(dot.from_m, ring[0].from_m, 0.01 * model.cell_m);
    break;
  }
}

TEST(Interference, OtherPrfMakesASpiralOfTheirPeriodsDifference) {
  const RadarModel model = model_at(12.0);  // 1000 Hz
  for (const double prf : {1001.0, 999.0, 1003.0}) {
    const auto dots = dots_of(model, hear_turn(model, with_emitter(2000.0, prf)));
    ASSERT_GT(dots.size(), 100u);
    const double step = 0.5 * kLightSpeed * (1.0 / prf - 1e-3);
    const double once = 0.5 * kLightSpeed / prf;
    // Against the first dot: so many pulses later, so many steps on, whole trains apart.
    for (const Heard& dot : dots) {
      const double seconds = static_cast<double>(dot.spoke - dots[0].spoke) * 2.5 / 4096.0;
      double least = 1e9;
      for (int k = -1; k <= 1; ++k) {  // pulses are known to the spoke
        const double expected =
            (std::floor(seconds * 1000.0 + 0.5) + k) * step - (dot.from_m - dots[0].from_m);
        least = std::min(least, std::fabs(std::remainder(expected, once)));
      }
      ASSERT_LT(least, 0.5 * model.cell_m) << prf << " spoke " << dot.spoke;
    }
    // From one pulse to the next.
    for (std::size_t i = 1; i < 40; ++i) {
      if (dots[i].spoke - dots[i - 1].spoke > 2) continue;
      EXPECT_NEAR(dots[i].from_m - dots[i - 1].from_m, step, 0.05 * model.cell_m) << prf;
    }
  }
}

TEST(Interference, LiesWherePulsesCountedOneByOneFall) {
  // All pulses of both, as whole picoseconds, for the spokes of a second.
  const RadarModel model = model_at(24.0);
  const Scene scene = with_emitter(3000.0, 1234.5);
  const std::uint64_t first = 5'000'000;
  const Picture picture = hear(model, scene, first, 1600);
  const PulseTrain own(model.pulse.prf_hz, model.radar), other(1234.5, 11);
  const auto way = static_cast<__int128>(std::llround(3000.0 / kLightSpeed * 1e12));
  const __int128 begin =
      static_cast<__int128>(model.clock.time_of(first).time_since_epoch().count()) * 1000;
  std::size_t expected = 0, missed = 0;
  const auto spoke_of = [&](__int128 t) {
    std::uint64_t s = first;
    while (s < first + 1600 &&
           static_cast<__int128>(model.clock.time_of(s + 1).time_since_epoch().count()) * 1000 <= t)
      ++s;
    return s - first;
  };
  const __int128 own_phase = own.wait_ps(ScenarioTime{});
  const __int128 other_phase = other.wait_ps(ScenarioTime{});
  const double window = 24.0 * 1852.0;
  for (__int128 n = (begin - own_phase) / own.period_ps() + 1;; ++n) {
    const __int128 fired = own_phase + n * own.period_ps();
    const std::uint64_t spoke = spoke_of(fired);
    if (spoke >= 1600) break;
    for (__int128 m = (fired - way - other_phase) / other.period_ps() + 1;; ++m) {
      const __int128 heard = other_phase + m * other.period_ps() + way;
      if (heard < fired) continue;
      const double range = 0.5 * kLightSpeed * static_cast<double>(heard - fired) * 1e-12;
      if (range >= window - 2.0 * model.cell_m) break;
      ++expected;
      const auto row = picture.row(spoke);
      const auto cell = static_cast<std::size_t>(range / model.cell_m);
      missed += !(row[cell] + row[cell + 1] > 0.0f);
    }
  }
  EXPECT_GT(expected, 100u);
  EXPECT_LE(missed * 50, expected);  // in nulls of either pattern
  EXPECT_LE(dots_of(model, picture).size(), expected + 2);
}

TEST(Interference, IsTheSameAfterThirtyDays) {
  // Periods of 1 and 1.25 ms and turns of 2.5 s all divide thirty days.
  const RadarModel model = model_at(12.0);
  const Scene scene = with_emitter(4000.0, 800.0);
  const std::uint64_t thirty_days = 4096ull * 1'036'800;
  Scene later = scene;
  later.time = ScenarioTime{std::chrono::hours(30 * 24)};
  const Picture now = hear_turn(model, scene);
  ASSERT_GT(now.most(), 1.0f);
  EXPECT_EQ(hear(model, later, thirty_days, 4096).cells(), now.cells());
}

// At 3000 Hz against 20 000 every window holds a pulse, on spokes a twentieth of a degree from the
// axis: the strongest of a few spokes is the coupling.
RadarModel watchful_model() {
  RadarSet set;
  set.pulses = {{0.5e-6, 5e6, 3000.0, 96.0}};
  return model_at(6.0, set);
}
float coupling_at(const Scene& scene, std::uint64_t spoke) {
  return hear(watchful_model(), scene, spoke, 4).most();
}

TEST(Interference, CouplesByBothBeamsAsTheyTurn) {
  const double range = 30e3;
  Scene scene = with_emitter(range, 20000.0);
  const float both = coupling_at(scene, 0);
  const RadarModel model = watchful_model();
  const double free_space =
      OneWayLink(model).received(25e3 * std::pow(10.0, 3.1), range) *
      static_cast<double>(propagation_of(model, scene).one_way(range, 20.0)) *
      frequency_coupling(scene.emitters[0], model.set.frequency_hz, model.pulse.bandwidth_hz);
  EXPECT_NEAR(static_cast<double>(both) / free_space, 0.98, 0.03);

  scene.emitters[0].bearing_deg = 90.0;  // ours on it, its lobes on us
  const double to_side = 10.0 * std::log10(static_cast<double>(coupling_at(scene, 0) / both));
  EXPECT_LE(to_side, scene.emitters[0].side_lobe_db + 0.1);
  EXPECT_GE(to_side, scene.emitters[0].side_lobe_db - 15.0);

  scene.emitters[0].bearing_deg = 90.0;  // a quarter turn on it is towards us, ours is away
  const double from_side = 10.0 * std::log10(static_cast<double>(coupling_at(scene, 1024) / both));
  EXPECT_LE(from_side, model.set.far_side_lobe_db + 0.1);

  scene.emitters[0].bearing_deg = 180.0;  // both away
  const double sides = 10.0 * std::log10(static_cast<double>(coupling_at(scene, 1024) / both));
  EXPECT_LE(sides, scene.emitters[0].side_lobe_db + model.set.far_side_lobe_db + 0.1);
}

TEST(Interference, FarOffIsHeardByAMainBeamAlone) {
  // Beyond the horizon of both, 20 m high: only main beam to main beam or side lobe is left.
  const RadarModel model = model_at(48.0);
  Scene scene = with_emitter(48e3, 20000.0);
  scene.emitters[0].rpm = 25.7;  // out of step
  const Picture picture = hear(model, scene, 0, 4 * 4096);
  ASSERT_GT(picture.most(), 1.0f);
  std::size_t bright = 0;
  for (std::size_t s = 0; s < picture.spokes(); ++s) {
    if (picture.stretches(s, 1.0f).empty()) continue;
    ++bright;
    const double own = std::fabs(std::remainder(static_cast<double>(s) * 360.0 / 4096.0, 360.0));
    const std::uint32_t beam = beam_units(180.0, 25.7, model.clock.time_of(s)) - (1u << 31);
    const double its = std::fabs(static_cast<std::int32_t>(beam) * (360.0 / 4294967296.0));
    EXPECT_TRUE(own < 15.0 || its < 15.0) << own << ' ' << its;
  }
  EXPECT_LT(bright, picture.spokes() / 10);
}

TEST(Interference, FallsAsTheSquareOfTheRange) {
  const RadarModel model = watchful_model();
  const auto strength = [&](double range) {
    const Scene scene = with_emitter(range, 20000.0);
    return static_cast<double>(coupling_at(scene, 0)) /
           static_cast<double>(propagation_of(model, scene).one_way(range, 20.0));
  };
  for (const double range : {1500.0, 4000.0, 12000.0})
    EXPECT_NEAR(std::log2(strength(2.0 * range) / strength(range)), -2.0, 0.05) << range;
}

TEST(Interference, LosesWhatLiesBesideTheBand) {
  Emitter emitter;
  emitter.pulse_s = 0.5e-6;
  const double own = emitter.frequency_hz;
  EXPECT_DOUBLE_EQ(frequency_coupling(emitter, own, 5e6), 1.0);
  EXPECT_DOUBLE_EQ(frequency_coupling(emitter, own + 2.5e6, 5e6), 1.0);  // at the edge
  EXPECT_LT(frequency_coupling(emitter, own + 5e6, 5e6), 0.1);
  // Far beyond, 20 dB a decade: the envelope of a rectangular pulse's spectrum.
  const double near = frequency_coupling(emitter, own + 2.5e6 + 20e6, 5e6);
  const double far = frequency_coupling(emitter, own - 2.5e6 - 200e6, 5e6);
  EXPECT_NEAR(10.0 * std::log10(near / far), 20.0, 0.1);
  EXPECT_EQ(frequency_coupling(emitter, 3.05e9, 20e6), 0.0);
  emitter.pulse_s = 0.1e-6;  // a receiver for long pulses hears little of short ones
  EXPECT_NEAR(frequency_coupling(emitter, own, 1e6), 0.01, 1e-9);
}

TEST(Interference, TheEmittersBeamIsACosineTapersAndSideLobesAtItsLevel) {
  const auto units = [](double degrees) {
    return static_cast<std::uint32_t>(degrees / 360.0 * 4294967296.0);
  };
  double worst = 0.0;
  for (double off = 0.0; off < 1.2; off += 0.003) {
    const double v = cosine_taper_voltage(off, 1.2);
    worst = std::max(worst,
                     std::fabs(v * v - static_cast<double>(emitter_beam(units(off), 1.2, 0.0f))));
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_NEAR(static_cast<double>(emitter_beam(units(0.6), 1.2, 0.0f)), 0.5, 0.01);
  float most = 0.0f;
  for (double off = 2.0; off < 180.0; off += 0.01) {
    const float side = emitter_beam(units(off), 1.2, 0.0016f);
    EXPECT_EQ(side, emitter_beam(0u - units(off), 1.2, 0.0016f));
    most = std::max(most, side);
  }
  EXPECT_NEAR(most, 0.0016f, 1e-5f);
}

TEST(Interference, IsMostMarkedOnLongRangeScales) {
  const auto lit = [](double scale_nm) {
    const Picture picture = hear_turn(model_at(scale_nm), with_emitter(2000.0, 1777.0));
    return picture.bright_spokes(1.0f);
  };
  const std::size_t near = lit(0.75), middle = lit(6.0), far = lit(48.0);
  EXPECT_LT(near * 2, middle);
  EXPECT_LT(middle * 2, far);
}

TEST(Interference, BehindLandIsThirtyDecibelsLess) {
  const HiddenHeight cliff = [](std::uint32_t, double) { return 100.0f; };
  const RadarModel model = model_at(48.0);
  const Scene scene = with_emitter(10e3, 20000.0);
  EXPECT_NEAR(
      static_cast<double>(hear(model, scene, 0, 8, cliff).most() / hear(model, scene, 0, 8).most()),
      Interference::kBehindLand, 1e-5);
}

TEST(Interference, FollowsAShipThatSailsByHalfHerWay) {
  // Equal PRF: what is left is her distance, run through once and shown as if twice.
  const RadarModel model = model_at(12.0);
  for (std::uint64_t identity = 0;; ++identity) {
    Scene scene = with_emitter(0.0, model.pulse.prf_hz);
    scene.own_velocity = {0.0, 5.0};
    scene.emitters[0].identity = identity;
    scene.emitters[0].place = {300.0, 200.0};
    scene.emitters[0].velocity = {-15.0, -5.0};
    const auto dots = dots_of(model, hear(model, scene, 0, 16));
    if (dots.empty() || dots[0].from_m > 20e3) continue;  // its pulses fall outside the window
    const auto range_at = [](double t) { return std::hypot(300.0 - 15.0 * t, 200.0 - 10.0 * t); };
    const auto all = dots_of(model, hear_turn(model, scene));
    ASSERT_GT(all.size(), 2000u);
    for (const Heard& dot : all) {
      const double t = static_cast<double>(dot.spoke) * 2.5 / 4096.0;
      ASSERT_NEAR(dot.from_m - all[0].from_m, 0.5 * (range_at(t) - range_at(0.0)), 0.3) << t;
    }
    break;
  }
}

TEST(Interference, IsTheInstructorsToTakeAway) {
  Scene scene = with_emitter(2000.0, 20000.0);
  scene.artefacts.interference = false;
  EXPECT_EQ(coupling_at(scene, 0), 0.0f);
}

TEST(Interference, IsNotTouchedByTheTuneNorHeardInAnotherBand) {
  const Scene scene = with_emitter(2000.0, 20000.0);
  const RadarModel model = model_at(12.0);
  EXPECT_EQ(hear(model, scene, 0, 8, {}, 8, 0.001f).cells(),
            hear(model, scene, 0, 8, {}, 8).cells());
  EXPECT_EQ(hear(model_at(12.0, beacons::s_band_set()), scene, 0, 8).most(), 0.0f);
}

}  // namespace
}  // namespace skerry::echo
