// The sections of a scenario beside ships: equipment, weather, small targets, beacons.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "echo/radar/set_checks.hpp"
#include "echo/radar/shipped_sets.hpp"
#include "server/config/config_error.hpp"
#include "server/config/field_value.hpp"
#include "server/world/radar_sets.hpp"
#include "server/world/scenario.hpp"
#include "tests/unit/world/refusal.hpp"

namespace skerry::server {
namespace {

// Line 4 holds the radar, line 5 begins what is added.
std::string with_radar(const std::string& keys) {
  return "name: s\nown_ships:\n  - name: Frida\n    radars: [{" + keys +
         "}]\n    position: {lat: 60, lon: 5}\n";
}
const std::string kShip = with_radar("");

scenario::Radar radar_of(const std::string& keys) {
  return parse_scenario(with_radar(keys), "f").own_ships(0).radars(0);
}

TEST(ScenarioEquipment, WithoutKeysIsTheFirstShippedSet) {
  const echo::RadarSet set = radar_set(radar_of(""));
  const echo::RadarSet& first = echo::shipped_sets().front();
  EXPECT_EQ(set.name, first.name);
  EXPECT_EQ(set.peak_power_w, first.peak_power_w);
  EXPECT_EQ(set.antenna_gain_db, first.antenna_gain_db);
  EXPECT_EQ(set.pulses, first.pulses);
}

TEST(ScenarioEquipment, EveryShippedSetCanBeNamed) {
  for (const echo::RadarSet& shipped : echo::shipped_sets()) {
    const echo::RadarSet set = radar_set(radar_of("set: " + shipped.name));
    EXPECT_EQ(set.name, shipped.name);
    EXPECT_EQ(set.frequency_hz, shipped.frequency_hz);
    EXPECT_EQ(set.pulses, shipped.pulses);
  }
}

TEST(ScenarioEquipment, EveryParameterCanBeOtherwise) {
  const echo::RadarSet set = radar_set(radar_of(
      "set: 30 kW S, frequency_ghz: 9.4, peak_power_kw: 10, antenna_gain_db: 29.5, beam_width_deg: "
      "2, vertical_beam_deg: 20, near_side_lobe_db: -25, far_side_lobe_db: -31, polarisation: vv, "
      "rpm: 42, antenna_height_m: 33, noise_figure_db: 4, losses_db: 2, pulses: [{length_us: 0.1, "
      "bandwidth_mhz: 15, prf_hz: 2000, up_to_nm: 3}, {length_us: 0.5, bandwidth_mhz: 4, prf_hz: "
      "700, up_to_nm: 96}]"));
  EXPECT_EQ(set.band(), echo::Band::x);
  EXPECT_DOUBLE_EQ(set.frequency_hz, 9.4e9);
  EXPECT_DOUBLE_EQ(set.peak_power_w, 1e4);
  EXPECT_EQ(set.antenna_gain_db, 29.5);
  EXPECT_EQ(set.beam_width_deg, 2.0);
  EXPECT_EQ(set.vertical_beam_deg, 20.0);
  EXPECT_EQ(set.near_side_lobe_db, -25.0);
  EXPECT_EQ(set.far_side_lobe_db, -31.0);
  EXPECT_EQ(set.polarisation, echo::Polarisation::vv);
  EXPECT_EQ(set.rpm, 42.0);
  EXPECT_EQ(set.antenna_height_m, 33.0);
  EXPECT_EQ(set.noise_figure_db, 4.0);
  EXPECT_EQ(set.losses_db, 2.0);
  ASSERT_EQ(set.pulses.size(), 2u);
  EXPECT_DOUBLE_EQ(set.pulses[1].length_s, 0.5e-6);
  EXPECT_DOUBLE_EQ(set.pulses[1].bandwidth_hz, 4e6);
  EXPECT_EQ(set.pulses[1].prf_hz, 700.0);
  EXPECT_EQ(set.pulses[1].up_to_nm, 96.0);
}

TEST(ScenarioEquipment, AnotherBeamHasAnotherGainUnlessThatIsGivenToo) {
  const double gain = radar_set(radar_of("")).antenna_gain_db;
  EXPECT_NEAR(radar_set(radar_of("beam_width_deg: 2.4")).antenna_gain_db, gain - 3.0103, 1e-3);
  EXPECT_NEAR(radar_set(radar_of("beam_width_deg: 0.3")).antenna_gain_db, gain + 6.0206, 1e-3);
  EXPECT_EQ(radar_set(radar_of("beam_width_deg: 2.4, antenna_gain_db: 28")).antenna_gain_db, 28.0);
}

TEST(ScenarioEquipment, WhatIsOutOfRangeIsRefusedByNameWithTheRange) {
  struct Case {
    std::string keys, error;
  };
  const std::vector<Case> cases = {
      {"set: 25 kW Y",
       "4:20: own_ships[0].radars[0].set: \"25 kW Y\" is no shipped set; allowed: "
       "25 kW X, "},
      {"peak_power_kw: 200",
       "4:30: own_ships[0].radars[0].peak_power_kw: 200 is out of range; allowed: 0.001 to 100 kW"},
      {"frequency_ghz: 5", "4:30: own_ships[0].radars[0].frequency_ghz: 5 GHz is in neither band"},
      {"antenna_gain_db: 40", "4:32: own_ships[0].radars[0].antenna_gain_db: 40 dB does not go"},
      {"polarisation: circular",
       "4:29: own_ships[0].radars[0].polarisation: expected one of hh, "
       "vv, given circular"},
      {"pulses: [{length_us: 1}]",
       "4:24: own_ships[0].radars[0].pulses[0].bandwidth_mhz: missing; "
       "expected a number, 0.1 to 400 MHz"},
      {"pulses: [{length_us: 9, bandwidth_mhz: 1, prf_hz: 500, up_to_nm: 96}]",
       "4:36: own_ships[0].radars[0].pulses[0].length_us: 9 is out of range; allowed: 0.02 to 5 "
       "us"},
      {"pulses: [{length_us: 1, bandwidth_mhz: 100, prf_hz: 500, up_to_nm: 96}]",
       "4:54: own_ships[0].radars[0].pulses[0].bandwidth_mhz: 1e+08 is outside"},
      {"pulses: [{length_us: 1, bandwidth_mhz: 3, prf_hz: 5000, up_to_nm: 96}]",
       "4:65: own_ships[0].radars[0].pulses[0].prf_hz: 5000 is outside"},
      {"gain: 101", "4:21: own_ships[0].radars[0].gain: 101 is out of range; allowed: 0 to 100"},
      {"range_filter: soft",
       "4:29: own_ships[0].radars[0].range_filter: expected one of sharp, two_poles, gaussian, "
       "given soft"},
      {"video_smoothing: 9",
       "4:32: own_ships[0].radars[0].video_smoothing: 9 is out of range; allowed: 1 to 8"},
      {"pulse: longer",
       "4:22: own_ships[0].radars[0].pulse: expected one of auto, short, medium, "
       "long, given longer"},
      {"obstructions: [{bearing_deg: 180, width_m: 40}]",
       "4:58: own_ships[0].radars[0].obstructions[0].width_m: 40 is out of range; allowed: 0.05 to "
       "30 m"},
      {"blanked_sectors: [{from_deg: 170}]",
       "4:33: own_ships[0].radars[0].blanked_sectors[0].to_deg: missing; expected a number, 0 to "
       "360 deg"},
  };
  for (const auto& [keys, error] : cases) {
    EXPECT_EQ(refusal(with_radar(keys)).substr(0, error.size()), error) << keys;
  }
  std::string many;
  for (int i = 0; i <= kMaxBlankedSectors; ++i) many += "{from_deg: 1, to_deg: 2},";
  EXPECT_EQ(refusal(with_radar("blanked_sectors: [" + many + "]")),
            "4:32: own_ships[0].radars[0].blanked_sectors: 9 entries; allowed: at most 8");
}

TEST(ScenarioEquipment, SaysHowASetsEchoesAndVideoAreFormed) {
  const auto loaded = [](const std::string& keys) { return radar_set(radar_of(keys)); };
  EXPECT_EQ(loaded("set: HALO20").video_smoothing, 4u);
  EXPECT_EQ(loaded("set: HALO20").range_filter, echo::RangeFilter::gaussian);
  EXPECT_EQ(loaded("range_filter: two_poles").range_filter, echo::RangeFilter::two_poles);
  EXPECT_EQ(loaded("set: HALO20, range_filter: sharp").range_filter, echo::RangeFilter::none);
  EXPECT_EQ(loaded("video_smoothing: 3").video_smoothing, 3u);
}

// The schema's ranges are those of the table of limits, but for the frequency, whose bands' outer
// ends the schema has, and the rotation, of which the server takes what the control of it does.
TEST(ScenarioEquipment, HasTheRangesOfTheTableOfLimits) {
  const auto* schema = scenario::Radar::descriptor();
  for (const echo::SetLimit& limit : echo::kSetLimits) {
    std::string key(limit.name);
    double unit = 1.0;
    if (key == "integration") key = "set_integration";  // the control has the other name
    if (key == "frequency_hz") key = "frequency_ghz", unit = 1e-9;
    if (key == "peak_power_w") key = "peak_power_kw", unit = 1e-3;
    const auto* field = schema->FindFieldByName(key);
    ASSERT_NE(field, nullptr) << key;
    const config::FieldRule& rule = rule_of(*field);
    const bool rotation = key == "rpm", frequency = key == "frequency_ghz";
    EXPECT_DOUBLE_EQ(rule.min(), rotation ? 10.0 : limit.min * unit) << key;
    EXPECT_DOUBLE_EQ(rule.max(), rotation ? 60.0 : frequency ? 9.55 : limit.max * unit) << key;
  }
}

TEST(ScenarioEquipment, IsTakenAtBothEndsOfItsRanges) {
  for (const char* keys : {"peak_power_kw: 0.001", "peak_power_kw: 100", "beam_width_deg: 0.3",
                           "beam_width_deg: 7.5", "vertical_beam_deg: 5", "vertical_beam_deg: 40",
                           "near_side_lobe_db: -15", "far_side_lobe_db: -80", "rpm: 10", "rpm: 60",
                           "antenna_height_m: 1", "antenna_height_m: 100", "noise_figure_db: 0",
                           "noise_figure_db: 20", "losses_db: 0", "losses_db: 20"}) {
    EXPECT_EQ(refusal(with_radar(keys)), "") << keys;
  }
}

TEST(ScenarioWeather, IsRefusedByNameWithTheRange) {
  struct Case {
    std::string text, error;
  };
  for (const auto& [text, error] : std::vector<Case>{
           {"sea: {state: 7}", "6:14: sea.state: 7 is out of range; allowed: 0 to 6"},
           {"sea: {wind_from_deg: -1}",
            "6:22: sea.wind_from_deg: -1 is out of range; allowed: 0 to 360 deg"},
           {"sea: {swell: {period_s: 1}}",
            "6:25: sea.swell.period_s: 1 is out of range; allowed: 4 to 25 s"},
           {"atmosphere: {ducting: 2}",
            "6:23: atmosphere.ducting: 2 is out of range; allowed: 0 to 1"},
           {"atmosphere: {k_factor: .nan}",
            "6:24: atmosphere.k_factor: .nan is not a finite number; allowed: 0.8 to 4"},
           {"rain: [{position: {lat: 60, lon: 5}, rate_mm_h: 1000}]",
            "6:49: rain[0].rate_mm_h: 1000 is out of range; allowed: 0.1 to 100 mm/h"},
           {"rain: [{position: {lat: 60, lon: 5}, kind: drizzle}]",
            "6:44: rain[0].kind: expected one of cell, even, shower, "
            "squall_line, given drizzle"},
           {"rain: [{position: {lat: 60, lon: 5}, radius_nm: -2}]",
            "6:49: rain[0].radius_nm: -2 is out of range; allowed: 0.1 to 50 NM"},
           {"rain: [{position: {lat: 60, lon: 5}, drift_kn: .nan}]",
            "6:48: rain[0].drift_kn: .nan is not a finite number; allowed: 0 to 60 kn"},
           {"rain: [{radius_nm: 1}]", "6:8: rain[0].position: missing; expected keys and values"},
           {"artefacts: {sidelobes: false}",
            "6:13: artefacts.sidelobes: unknown key; did you mean \"side_lobes\"?"},
       }) {
    EXPECT_EQ(refusal(kShip + text + "\n").substr(0, error.size()), error) << text;
  }
}

TEST(ScenarioTargets, HaveTheSizesOfTheirKind) {
  const scenario::Scenario scenario = parse_scenario(
      kShip +
          "targets:\n"
          "  - {name: a, kind: buoy, position: {lat: 60, lon: 5}}\n"
          "  - {name: b, kind: reflector_buoy, position: {lat: 60, lon: 5}, x_band_m2: 20}\n"
          "  - {name: c, kind: small_craft, position: {lat: 60, lon: 5}, height_m: 3, speed_kn: "
          "4}\n"
          "  - {name: d, kind: channel_marker, position: {lat: 60, lon: 5}, fluctuation: steady}\n",
      "f");
  EXPECT_EQ(scenario.targets(0).height_m(), 3.5);
  EXPECT_EQ(scenario.targets(0).x_band_m2(), 5.0);
  EXPECT_EQ(scenario.targets(0).s_band_m2(), 0.5);
  EXPECT_EQ(scenario.targets(1).x_band_m2(), 20.0);
  EXPECT_EQ(scenario.targets(1).s_band_m2(), 1.0);
  EXPECT_EQ(scenario.targets(2).height_m(), 3.0);
  EXPECT_EQ(scenario.targets(2).x_band_m2(), 2.5);
  EXPECT_EQ(scenario.targets(3).fluctuation(), scenario::Target::steady);
}

TEST(ScenarioTargets, HaveOnlyKeysOfTheirKind) {
  const auto target = [](const std::string& keys) {
    return refusal(kShip + "targets: [{name: t, position: {lat: 60, lon: 5}, " + keys + "}]\n");
  };
  EXPECT_EQ(target("kind: buoy, length_m: 5"),
            "6:72: targets[0].length_m: given for kind buoy; allowed: for ships");
  EXPECT_EQ(target("x_band_m2: 5"),
            "6:61: targets[0].x_band_m2: given for kind ship; allowed: for buoys, craft, markers "
            "and reflectors");
  EXPECT_EQ(target("kind: buoy, ship_type: tanker"),
            "6:73: targets[0].ship_type: given for kind buoy; allowed: for ships and craft");
  EXPECT_EQ(
      target("kind: small_craft, aid_type: light"),
      "6:79: targets[0].aid_type: given for kind small_craft; allowed: for buoys and markers");
  EXPECT_EQ(target("kind: channel_marker, aid_type: port_hand_beacon"), "");
  EXPECT_EQ(target("kind: reflector, speed_kn: 3"),
            "6:77: targets[0].speed_kn: 3 kn for a reflector; allowed: 0, it stands still");
  const std::string no_set = "6:57: targets[0].radar: \"none\" is no shipped set; allowed: ";
  EXPECT_EQ(target("radar: none").substr(0, no_set.size()), no_set);
  EXPECT_EQ(target("radar: 30 kW S, wake: true, sart: true, cross_section_m2: 900"), "");
}

TEST(ScenarioBeacons, AreRefusedByNameWithWhatIsAllowed) {
  const auto racon = [](const std::string& keys) {
    return refusal(kShip + "racons: [{position: {lat: 60, lon: 5}, " + keys + "}]\n");
  };
  EXPECT_EQ(racon("code: K"), "");
  EXPECT_EQ(racon("code: k"),
            "6:46: racons[0].code: \"k\" is no Morse code; allowed: 1 to 4 letters A to Z");
  EXPECT_EQ(racon("code: ABCDE"),
            "6:46: racons[0].code: \"ABCDE\" has 5 characters; allowed: at most 4 letters A to Z");
  EXPECT_EQ(racon("code: K, on_s: 90"),
            "6:55: racons[0].on_s: on for 90 s of every 60 s; allowed: at most the period");
  EXPECT_EQ(racon("code: K, x_band: false, s_band: false"),
            "6:72: racons[0].s_band: no band is left; allowed: at least one of x_band and s_band "
            "true");
  EXPECT_EQ(refusal(kShip + "sarts: [{position: {lat: 60, lon: 5}, speed_kn: 20}]\n"),
            "6:49: sarts[0].speed_kn: 20 is out of range; allowed: 0 to 10 kn");
  EXPECT_EQ(refusal(kShip + "cables: [{from: {lat: 60, lon: 5}, to: {lat: 61, lon: 5}}]\n"),
            "6:40: cables[0].to: the cable is 111421 m long; allowed: 1 to 20000 m");
  EXPECT_EQ(refusal(kShip + "wind_turbines: [{position: {lat: 60, lon: 5}, rotor_rpm: 99}]\n"),
            "6:58: wind_turbines[0].rotor_rpm: 99 is out of range; allowed: 0 to 60 turns/min");
}

TEST(ScenarioCounts, OfEverySectionAreBounded) {
  const auto many = [](const std::string& key, const std::string& entry, int count) {
    std::string text = kShip + key + ":\n";
    for (int i = 0; i < count; ++i) text += "  - {" + entry + "}\n";
    return refusal(text);
  };
  const std::string place = "position: {lat: 60, lon: 5}";
  EXPECT_EQ(many("rain", place, kMaxRainCells + 1), "7:3: rain: 65 entries; allowed: at most 64");
  EXPECT_EQ(many("racons", place + ", code: K", kMaxRacons + 1),
            "7:3: racons: 201 entries; allowed: at most 200");
  EXPECT_EQ(many("sarts", place, kMaxSarts + 1), "7:3: sarts: 65 entries; allowed: at most 64");
  EXPECT_EQ(many("wind_turbines", place, kMaxWindTurbines + 1),
            "7:3: wind_turbines: 1001 entries; allowed: at most 1000");
  EXPECT_EQ(many("targets", "name: b, kind: buoy, " + place, kMaxSmallTargets + 1),
            "7:3: targets: 4001 entries that are not ships; allowed: at most 4000");
  EXPECT_EQ(many("targets", "name: b, kind: buoy, " + place, kMaxSmallTargets), "");
  EXPECT_EQ(many("targets", "name: t, radar: 25 kW X, " + place, kMaxEmitters + 1),
            "7:3: targets: 65 ships with a radar; allowed: at most 64");
}

TEST(ScenarioIdentities, HaveNineDigitsAndAreNoOneElses) {
  EXPECT_EQ(refusal(kShip + "targets:\n  - {name: t, position: {lat: 60, lon: 5}, mmsi: 99}\n"),
            "7:50: targets[0].mmsi: 99 is out of range; allowed: 100000000 to 999999999 nine "
            "digits");
  EXPECT_EQ(
      refusal(kShip + "targets:\n  - {name: t, position: {lat: 60, lon: 5}, mmsi: 257000009}\n"
                      "racons:\n  - {position: {lat: 60, lon: 5}, code: A, mmsi: 257000009}\n"),
      "9:50: racons[0].mmsi: 257000009 is that of targets[0].mmsi too (line 7); numbers must "
      "differ");
}

TEST(ScenarioEquipment, StartsWithTheControlsThatDisplaysHave) {
  const scenario::Radar radar = radar_of(
      "gain_auto: true, side_lobe_suppression: 10, noise_rejection: 20, target_separation: 30, "
      "target_boost: 40, doppler: both, doppler_threshold_mps: 1.5, mode: harbour, "
      "bearing_alignment_deg: -3, locked: [gain, world]");
  EXPECT_TRUE(radar.controls().gain_auto());
  EXPECT_EQ(radar.controls().doppler(), wire::DOPPLER_BOTH);
  EXPECT_EQ(radar.controls().mode(), wire::HARBOUR);
  EXPECT_EQ(radar.locked_size(), 2);
  EXPECT_EQ(radar_of("").controls().doppler_threshold_mps(), 2.0);
  EXPECT_NE(refusal(with_radar("target_boost: 101")), "");
  EXPECT_NE(refusal(with_radar("doppler_threshold_mps: 0")), "");
}

}  // namespace
}  // namespace skerry::server
