// What a bridge or an autopilot outside tells the ship to do, whichever sentence says it.
#include <gtest/gtest.h>

#include "protocol/nmea/con_command.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

ConCommand command_of(const std::string& between) {
  return decoded(with_checksum(between), decode_con_command);
}

std::string fault_of(const std::string& between) {
  const std::string line = with_checksum(between);
  const auto result = decode_con_command(parse_sentence(line).value());
  return result ? "" : result.error().text;
}

TEST(ConCommand, AHeadingToSteer) {
  EXPECT_EQ(command_of("AGHTC,V,,,H,N,,,,,92.5,,,T,C"),
            (ConCommand{.mode = SteeringMode::heading, .heading_deg = 92.5}));
  EXPECT_EQ(command_of("AGHSC,360.0,T,,M,C"),
            (ConCommand{.mode = SteeringMode::heading, .heading_deg = 0.0}));
  EXPECT_EQ(command_of("AGHSC,92.5,T,91.0,M").heading_deg, 92.5)
      << "of an edition without the flag";
  EXPECT_EQ(command_of("AGHTC,V,,,S,N,,,,,92.5,,,T,C"), (ConCommand{.mode = SteeringMode::heading}))
      << "a controller that stands alone takes no heading";
}

TEST(ConCommand, ATurnIsOfARadiusOrOfARate) {
  const ConCommand radius = command_of("AGHTC,V,,,H,R,30,,0.5,12,92.5,,,T,C");
  EXPECT_EQ(radius.turn_radius_nm, 0.5);
  EXPECT_FALSE(radius.turn_rate_deg_min);
  EXPECT_EQ(radius.rudder_limit_deg, 30.0);
  const ConCommand rate = command_of("AGHTC,V,,,T,T,,,0.5,12,,,270,T,C");
  EXPECT_FALSE(rate.turn_radius_nm);
  EXPECT_EQ(rate.turn_rate_deg_min, 12.0);
  EXPECT_EQ(rate.mode, SteeringMode::track);
  EXPECT_EQ(rate.track_deg, 270.0);
  EXPECT_FALSE(rate.heading_deg);
}

TEST(ConCommand, ARudderOrder) {
  const ConCommand port{.mode = SteeringMode::hand, .rudder_deg = -12.5};
  EXPECT_EQ(command_of("AGHTC,V,12.5,L,R,N,,,,,,,,T,C"), port);
  EXPECT_EQ(command_of("AGHTC,V,12.5,L,M,,,,,,,,,,C"), port);
  EXPECT_EQ(command_of("AGHTC,A,12.5,L,H,N,,,,,92.5,,,T,C"), port) << "the override comes first";
  EXPECT_EQ(command_of("RCROR,-12.5,A,,V,B"), port);
  EXPECT_EQ(command_of("RCROR,,V,-12.5,A,B"), port);
  EXPECT_FALSE(says_something(command_of("RCROR,-12.5,V,,V,B")));
  EXPECT_EQ(command_of("AGHTC,V,,,M,,,,,,,,,,C"), (ConCommand{.mode = SteeringMode::hand}));
}

TEST(ConCommand, AnEnginesLever) {
  EXPECT_EQ(command_of("RCPRC,-25.0,A,,V,-45.1,P,B,2"),
            (ConCommand{.shaft = 2, .lever_percent = -25.0, .pitch_percent = -45.1}));
  EXPECT_EQ(command_of("RCPRC,,V,60,P,,V,B,0"), (ConCommand{.shaft = 0, .lever_percent = 60.0}));
  EXPECT_EQ(command_of("RCPRC,,V,95.5,R,,V,B,1"), (ConCommand{.shaft = 1, .revolutions = 95.5}));
  EXPECT_FALSE(says_something(command_of("RCPRC,,V,,V,,V,B,1")));
  EXPECT_EQ(command_of("RCETL,,O,04,30,B,1"), (ConCommand{.shaft = 1, .lever_percent = 80.0}));
  EXPECT_EQ(command_of("RCETL,,O,11,20,B,0"), (ConCommand{.shaft = 0, .lever_percent = -20.0}));
}

TEST(ConCommand, AThruster) {
  EXPECT_EQ(command_of("RCTRC,1,-60,P,,V,,B,C"), (ConCommand{.bow_thruster_percent = -60.0}));
  EXPECT_EQ(command_of("RCTRC,2,80,R,40,P,,B,C"), (ConCommand{.stern_thruster_percent = 40.0}));
  EXPECT_EQ(command_of("RCTRC,2,80,P,10,D,,B"), (ConCommand{.stern_thruster_percent = 80.0}));
  EXPECT_FALSE(says_something(command_of("RCTRC,1,,V,,V,,B,C")));
}

TEST(ConCommand, ReportsAnswersAndOtherSentencesCommandNothing) {
  for (const char* other : {"AGHTC,V,,,H,N,,,,,92.5,,,T,R", "AGHSC,92.5,T,,M,R",
                            "RCETL,,A,04,30,B,1", "RCTRC,1,60,P,,V,,B,R", "AGHSC,,T,,M,C",
                            "HEHDT,92.5,T", "AGHTD,V,5,R,R,N,,,,,,,,T,A,A,A,1", "AGRSA,10,A,,V"}) {
    EXPECT_FALSE(says_something(command_of(other))) << other;
  }
}

TEST(ConCommand, WhatCannotBeObeyedIsRefused) {
  EXPECT_EQ(fault_of("AGHTC,V,,,H,N,,,,,92.5,,,M,C"),
            "HTC field 13 is \"M\"; T for true was expected");
  EXPECT_NE(fault_of("AGHTC,V,,,T,N,,,,,,,92.5,,C"), "");
  EXPECT_NE(fault_of("AGHTC,V,,,,N,,,,,92.5,,,T,C"), "") << "no steering mode";
  EXPECT_NE(fault_of("AGHSC,,T,92.5,M,C"), "") << "a magnetic heading";
  EXPECT_NE(fault_of("RCPRC,,V,,V,13,D,B,0"), "") << "a pitch in degrees alone";
  EXPECT_EQ(fault_of("RCTRC,3,15.3,R,,V,,B,C"),
            "TRC field 3 is \"R\"; P for per cent was expected");
  EXPECT_NE(fault_of("RCTRC,4,40,P,,V,271.8,B,C"), "") << "it turns";
  EXPECT_NE(fault_of("RCROR,95,A,,V,B"), "");
  EXPECT_NE(fault_of("AGHSC,x,T,,M,C"), "");
}

}  // namespace
}  // namespace skerry::nmea
