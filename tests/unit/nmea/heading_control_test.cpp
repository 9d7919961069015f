// What heading controllers are told and say: letter by letter, back, and as other equipment says
// it.
#include <gtest/gtest.h>

#include "protocol/nmea/heading_control_sentences.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

SteeringFields every_field() {
  return {.is_overridden = true,
          .rudder_deg = -12.5,
          .steering = SelectedSteering::heading,
          .turn = TurnMode::rate,
          .rudder_limit_deg = 35.0,
          .off_heading_limit_deg = 10.0,
          .turn_radius_nm = 0.75,
          .turn_rate_deg_min = 12.0,
          .heading_deg = 92.5,
          .off_track_limit_nm = 0.25,
          .track_deg = 359.96,
          .reference = 'T'};
}

TEST(Htc, IsAsWrittenAndRead) {
  const std::string line = encode(Htc{.fields = every_field()});
  EXPECT_EQ(body(line), "$AGHTC,A,12.5,L,H,T,35.0,10.0,0.750,12.0,92.5,0.250,0.0,T,C");
  const Htc back = decoded(line, decode_htc);
  EXPECT_TRUE(back.fields.is_overridden);
  EXPECT_EQ(back.fields.rudder_deg, -12.5);
  EXPECT_EQ(back.fields.steering, SelectedSteering::heading);
  EXPECT_EQ(back.fields.turn, TurnMode::rate);
  EXPECT_EQ(back.fields.rudder_limit_deg, 35.0);
  EXPECT_EQ(back.fields.off_heading_limit_deg, 10.0);
  EXPECT_EQ(back.fields.turn_radius_nm, 0.75);
  EXPECT_EQ(back.fields.turn_rate_deg_min, 12.0);
  EXPECT_EQ(back.fields.heading_deg, 92.5);
  EXPECT_EQ(back.fields.off_track_limit_nm, 0.25);
  EXPECT_EQ(back.fields.track_deg, 0.0);
  EXPECT_EQ(back.fields.reference, 'T');
  EXPECT_TRUE(back.is_command);
  EXPECT_EQ(body(encode(Htc{.fields = {.reference = '\0'}, .is_command = false})),
            "$AGHTC,V,,,,,,,,,,,,,R");
}

TEST(Htc, OfOtherEquipmentIsRead) {
  // The suite of marine-api; of an edition without the status flag.
  const Htc old = decoded("$AGHTC,V,0.1,R,M,,15.0,15.0,,,90.3,,,T*53", decode_htc);
  EXPECT_FALSE(old.fields.is_overridden);
  EXPECT_EQ(old.fields.rudder_deg, 0.1);
  EXPECT_EQ(old.fields.steering, SelectedSteering::main);
  EXPECT_FALSE(old.fields.turn);
  EXPECT_EQ(old.fields.rudder_limit_deg, 15.0);
  EXPECT_EQ(old.fields.heading_deg, 90.3);
  EXPECT_TRUE(old.is_command);
}

TEST(Htc, WhatIsWrongIsRefused) {
  for (const char* bad :
       {"AGHTC,X,,,H,N,,,,,90,,,T,C", "AGHTC,V,91,R,R,N,,,,,,,,T,C", "AGHTC,V,-5,R,R,N,,,,,,,,T,C",
        "AGHTC,V,5,,R,N,,,,,,,,T,C", "AGHTC,V,5,X,R,N,,,,,,,,T,C", "AGHTC,V,,,X,N,,,,,90,,,T,C",
        "AGHTC,V,,,H,X,,,,,90,,,T,C", "AGHTC,V,,,H,N,91,,,,90,,,T,C",
        "AGHTC,V,,,H,N,,181,,,90,,,T,C", "AGHTC,V,,,H,N,,,100,,90,,,T,C",
        "AGHTC,V,,,H,N,,,,1000,90,,,T,C", "AGHTC,V,,,H,N,,,,,360.1,,,T,C",
        "AGHTC,V,,,H,N,,,,,90,,-1,T,C", "AGHTC,V,,,H,N,,,,,90,,,X,C",
        "AGHTC,V,,,H,N,,,,,90,,,T,X"}) {
    EXPECT_TRUE(is_refused(bad, decode_htc)) << bad;
  }
  EXPECT_EQ(decoded(with_checksum("AGHTC,V,0,,R,N,,,,,,,,T,C"), decode_htc).fields.rudder_deg, 0.0)
      << "midships has no side";
}

