#include "echo/beacons/beacon_faults.hpp"

#include <gmock/gmock.h>

#include <cmath>

namespace skerry::echo {
namespace {

using ::testing::HasSubstr;

TEST(BeaconFaults, DefaultsPass) {
  EXPECT_EQ(fault_of(Racon{}), std::nullopt);
  EXPECT_EQ(fault_of(Sart{}), std::nullopt);
  EXPECT_EQ(fault_of(Emitter{}), std::nullopt);
}

TEST(BeaconFaults, ARaconsCodeIsOneToFourLetters) {
  Racon racon;
  for (const char* code : {"", "ABCDE", "r", "R2"}) {
    racon.code = code;
    EXPECT_THAT(fault_of(racon).value_or(""), HasSubstr("code must be 1 to 4 letters A to Z"));
  }
}

TEST(BeaconFaults, NameWhatIsOutOfItsRangeAndTheRange) {
  Racon racon;
  racon.delay_s = 11e-6;
  EXPECT_EQ(fault_of(racon), "delay_s must be 0 to 1e-05, is 1.1e-05");
  racon = {};
  racon.on_s = 61.0;  // of a period of 60
  EXPECT_EQ(fault_of(racon), "on_s must be 0 to 60, is 61");
  Emitter emitter;
  emitter.prf_hz = 0.0;
  EXPECT_EQ(fault_of(emitter), "prf_hz must be 100 to 20000, is 0");
  Sart sart;
  sart.height_m = -1.0;
  EXPECT_EQ(fault_of(sart), "height_m must be 0 to 100, is -1");
}

template <typename Beacon, typename Member>
void expect_checked(Member Beacon::*member, const char* name) {
  for (const double wrong : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    Beacon beacon;
    beacon.*member = wrong;
    EXPECT_THAT(fault_of(beacon).value_or("none"), HasSubstr(name)) << wrong;
  }
}

TEST(BeaconFaults, NoNumberIsInNoRange) {
  expect_checked(&Racon::height_m, "height_m");
  expect_checked(&Racon::length_s, "length_s");
  expect_checked(&Racon::period_s, "period_s");
  expect_checked(&Racon::sector_from_deg, "sector_from_deg");
  expect_checked(&Racon::sector_to_deg, "sector_to_deg");
  expect_checked(&Racon::power_w, "power_w");
  expect_checked(&Racon::antenna_gain_db, "antenna_gain_db");
  expect_checked(&Racon::threshold_dbm, "threshold_dbm");
  expect_checked(&Sart::height_m, "height_m");
  expect_checked(&Emitter::frequency_hz, "frequency_hz");
  expect_checked(&Emitter::power_w, "power_w");
  expect_checked(&Emitter::antenna_gain_db, "antenna_gain_db");
  expect_checked(&Emitter::side_lobe_db, "side_lobe_db");
  expect_checked(&Emitter::beam_width_deg, "beam_width_deg");
  expect_checked(&Emitter::pulse_s, "pulse_s");
  expect_checked(&Emitter::rpm, "rpm");
  expect_checked(&Emitter::bearing_deg, "bearing_deg");
}

}  // namespace
}  // namespace skerry::echo
