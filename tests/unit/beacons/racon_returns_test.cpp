#include "echo/beacons/racon_returns.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/radar/radar_equation.hpp"
#include "tests/unit/beacons/beacon_scene.hpp"

namespace skerry::echo {
namespace {

using beacons::at;
using beacons::hear;
using beacons::hear_turn;
using beacons::kNauticalMile;
using beacons::model_at;
using beacons::Picture;
using beacons::propagation_of;
using beacons::s_band_set;
using beacons::spoke_at;

Scene with_racon(double bearing_deg, double range_m, const char* code = "K") {
  Scene scene;
  Racon racon;
  racon.place = at(bearing_deg, range_m);
  racon.code = code;
  racon.on_s = racon.period_s;  // always
  scene.racons = {racon};
  return scene;
}

TEST(RaconReturns, BeginBehindTheMarkByTheDelayAndAreAsLongAsTheReply) {
  // 0.7 us are 104.9 m, 25 us 2.023 NM (SOURCES.md "Vectors"); "T" is one dash.
  const RadarModel model = model_at(6.0);
  const Scene scene = with_racon(90.0, 5000.0, "T");
  const Picture picture = hear_turn(model, scene);
  const auto dash = picture.stretches(spoke_at(model, 90.0), 0.5f * picture.most());
  ASSERT_EQ(dash.size(), 1u);
  EXPECT_NEAR(dash[0].from_m, 5000.0 + 104.9, model.cell_m);
  EXPECT_NEAR(dash[0].to_m - dash[0].from_m, 2.023 * kNauticalMile, model.cell_m);
  // To the vectors' digits, from the constants themselves.
  EXPECT_NEAR(0.5 * kLightSpeed * scene.racons[0].delay_s, 104.9, 0.05);
  EXPECT_NEAR(0.5 * kLightSpeed * scene.racons[0].length_s / kNauticalMile, 2.023, 0.0005);
}

TEST(RaconReturns, WriteTheirCodeOutwards) {
  const RadarModel model = model_at(6.0);
  const Picture picture = hear_turn(model, with_racon(30.0, 4000.0, "D"));
  const auto marks = picture.stretches(spoke_at(model, 30.0), 0.5f * picture.most());
  ASSERT_EQ(marks.size(), 3u);  // -.. is 7 dots long
  const double dot = 0.5 * kLightSpeed * 25e-6 / 7.0;
  const double begin = 4000.0 + 104.9;
  const double expected[3][2] = {{0, 3}, {4, 5}, {6, 7}};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(marks[i].from_m, begin + expected[i][0] * dot, model.cell_m);
    EXPECT_NEAR(marks[i].to_m, begin + expected[i][1] * dot, model.cell_m);
  }
}

TEST(RaconReturns, AreNotLengthenedByTheRadarsPulse) {
  const RadarSet set;
  const auto length = [&](PulseChoice choice) {
    const RadarModel model =
        radar_model(set, {}, *RangeScale::find(6.0), SpokeClock(24.0, 4096), 0, choice);
    const Picture picture = hear_turn(model, with_racon(0.0, 3000.0, "T"));
    const auto dash = picture.stretches(0, 0.5f * picture.most());
    return dash.at(0).to_m - dash.at(0).from_m;
  };
  EXPECT_EQ(length(PulseChoice::short_pulse), length(PulseChoice::long_pulse));
}

// Strongest power of a racon at that range, propagation taken off again.
double strength(double range_m) {
  const RadarModel model = model_at(24.0);
  const Scene scene = with_racon(0.0, range_m);
  const double way =
      static_cast<double>(propagation_of(model, scene).one_way(range_m, scene.racons[0].height_m));
  return static_cast<double>(hear(model, scene, 0, 16).most()) / way;
}

TEST(RaconReturns, FallAsTheSquareOfTheRange) {
  for (const double range : {1500.0, 4000.0, 8000.0, 12000.0}) {
    const double slope = std::log(strength(2.0 * range) / strength(range)) / std::log(2.0);
    EXPECT_NEAR(slope, -2.0, 0.01) << range;
  }
}

TEST(RaconReturns, HaveThePowerOfTheLink) {
  // 1 W and 6 dB, 31 dB less 1.5 dB of losses, Friis, over kTBF.
  const RadarModel model = model_at(24.0);
  const double expected = 10.0 * std::log10(1.0) + 6.0 + 29.5 -
                          20.0 * std::log10(4.0 * M_PI * 10000.0 / model.set.wavelength_m()) -
                          10.0 * std::log10(noise_watts(model.set, model.pulse));
  EXPECT_NEAR(10.0 * std::log10(strength(10000.0)), expected, 0.01);
}

TEST(RaconReturns, AreAsWideAsTheBeamOnce) {
  const RadarModel model = model_at(6.0);
  const Picture picture = hear_turn(model, with_racon(90.0, 5000.0));
  // Half power, one way: the beam width.  An echo's would be narrower by sqrt(2).
  const double width = static_cast<double>(picture.bright_spokes(0.5f * picture.most())) * 360.0 /
                       model.geometry.spokes_per_turn;
  EXPECT_NEAR(width, model.set.beam_width_deg, 0.15);
}

TEST(RaconReturns, AnswerThePulsesOfTheirBandsAlone) {
  for (const bool x_band : {true, false}) {
    Scene scene = with_racon(0.0, 3000.0);
    scene.racons[0].x_band = x_band;
    scene.racons[0].s_band = !x_band;
    EXPECT_EQ(hear(model_at(6.0), scene, 0, 16).most() > 0.0f, x_band);
    EXPECT_EQ(hear(model_at(6.0, s_band_set()), scene, 0, 16).most() > 0.0f, !x_band);
  }
}

TEST(RaconReturns, AnswerShipsInTheirSectorAlone) {
  // The racon lies north of the ship: she is seen from it to the south.
  Scene scene = with_racon(0.0, 3000.0);
  const auto heard = [&](double from, double to) {
    scene.racons[0].sector_from_deg = from;
    scene.racons[0].sector_to_deg = to;
    return hear(model_at(6.0), scene, 0, 16).most() > 0.0f;
  };
  EXPECT_TRUE(heard(0.0, 0.0));
  EXPECT_TRUE(heard(170.0, 190.0));
  EXPECT_FALSE(heard(190.0, 170.0));
  EXPECT_TRUE(heard(90.0, 181.0));
  EXPECT_FALSE(heard(181.0, 90.0));
  EXPECT_FALSE(heard(350.0, 10.0));
  scene.racons[0].place = at(180.0, 3000.0);  // now she is to the north of it
  scene.racons[0].sector_from_deg = 350.0, scene.racons[0].sector_to_deg = 10.0;
  EXPECT_GT(hear(model_at(6.0), scene, 2040, 16).most(), 0.0f);
}

TEST(RaconReturns, AreSilentForTheRestOfTheirPeriod) {
  Racon racon;  // 20 s of 60
  int on = 0, changes = 0;
  bool before = RaconReturns::on_duty(racon, ScenarioTime{});
  for (int second = 0; second < 600; ++second) {
    const bool now = RaconReturns::on_duty(racon, ScenarioTime{std::chrono::seconds(second)});
    on += now, changes += now != before;
    before = now;
  }
  EXPECT_NEAR(on, 200, 1);
  EXPECT_NEAR(changes, 20, 1);
}

TEST(RaconReturns, KeepTheirDutyToTheNanosecondAfterThirtyDays) {
  Racon racon;
  racon.identity = 5;
  const std::int64_t period = 60'000'000'000, days30 = 43'200 * period;
  for (std::int64_t t = 0; t < period; t += 999'999'937) {
    const ScenarioTime now{Duration(t)}, later{Duration(t + days30)};
    EXPECT_EQ(RaconReturns::on_duty(racon, now), RaconReturns::on_duty(racon, later));
  }
  // The instant at which it falls silent is the same to a nanosecond.
  const auto end_after = [&](std::int64_t from) {
    std::int64_t on = from, off = from;
    while (!RaconReturns::on_duty(racon, ScenarioTime{Duration(on)})) on += 1'000'000'000;
    off = on;
    while (RaconReturns::on_duty(racon, ScenarioTime{Duration(off)})) off += 1'000'000'000;
    on = off - 1'000'000'000;
    while (off - on > 1) {
      const std::int64_t middle = (on + off) / 2;
      (RaconReturns::on_duty(racon, ScenarioTime{Duration(middle)}) ? on : off) = middle;
    }
    return off;
  };
  EXPECT_EQ(end_after(days30) - end_after(0), days30);
}

TEST(RaconReturns, DifferInPhaseByIdentity) {
  int on = 0;
  for (std::uint64_t identity = 0; identity < 3000; ++identity) {
    Racon racon;
    racon.identity = identity;
    on += RaconReturns::on_duty(racon, ScenarioTime{});
  }
  EXPECT_NEAR(on, 1000, 3.0 * std::sqrt(3000.0 * 2.0 / 9.0));
}

TEST(RaconReturns, AreNotTriggeredBelowTheirThreshold) {
  Scene scene = with_racon(0.0, 8000.0);
  const RadarModel model = model_at(12.0);
  const OneWayLink link(model);
  const double way = static_cast<double>(propagation_of(model, scene).one_way(8000.0, 10.0));
  const double at_receiver =
      10.0 * std::log10(1e3 * link.sent_watts(8000.0) * way) + scene.racons[0].antenna_gain_db;
  scene.racons[0].threshold_dbm = at_receiver - 0.1;
  EXPECT_GT(hear(model, scene, 0, 16).most(), 0.0f);
  scene.racons[0].threshold_dbm = at_receiver + 0.1;
  EXPECT_EQ(hear(model, scene, 0, 16).most(), 0.0f);
}

TEST(RaconReturns, NearAtHandMakeArcsAndRingsUnlessSuppressed) {
  const RadarModel model = model_at(3.0);
  const auto bright = [&](double range_m, bool suppressed) {
    Scene scene = with_racon(90.0, range_m);
    scene.racons[0].side_lobe_suppression = suppressed;
    return hear_turn(model, scene).bright_spokes(1.0f);
  };
  const std::size_t turn = model.geometry.spokes_per_turn;
  EXPECT_LT(bright(150.0, true), turn / 50);
  const std::size_t ring = bright(150.0, false);
  EXPECT_GT(ring, turn / 2);
  const std::size_t arc = bright(1500.0, false);
  EXPECT_GT(arc, bright(1500.0, true));
  EXPECT_LT(arc, ring);
}

TEST(RaconReturns, BehindLandOrFarBelowTheHorizonAreNotSeen) {
  const Scene scene = with_racon(0.0, 5000.0);
  const auto hill = [](double height) {
    return [height](std::uint32_t, double range) {
      return range > 3000.0 ? static_cast<float>(height) : 0.0f;
    };
  };
  EXPECT_GT(hear(model_at(6.0), scene, 0, 16, hill(9.0)).most(), 0.0f);
  EXPECT_EQ(hear(model_at(6.0), scene, 0, 16, hill(11.0)).most(), 0.0f);
  EXPECT_EQ(hear(model_at(96.0), with_racon(0.0, 120e3), 0, 16).most(), 0.0f);
}

TEST(RaconReturns, AreLostWithTheTune) {
  const Scene scene = with_racon(0.0, 5000.0);
  const RadarModel model = model_at(6.0);
  EXPECT_NEAR(static_cast<double>(hear(model, scene, 0, 16, {}, 16, 0.01f).most() /
                                  hear(model, scene, 0, 16).most()),
              0.01, 1e-5);
}

}  // namespace
}  // namespace skerry::echo
