// The part of the world that a radar's scene holds, and the part it leaves out.
#include "server/radar/scene_builder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "server/world/scenario.hpp"
#include "server/world/world.hpp"
#include "tests/unit/radar/open_sea.hpp"

namespace skerry::server {
namespace {

// An own ship at 60 N 5 E, on an open sea seen out to 6 NM.
class Scenes : public testing::Test {
 protected:
  echo::ScenePtr scene(const std::string& more, SceneRole role = {}) {
    const scenario::Scenario scenario = parse_scenario(
        "name: s\nseed: 3\nown_ships:\n"
        "  - {name: F, position: {lat: 60, lon: 5}, length_m: 90, beam_m: 15, radars: [{}],\n"
        "     motion: {roll_deg: 12, pitch_deg: 3}}\n"
        "  - {name: Y, position: {lat: 60.02, lon: 5}, radars: [{}]}\n" +
            more + "\n",
        "f");
    const auto state = std::make_shared<const WorldState>(World(scenario).state());
    const GeoPoint own = state->own_ships[0].position;
    CoastService coasts(std::make_unique<OpenSea>(), 1, {});
    coasts.prepare_now(0, {own, 0.0, {6.0 * 1852.0, 20.0, 0.1}});
    role.seed = 3;
    return SceneBuilder(role).build(state, coasts.latest(0), airwaves_.get());
  }
  static double north_of(const echo::Scene& scene, PlanePoint place) {
    return (place - scene.own_ship).north_m;
  }

