#include "echo/beacons/pulse_train.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "echo/beacons/emitter_of.hpp"
#include "echo/radar/spoke_clock.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr std::int64_t kThirtyDays = 30ll * 86'400 * 1'000'000'000;  // nanoseconds

ScenarioTime at(std::int64_t nanoseconds) { return ScenarioTime{Duration(nanoseconds)}; }

TEST(PulseTrain, PeriodIsThatOfThePrf) {
  EXPECT_EQ(PulseTrain(1000.0, 1).period_ps(), 1'000'000'000);
  EXPECT_EQ(PulseTrain(3000.0, 1).period_ps(), 333'333'333);
  EXPECT_EQ(PulseTrain(600.0, 1).period_ps(), 1'666'666'667);
}

TEST(PulseTrain, CountsOverThirtyDaysWithoutTheLossOfAPicosecond) {
  for (const double prf : {600.0, 997.3, 1000.0, 3000.0, 20000.0}) {
    const PulseTrain train(prf, 42);
    const std::int64_t phase = train.wait_ps(at(0));
    EXPECT_GE(phase, 0);
    EXPECT_LT(phase, train.period_ps());
    for (std::int64_t t = 0; t <= kThirtyDays; t += 8'640'000'000'007) {
      const __int128 behind = static_cast<__int128>(t) * 1000 - phase;
      const auto into = static_cast<std::int64_t>((behind % train.period_ps() + train.period_ps()) %
                                                  train.period_ps());
      const std::int64_t expected = into == 0 ? 0 : train.period_ps() - into;
      ASSERT_EQ(train.wait_ps(at(t)), expected) << prf << " Hz after " << t << " ns";
    }
  }
}

TEST(PulseTrain, WorksBeforeTimeZero) {
  const PulseTrain train(1000.0, 3);
  EXPECT_EQ(train.wait_ps(at(-5'000'000)), train.wait_ps(at(0)));
}

TEST(PulseTrain, PhasesDifferByIdentity) {
  double sum = 0.0;
  for (std::uint64_t i = 0; i < 2000; ++i)
    sum += static_cast<double>(PulseTrain(1000.0, i).wait_ps(at(0))) * 1e-9;
  EXPECT_NEAR(sum / 2000.0, 0.5, 4.0 * std::sqrt(1.0 / 12.0 / 2000.0));
}

TEST(BeamUnits, TurnExactlyForThirtyDays) {
  EXPECT_EQ(beam_units(0.0, 24.0, at(0)), 0u);
  EXPECT_EQ(beam_units(0.0, 24.0, at(625'000'000)), 1u << 30);  // a quarter of 2.5 s
  EXPECT_EQ(beam_units(90.0, 24.0, at(625'000'000)), 1u << 31);
  // 30 days are 43 200 times rpm turns, and a quarter of a second more is a tenth of one.
  for (const double rpm : {20.0, 24.0, 26.5, 48.0}) {
    const std::uint32_t then = beam_units(10.0, rpm, at(250'000'000));
    EXPECT_EQ(beam_units(10.0, rpm, at(kThirtyDays + 250'000'000)), then) << rpm;
  }
}

TEST(EmitterOf, BeamIsThatOfTheRadarsOwnClock) {
  const RadarSet set;
  EmitterState state;
  state.bow_deg = 123.0;
  state.antenna_start = at(1'234'567'891);
  const Emitter emitter = emitter_of(set, set.pulses[2], state);
  const SpokeClock clock(set.rpm, 4096, state.antenna_start);
  for (const std::uint64_t spoke :
       {std::uint64_t{0}, std::uint64_t{1000}, std::uint64_t{4096ull * 1'036'800 + 77}}) {
    const std::uint32_t own =
        TrueBearing::from(degrees(state.bow_deg)).units() +
        RelativeBearing::of_spoke(static_cast<std::uint32_t>(spoke % 4096), 4096).units();
    const std::uint32_t beam = beam_units(emitter.bearing_deg, emitter.rpm, clock.time_of(spoke));
    EXPECT_NEAR(static_cast<std::int32_t>(beam - own) * (360.0 / 4294967296.0), 0.0, 1e-5);
  }
}

TEST(EmitterOf, IsTheSetOnTheAir) {
  const RadarSet set;
  EmitterState state;
  state.place = {5.0, 6.0};
  state.identity = 9;
  const Emitter same = emitter_of(set, set.pulses[1], state);
  EXPECT_EQ(same.prf_hz, set.pulses[1].prf_hz);
  EXPECT_EQ(same.pulse_s, set.pulses[1].length_s);
  EXPECT_EQ(same.frequency_hz, set.frequency_hz);
  EXPECT_EQ(same.power_w, set.peak_power_w);
  EXPECT_EQ(same.place, state.place);
  const Emitter other = emitter_of(set, set.pulses[1], state, {0.01, 20e6});
  EXPECT_NE(other.prf_hz, same.prf_hz);
  EXPECT_NEAR(other.prf_hz, same.prf_hz, 0.01 * same.prf_hz);
  EXPECT_NE(other.frequency_hz, same.frequency_hz);
  EXPECT_NEAR(other.frequency_hz, same.frequency_hz, 20e6);
}

}  // namespace
}  // namespace skerry::echo
