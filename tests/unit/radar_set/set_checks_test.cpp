#include "echo/radar/set_checks.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "echo/radar/shipped_sets.hpp"

namespace skerry::echo {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

TEST(SetChecks, EveryShippedSetIsSound) {
  for (const RadarSet& set : shipped_sets()) EXPECT_THAT(faults_of(set), IsEmpty()) << set.name;
}

struct Wrong {
  std::string name;     // how the fault begins
  std::string allowed;  // what it must say
  std::function<void(RadarSet&)> make;
};

TEST(SetChecks, NameWhatIsWrongAndWhatIsAllowed) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<Wrong> wrongs = {
      {"frequency_hz: 9.1 GHz", "2.85 to 3.15 GHz, X 9.15 to 9.55",
       [](RadarSet& s) { s.frequency_hz = 9.1e9; }},
      {"frequency_hz: 5.6", "", [](RadarSet& s) { s.frequency_hz = 5.6e9; }},
      {"frequency_hz: nan", "", [=](RadarSet& s) { s.frequency_hz = nan; }},
      {"peak_power_w: 0 ", "1 to 100000 W", [](RadarSet& s) { s.peak_power_w = 0.0; }},
      {"peak_power_w: inf", "", [=](RadarSet& s) { s.peak_power_w = infinite; }},
      {"near_side_lobe_db: -3 ", "-60 to -15", [](RadarSet& s) { s.near_side_lobe_db = -3.0; }},
      {"far_side_lobe_db: -20 dB is above", "-28", [](RadarSet& s) { s.far_side_lobe_db = -20; }},
      {"rpm: 0.5 ", "1 to 240", [](RadarSet& s) { s.rpm = 0.5; }},
      {"rpm: 241 ", "1 to 240", [](RadarSet& s) { s.rpm = 241; }},
      {"antenna_height_m: 0 ", "1 to 100", [](RadarSet& s) { s.antenna_height_m = 0.0; }},
      {"noise_figure_db: -1 ", "0 to 20", [](RadarSet& s) { s.noise_figure_db = -1.0; }},
      {"losses_db: 21 ", "0 to 20", [](RadarSet& s) { s.losses_db = 21.0; }},
      {"antenna_gain_db: 26 dB does not go", "26.9 to 32.9",
       [](RadarSet& s) { s.antenna_gain_db = 26.0; }},
      {"antenna_gain_db: 33.5 dB does not go", "26.9 to 32.9",
       [](RadarSet& s) { s.antenna_gain_db = 33.5; }},
      {"beam_width_deg: 0.2 ", "0.3 to 7.5", [](RadarSet& s) { s.beam_width_deg = 0.2; }},
      {"vertical_beam_deg: nan", "5 to 40", [=](RadarSet& s) { s.vertical_beam_deg = nan; }},
      {"pulses: 0 ", "1 to 16", [](RadarSet& s) { s.pulses.clear(); }},
      {"pulses[1].length_s: 5e-08 s is not longer", "8e-08",
       [](RadarSet& s) {
         s.pulses[1].length_s = 0.05e-6;
         s.pulses[1].bandwidth_hz = 20e6;
       }},
      {"pulses[2].up_to_nm: 3 NM is not beyond", "",
       [](RadarSet& s) { s.pulses[2].up_to_nm = 3.0; }},
      {"pulses[3].bandwidth_hz: 1e+07 ", "500000 to 8e+06",
       [](RadarSet& s) { s.pulses[3].bandwidth_hz = 10e6; }},
      {"pulses[0].prf_hz: nan", "100 to 20000", [=](RadarSet& s) { s.pulses[0].prf_hz = nan; }},
      {"pulses[3].prf_hz: 900 ", "up_to_nm", [](RadarSet& s) { s.pulses[3].prf_hz = 900.0; }},
  };
  for (const Wrong& wrong : wrongs) {
    RadarSet set;
    wrong.make(set);
    EXPECT_THAT(faults_of(set),
                ElementsAre(::testing::AllOf(StartsWith(wrong.name), HasSubstr(wrong.allowed))));
  }
}

TEST(SetChecks, ADutyOfMoreThanAHundredthIsRefused) {
  RadarSet set;
  set.pulses = {{4e-6, 0.5e6, 3000.0, 24.0}};
  EXPECT_THAT(faults_of(set), ElementsAre(::testing::AllOf(StartsWith("pulses[0].prf_hz: 3000 "),
                                                           HasSubstr("0 to 2500 "))));
}

TEST(SetChecks, ListEverythingAtOnce) {
  RadarSet set;
  set.rpm = 0.0;
  set.losses_db = -1.0;
  set.pulses.resize(17, set.pulses.back());
  const auto faults = faults_of(set);
  EXPECT_THAT(faults, ::testing::Contains(StartsWith("rpm")));
  EXPECT_THAT(faults, ::testing::Contains(StartsWith("losses_db")));
  EXPECT_THAT(faults, ::testing::Contains(StartsWith("pulses: 17")));
}

TEST(ShippedSets, TheFirstIsTheDefault) {
  const RadarSet set = find_set("25 kW X");
  EXPECT_EQ(set.name, RadarSet{}.name);
  EXPECT_EQ(shipped_sets().front().name, set.name);
  EXPECT_EQ(set.pulses, RadarSet{}.pulses);
}

TEST(ShippedSets, CoverBothBandsAndTheRecordedSets) {
  EXPECT_EQ(find_set("30 kW S").band(), Band::s);
  for (const char* name : {"river X", "broadband dome", "HALO20", "4G", "3G", "BR24", "Quantum 2"})
    EXPECT_EQ(find_set(name).band(), Band::x) << name;
}

TEST(ShippedSets, AnUnknownNameListsTheNames) {
  try {
    find_set("25kW");
    FAIL() << "found";
  } catch (const std::invalid_argument& error) {
    EXPECT_THAT(error.what(), HasSubstr("\"25kW\""));
    for (const RadarSet& set : shipped_sets()) EXPECT_THAT(error.what(), HasSubstr(set.name));
  }
}

}  // namespace
}  // namespace skerry::echo