  Airwaves airwaves_{2};
};

TEST_F(Scenes, OfAScenarioWithoutWeatherAndTargetsHoldNone) {
  const auto made = scene("");
  EXPECT_EQ(made->sea.state, 0.0);
  EXPECT_TRUE(made->rain.empty());
  EXPECT_TRUE(made->points.empty());
  EXPECT_TRUE(made->racons.empty());
  EXPECT_TRUE(made->emitters.empty());
  EXPECT_EQ(made->motion.roll_deg, 0.0) << "a calm";
  EXPECT_EQ(made->hulls.size(), 1u) << "the other own ship";
  EXPECT_EQ(made->own_hull.length_m, 90.0);
}

TEST_F(Scenes, HoldEveryKindOfThingWithinReachAndNoneBeyond) {
  const auto made = scene(
      "targets:\n"
      "  - {name: a, kind: buoy, position: {lat: 60.01, lon: 5}}\n"
      "  - {name: b, kind: small_craft, position: {lat: 60.03, lon: 5}, speed_kn: 6}\n"
      "  - {name: far, kind: buoy, position: {lat: 60.5, lon: 5}}\n"
      "  - {name: raft, position: {lat: 60.04, lon: 5}, sart: true, wake: true, "
      "cross_section_m2: 50}\n"
      "sarts: [{position: {lat: 60.05, lon: 5}}]\n"
      "rain: [{position: {lat: 60.1, lon: 5}, radius_nm: 1, kind: shower}, "
      "{position: {lat: 62, lon: 5}}]\n"
      "wind_turbines: [{position: {lat: 60.02, lon: 5}}]\n"
      "cables: [{from: {lat: 60.01, lon: 4.95}, to: {lat: 60.01, lon: 5.05}}]\n"
      "racons: [{position: {lat: 60.01, lon: 5}, code: BK, sector_from_deg: 90, sector_to_deg: "
      "270}]\n");
  ASSERT_EQ(made->points.size(), 2u);
  EXPECT_NEAR(north_of(*made, made->points[0].place), 1114.2, 1.0);
  EXPECT_EQ(made->points[0].x_band_m2, 5.0);
  EXPECT_NEAR(made->points[1].velocity.north_m, 6.0 * 1852.0 / 3600.0, 1e-6);
  EXPECT_NE(made->points[0].identity, made->points[1].identity);
  ASSERT_EQ(made->hulls.size(), 2u);
  EXPECT_TRUE(made->hulls[0].wake);
  EXPECT_EQ(made->hulls[0].cross_section_m2, 50.0);
  EXPECT_EQ(made->sarts.size(), 2u);
  ASSERT_EQ(made->rain.size(), 1u);
  EXPECT_EQ(made->rain[0].radius_m, 1852.0);
  EXPECT_EQ(made->rain[0].kind, echo::RainKind::shower);
  EXPECT_EQ(made->turbines.size(), 1u);
  EXPECT_EQ(made->cables.size(), 1u);
  ASSERT_EQ(made->racons.size(), 1u);
  EXPECT_EQ(made->racons[0].code, "BK");
  EXPECT_NEAR(made->racons[0].sector_to_deg - made->racons[0].sector_from_deg, 180.0, 1e-9);
}

TEST_F(Scenes, DuctingBringsInWhatMayComeASecondTime) {
  const std::string far = "targets: [{name: far, kind: buoy, position: {lat: 61, lon: 5}}]\n";
  EXPECT_EQ(scene(far)->points.size(), 0u);
  EXPECT_EQ(scene(far + "atmosphere: {ducting: 0.5}")->points.size(), 1u);
  EXPECT_EQ(
      scene(far + "atmosphere: {ducting: 0.5}\nartefacts: {second_trace: false}")->points.size(),
      0u);
  // 167 km: no second trace is followed that far, but a radar there is heard, one way.
  const std::string duct = "atmosphere: {ducting: 0.5}\n";
  const std::string farther = "targets: [{name: farther, position: {lat: 61.5, lon: 5}, ";
  EXPECT_EQ(scene(farther + "kind: buoy}]\n" + duct)->points.size(), 0u);
  EXPECT_EQ(scene(farther + "radar: 25 kW X}]\n" + duct)->emitters.size(), 1u);
  EXPECT_EQ(scene(farther + "radar: 25 kW X}]\n")->emitters.size(), 0u);
}

TEST_F(Scenes, TheAntennaRollsInProportionToTheSea) {
  EXPECT_NEAR(scene("sea: {state: 3}")->motion.roll_deg, 6.0, 1e-12);
  EXPECT_NEAR(scene("sea: {state: 6}")->motion.pitch_deg, 3.0, 1e-12);
}

TEST_F(Scenes, OtherRadarsOfTheBandAreHeardWhileTheyTransmit) {
  const echo::RadarSet x;
  Emission other;
  other.own_ship = 1;
  other.transmits = true;
  echo::EmitterState state;
  state.identity = 9;
  other.emitter = echo::emitter_of(x, x.pulses[1], state, kTransmitterSpread);
  airwaves_.set(1, other);
  const auto made = scene("targets: [{name: t, position: {lat: 60.1, lon: 5}, radar: 25 kW X}]");
  ASSERT_EQ(made->emitters.size(), 2u);
  EXPECT_EQ(made->emitters[0].pulse_s, x.pulses[1].length_s);
  EXPECT_NEAR(north_of(*made, made->emitters[0].place), 2228.4, 2.0);
  EXPECT_NE(made->emitters[0].identity, made->emitters[1].identity);
  SceneRole s_band;
  s_band.band = echo::Band::s;
  EXPECT_TRUE(scene("", s_band)->emitters.empty());
  SceneRole aboard;
  aboard.own_ship = 1;
  EXPECT_TRUE(scene("", aboard)->emitters.empty()) << "its own, or one of the same ship";
  other.transmits = false;
  airwaves_.set(1, other);
  EXPECT_TRUE(scene("")->emitters.empty());
}

TEST(Airwaves, NoTwoSetsOfOneMakeHaveTheSamePulseRate) {
  const echo::RadarSet set;
  double last = 0.0;
  for (std::uint64_t identity = 0; identity < 50; ++identity) {
    echo::EmitterState state;
    state.identity = identity;
    const double prf = echo::emitter_of(set, set.pulses[2], state, kTransmitterSpread).prf_hz;
    EXPECT_NE(prf, last);
    EXPECT_NEAR(prf, set.pulses[2].prf_hz, kTransmitterSpread.prf * set.pulses[2].prf_hz);
    last = prf;
  }
}

}  // namespace
}  // namespace skerry::server
