// What sentences say when a sensor is lost.
#include <gtest/gtest.h>

#include "protocol/nmea/ais_sentences.hpp"
#include "tests/unit/navigation/test_world.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;
using enum NavigationSentence;

class LostSensors : public testing::Test {
 protected:
  LostSensors() {
    wire::ConState& con = *world_.own.mutable_con();
    con.set_rudder_deg(5.0);
    con.set_water_ahead_kn(11.0);
    con.set_water_starboard_kn(0.5);
    con.set_ground_ahead_kn(11.8);
    con.set_ground_starboard_kn(2.0);
    con.set_wind_from_deg(90.0);
    con.set_wind_kn(15.0);
    con.set_current_set_deg(45.0);
    con.set_current_kn(1.0);
    con.set_waypoint(1);
    con.set_cross_track_m(20.0);
    world_.add(1, 2.0);
  }
  // The first line of a sentence; "nothing" if it is not said.
  std::string line(NavigationSentence sentence) {
    NavigationPlan plan;
    plan.periods = {{sentence, 1s}};
    plan.targets = TargetSource::truth;
    NavigationTalker talker(plan);
    for (int i = 0; i <= 20; ++i) {
      const auto said = talker.due(at_seconds(0.1 * i), world_);
      if (!said.empty()) return said.front().lines.front();
    }
    return "nothing";
  }
  std::string body(NavigationSentence sentence) {
    const std::string whole = line(sentence);
    return whole.substr(0, whole.find('*'));
  }
  TestWorld world_;
};

TEST_F(LostSensors, WithoutAGyroThereIsNoHeadingNorRateNorWhatIsResolved) {
  world_.own.set_no_heading(true);
  world_.own.set_heading_deg(0.0);
  EXPECT_EQ(body(hdt), "$HEHDT,,T");
  EXPECT_EQ(body(ths), "$HETHS,,V");
  EXPECT_EQ(body(rot), "$TIROT,,V");
  EXPECT_EQ(body(vhw).substr(0, 13), "$VWVHW,,T,,M,");
  EXPECT_NE(body(vhw).find("11.00,N"), std::string::npos) << body(vhw);
  EXPECT_EQ(body(mwd), "$WIMWD,,T,,M,,N,,M");
  EXPECT_NE(body(mwv), "nothing");
  EXPECT_NE(body(rsa).find("5.0,A"), std::string::npos) << body(rsa);
  EXPECT_NE(body(vtg).find("20.0,T"), std::string::npos) << body(vtg);
  EXPECT_NE(body(vbw).find("11.00,0.50,A,,,V"), std::string::npos) << body(vbw);
}

TEST_F(LostSensors, WithoutAReceiverThereIsNoPositionAndTheLogGoesOn) {
  world_.own.set_no_position(true);
  world_.own.set_no_motion(true);
  EXPECT_NE(body(rmc).find(",V,,,,,,"), std::string::npos) << body(rmc);
  EXPECT_NE(body(gga).find(",,,,,0,00,"), std::string::npos) << body(gga);
  EXPECT_EQ(body(vtg).substr(0, 15), "$GPVTG,,T,,M,,N");
  EXPECT_NE(body(hdt).find("10.00,T"), std::string::npos) << body(hdt);
  EXPECT_NE(body(rot).find("3.0,A"), std::string::npos) << body(rot);
  EXPECT_NE(body(vhw).find("11.00,N"), std::string::npos) << body(vhw);
  EXPECT_NE(body(vbw).find("11.00,0.50,A,,,V"), std::string::npos) << body(vbw);
  EXPECT_NE(body(xte).find("V,V"), std::string::npos) << body(xte);
  EXPECT_EQ(body(ttm), "nothing");
}

TEST_F(LostSensors, WithoutALogThereIsNoSpeedThroughTheWater) {
  world_.own.set_no_log(true);
  EXPECT_EQ(body(vhw).find("11.0"), std::string::npos) << body(vhw);
  EXPECT_NE(body(vhw).find("10.00,T"), std::string::npos) << body(vhw);
  EXPECT_NE(body(vbw).find(",,,V,11.80,2.00,A"), std::string::npos) << body(vbw);
  EXPECT_EQ(body(vdr), "$IIVDR,,T,,M,,N");
}

TEST_F(LostSensors, WithoutAnAnemometerThereIsNoWind) {
  EXPECT_NE(body(mwv).find("N,A"), std::string::npos) << body(mwv);
  world_.own.set_no_wind(true);
  EXPECT_EQ(body(mwv).find("N,A"), std::string::npos) << body(mwv);
  EXPECT_NE(body(mwv).find(",V"), std::string::npos) << body(mwv);
  EXPECT_EQ(body(mwd), "$WIMWD,,T,,M,,N,,M");
}

TEST_F(LostSensors, WithoutAnAisReceiverOthersAreNotHeardAndHerOwnIsSent) {
  EXPECT_NE(line(vdm), "nothing");
  world_.own.set_no_ais(true);
  EXPECT_EQ(line(vdm), "nothing");
  EXPECT_NE(line(vdo), "nothing");
}

TEST_F(LostSensors, AShipSaysByAisWhatHerSensorsSayAndNothingWhenSheIsSilent) {
  const auto heard = [&]() -> std::optional<nmea::AisPosition> {
    const std::string said = line(vdm);
    if (said == "nothing") return std::nullopt;
    nmea::AisAssembler assembler;
    const auto message = assembler.feed(*nmea::parse_sentence(said));
    const auto* position = std::get_if<nmea::AisPosition>(&(**message).message);
    return position ? std::optional(*position) : std::nullopt;
  };
  TrafficItem& other = world_.items.front();
  other.ais.emplace();
  other.ais->position = GeoPoint{60.5, 5.5};
  other.ais->speed_mps = 5.0;
  const auto report = heard();
  ASSERT_TRUE(report);
  EXPECT_NEAR(report->position->latitude_deg, 60.5, 1e-5);
  EXPECT_FALSE(report->heading_deg || report->course_deg || report->rate_of_turn_deg_min);
  other.ais->silent = true;
  EXPECT_EQ(line(vdm), "nothing");
}

}  // namespace
}  // namespace skerry::server
