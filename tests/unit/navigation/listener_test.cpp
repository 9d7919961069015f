#include <gtest/gtest.h>

#include "server/navigation/navigation_listener.hpp"
#include "tests/unit/navigation/test_world.hpp"

namespace skerry::server {
namespace {

constexpr double kKnot = 1852.0 / 3600.0;

class Listening : public testing::Test {
 protected:
  HeardLine hear(const std::string& between, double time_s = 0.0) {
    return listener.hear("$" + between + "*" + nmea::checksum_text(between), at_seconds(time_s));
  }
  // The fix of a sentence that must have one.
  OwnShipFix fix(const std::string& between, double time_s = 0.0) {
    const HeardLine heard = hear(between, time_s);
    EXPECT_EQ(heard.fault, "");
    EXPECT_TRUE(heard.fix) << between;
    return heard.fix.value_or(OwnShipFix{});
  }
  NavigationListener listener{std::chrono::seconds(10)};
};

TEST_F(Listening, RmcGivesPositionCourseAndSpeed) {
  const OwnShipFix rmc = fix("GPRMC,092204,A,6024.000,N,00519.200,E,10.0,84.5,211126,,,A");
  EXPECT_EQ(rmc.position, (GeoPoint{60.4, 5.32}));
  EXPECT_NEAR(*rmc.speed_mps, 10 * kKnot, 1e-12);
  EXPECT_EQ(rmc.course_over_ground_deg, 84.5);
  EXPECT_FALSE(rmc.heading_deg);
}

TEST_F(Listening, EachSentenceGivesWhatItSaysAndNoMore) {
  EXPECT_TRUE(fix("GPGGA,092204,6024.0,N,00519.2,E,8,12,0.8,0,M,0,M,,").position)
      << "a simulator's quality";
  EXPECT_TRUE(fix("GPGLL,6024.0,N,00519.2,E,092204,A").position);
  const OwnShipFix vtg = fix("GPVTG,84.5,T,,M,10.0,N,18.5,K,A");
  EXPECT_EQ(vtg.course_over_ground_deg, 84.5);
  EXPECT_FALSE(vtg.position);
  EXPECT_EQ(fix("HEHDT,360.0,T").heading_deg, 0.0);
  EXPECT_EQ(fix("HETHS,12.5,S").heading_deg, 12.5);
  EXPECT_EQ(fix("TIROT,-33.0,A").rate_of_turn_deg_min, -33.0);
  EXPECT_EQ(fix("INHDT,12.5,T").heading_deg, 12.5) << "of any talker";
}

TEST_F(Listening, WhatSaysThatItIsNotValidIsPassedOver) {
  for (const char* line :
       {"GPRMC,092204,V,6024.0,N,00519.2,E,10.0,84.5,211126,,,N", "GPRMC,,V,,,,,,,,,,N",
        "GPGGA,092204,6024.0,N,00519.2,E,0,00,,,M,,M,,", "GPGLL,6024.0,N,00519.2,E,092204,V",
        "HETHS,12.5,V", "TIROT,5.0,V", "VDVBW,1.0,,V,2.0,,V", "GPVTG,84.5,T,,M,10.0,N,18.5,K,N",
        "HEHDT,,T", "IIMWV,12.0,R,5.0,N,A", "GPGSV,1,1,00", "PGRME,15.0,M"}) {
    const HeardLine heard = hear(line);
    EXPECT_FALSE(heard.fix) << line;
    EXPECT_EQ(heard.fault, "") << line;
  }
  // A simulator that keeps to the standard: status V, mode S.
  EXPECT_TRUE(hear("GPRMC,092204,V,6024.0,N,00519.2,E,10.0,84.5,211126,,,S").fix);
}

TEST_F(Listening, WhatCannotBeReadIsAFaultAndMovesNothing) {
  for (const std::string& line :
       {std::string("garbage"), std::string("$HEHDT,12.5,T*00"), std::string(5000, '$'),
        std::string("$HEHDT,12.5,T*5"), std::string("\0\xFF\x80*", 4)}) {
    const HeardLine heard = listener.hear(line, at_seconds(0));
    EXPECT_FALSE(heard.fix);
    EXPECT_NE(heard.fault, "");
  }
  for (const char* line : {"HEHDT,361,T", "GPRMC,092204,A,9124.0,N,00519.2,E,10.0,84.5,211126,,,A",
                           "GPRMC,092204,A,6024.0,N,00519.2,E,-1,84.5,211126,,,A",
                           "GPVTG,84.5,T,,M,195.0,N,,K,A", "VDVBW,900,900,A,900,900,A"}) {
    const HeardLine heard = hear(line);
    EXPECT_FALSE(heard.fix) << line;
    EXPECT_NE(heard.fault, "") << line;
  }
}

TEST_F(Listening, TheLogOverGroundMovesAlongTheHeading) {
  EXPECT_FALSE(fix("VDVBW,10.0,0.0,A,10.0,0.0,A").course_over_ground_deg) << "heading not known";
  fix("HEHDT,350.0,T");
  const OwnShipFix drifting = fix("VDVBW,9.0,0.0,A,10.0,10.0,A");
  EXPECT_NEAR(*drifting.course_over_ground_deg, 35.0, 1e-9);
  EXPECT_NEAR(*drifting.speed_mps, std::sqrt(200.0) * kKnot, 1e-9);
  const OwnShipFix astern = fix("VDVBW,,,V,-4.0,0.0,A");
  EXPECT_NEAR(*astern.course_over_ground_deg, 170.0, 1e-9);
  EXPECT_NEAR(*astern.speed_mps, 4 * kKnot, 1e-9);
}

TEST_F(Listening, SpeedThroughTheWaterStandsInOnlyWhileThatOverGroundIsMissing) {
  fix("HEHDT,90.0,T", 0);
  const OwnShipFix water = fix("VWVHW,90.0,T,,M,8.0,N,,K", 1);
  EXPECT_NEAR(*water.speed_mps, 8 * kKnot, 1e-12);
  EXPECT_EQ(water.course_over_ground_deg, 90.0);
  fix("GPVTG,100.0,T,,M,9.0,N,,K,A", 2);
  const OwnShipFix after = fix("VWVHW,90.0,T,,M,8.0,N,,K", 3);
  EXPECT_FALSE(after.speed_mps);
  EXPECT_EQ(after.heading_deg, 90.0);
  EXPECT_FALSE(hear("VDVBW,8.0,0.0,A,,,V", 3.5).fix);
  EXPECT_TRUE(fix("VWVHW,90.0,T,,M,8.0,N,,K", 7.1).speed_mps);
}

std::string gll(double north_m) {
  const std::string line = nmea::SentenceWriter('$', "GP", "GLL")
                               .position({60.0 + north_m / 111'412.0, 5.0})
                               .time({})
                               .letter('A')
                               .finish();
  return line.substr(1, line.find('*') - 1);
}

TEST_F(Listening, AJumpIsToldAndObeyed) {
  fix("GPVTG,0.0,T,,M,20.0,N,,K,A", 0);
  EXPECT_FALSE(hear(gll(0), 0).jump_m);
  double north = 0;
  for (int second = 1; second <= 60; ++second) {
    north += 20 * kKnot;
    const HeardLine heard = hear(gll(north), second);
    EXPECT_FALSE(heard.jump_m) << second;
  }
  const HeardLine moved = hear(gll(north + 5000), 61);
  ASSERT_TRUE(moved.jump_m);
  EXPECT_NEAR(*moved.jump_m, 5000, 20);
  ASSERT_TRUE(moved.fix);
  EXPECT_NEAR(moved.fix->position->latitude_deg, 60.0 + (north + 5000) / 111'412.0, 1e-6);
  EXPECT_FALSE(hear(gll(north + 5010), 62).jump_m) << "from there on she sails";
}

TEST_F(Listening, AfterASilenceItBeginsAnewWithoutAJump) {
  EXPECT_FALSE(hear(gll(0), 0).jump_m);
  EXPECT_TRUE(hear(gll(50'000), 9.9).jump_m);
  const HeardLine anew = hear(gll(0), 20.0);
  EXPECT_TRUE(anew.fix);
  EXPECT_FALSE(anew.jump_m);
}

}  // namespace
}  // namespace skerry::server