TEST(Htd, IsAsWrittenAndRead) {
  const std::string line = encode(Htd{.fields = every_field(),
                                      .rudder_within_limit = true,
                                      .heading_within_limit = false,
                                      .ship_heading_deg = 90.1});
  EXPECT_EQ(body(line), "$AGHTD,A,12.5,L,H,T,35.0,10.0,0.750,12.0,92.5,0.250,0.0,T,A,V,,90.1");
  const Htd back = decoded(line, decode_htd);
  EXPECT_EQ(back.rudder_within_limit, true);
  EXPECT_EQ(back.heading_within_limit, false);
  EXPECT_FALSE(back.track_within_limit);
  EXPECT_EQ(back.ship_heading_deg, 90.1);
  EXPECT_EQ(back.fields.rudder_deg, -12.5);
}

// Three autopilots' logs, in public repositories.
TEST(Htd, OfOtherEquipmentIsRead) {
  const Htd first =
      decoded("$AGHTD,V,2.0,R,S,N,15.0,10.0,0.000,0.0,84.0,0.000,0.0,T,A,A,,84.1*17", decode_htd);
  EXPECT_EQ(first.fields.rudder_deg, 2.0);
  EXPECT_EQ(first.fields.steering, SelectedSteering::stand_alone);
  EXPECT_EQ(first.fields.turn, TurnMode::free);
  EXPECT_EQ(first.fields.heading_deg, 84.0);
  EXPECT_EQ(first.ship_heading_deg, 84.1);
  const Htd second =
      decoded("$AGHTD,V,2.3,R,S,T,15.0,10.0,,10.00,125.0,,,T,A,A,,123.09*1F", decode_htd);
  EXPECT_EQ(second.fields.turn_rate_deg_min, 10.0);
  EXPECT_EQ(second.fields.heading_deg, 125.0);
  EXPECT_EQ(second.ship_heading_deg, 123.09);
  const Htd third =
      decoded("$AGHTD,V,0.3,R,M,N,35.0,30.0,0.5,30.0,,0.000,,T,A,A,A,14.5*4E", decode_htd);
  EXPECT_EQ(third.fields.turn_radius_nm, 0.5);
  EXPECT_EQ(third.track_within_limit, true);
  EXPECT_EQ(third.ship_heading_deg, 14.5);
  EXPECT_EQ(
      decoded("$AGHTD,V,0.1,R,M,,15.0,15.0,,,,,,T,A,A,A,90.3,*39", decode_htd).ship_heading_deg,
      90.3);
  EXPECT_TRUE(is_refused("AGHTD,V,,,M,N,,,,,,,,T,X,A,A,1", decode_htd));
}

TEST(Hsc, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Hsc{.true_deg = 92.5})), "$AGHSC,92.5,T,,M,C");
  EXPECT_EQ(body(encode(Hsc{.is_command = false})), "$AGHSC,,T,,M,R");
  const Hsc hsc = decoded("$FTHSC,40.12,T,39.11,M*5E", decode_hsc);  // go-nmea
  EXPECT_EQ(hsc.true_deg, 40.12);
  EXPECT_EQ(hsc.magnetic_deg, 39.11);
  EXPECT_TRUE(hsc.is_command);
  EXPECT_FALSE(decoded(with_checksum("AGHSC,40,M,,"), decode_hsc).true_deg);
  EXPECT_TRUE(is_refused("AGHSC,-1,T,,M,C", decode_hsc));
}

}  // namespace
}  // namespace skerry::nmea
