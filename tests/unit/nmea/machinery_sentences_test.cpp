// Rudder, engines and thrusters: letter by letter, back, and as other equipment says them.
#include <gtest/gtest.h>

#include <limits>

#include "protocol/nmea/engine_sentences.hpp"
#include "protocol/nmea/rudder_sentences.hpp"
#include "protocol/nmea/thruster_sentences.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

using namespace std::chrono_literals;

constexpr double kNotANumber = std::numeric_limits<double>::quiet_NaN();

TEST(Rsa, IsPositiveToStarboardAndSaysWhatIsNotValid) {
  EXPECT_EQ(body(encode(Rsa{.starboard_deg = -12.34})), "$AGRSA,-12.3,A,,V");
  const Rsa both = decoded(encode(Rsa{.starboard_deg = 5.0, .port_deg = -4.5}, "II"), decode_rsa);
  EXPECT_EQ(both.starboard_deg, 5.0);
  EXPECT_EQ(both.port_deg, -4.5);
  EXPECT_EQ(body(encode(Rsa{.starboard_deg = kNotANumber, .port_deg = 181.0})), "$AGRSA,,V,,V");
}

TEST(Rsa, OfOtherEquipmentIsRead) {
  const Rsa twin = decoded("$RCRSA,-22.0,A,34.0,A*7B", decode_rsa);  // Navis NavDP 4000, p297
  EXPECT_EQ(twin.starboard_deg, -22.0);
  EXPECT_EQ(twin.port_deg, 34.0);
  const Rsa single = decoded("$IIRSA,10.5,A,,V*4D", decode_rsa);  // go-nmea
  EXPECT_EQ(single.starboard_deg, 10.5);
  EXPECT_FALSE(single.port_deg);
  EXPECT_FALSE(decoded(with_checksum("AGRSA,10.5,V,1,V"), decode_rsa).starboard_deg);
  for (const char* bad : {"AGRSA,200,A,,V", "AGRSA,1e1,A,,V", "AGRSA,nan,A,,V", "AGRSA,1,X,,V",
                          "AGRSA,1,AA,,V", "AGRSA,--1,A,,V"}) {
    EXPECT_TRUE(is_refused(bad, decode_rsa)) << bad;
  }
}

TEST(Ror, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Ror{.starboard_deg = 10.0})), "$RCROR,10.0,A,,V,B");
  const Ror ror = decoded("$RCROR,-22.0,A,34.0,A,B*1A", decode_ror);  // Navis NavDP 4000, p296
  EXPECT_EQ(ror.starboard_deg, -22.0);
  EXPECT_EQ(ror.port_deg, 34.0);
  EXPECT_EQ(ror.place, CommandPlace::bridge);
  EXPECT_FALSE(decoded(with_checksum("RCROR,1,A"), decode_ror).place);
  for (const char* bad : {"RCROR,91,A,,V,B", "RCROR,1,A,,V,Q"}) {
    EXPECT_TRUE(is_refused(bad, decode_ror)) << bad;
  }
}

TEST(RpmSentence, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Rpm{.number = 1, .revolutions = -74.64, .pitch_percent = 30.0})),
            "$RCRPM,S,1,-74.6,30.0,A");
  EXPECT_EQ(body(encode(Rpm{.source = RevolutionSource::engine, .revolutions = 1e9})),
            "$RCRPM,E,0,,,V");
  const Rpm rpm = decoded("$RCRPM,S,0,74.6,30.0,A*56", decode_rpm);  // go-nmea
  EXPECT_EQ(rpm.source, RevolutionSource::shaft);
  EXPECT_EQ(rpm.number, 0u);
  EXPECT_EQ(rpm.revolutions, 74.6);
  EXPECT_EQ(rpm.pitch_percent, 30.0);
  EXPECT_FALSE(decoded(with_checksum("RCRPM,E,2,74.6,30.0,V"), decode_rpm).revolutions);
  for (const char* bad : {"RCRPM,X,0,1,1,A", "RCRPM,,0,1,1,A", "RCRPM,S,100,1,1,A",
                          "RCRPM,S,-1,1,1,A", "RCRPM,S,0,10000,1,A", "RCRPM,S,0,1,101,A"}) {
    EXPECT_TRUE(is_refused(bad, decode_rpm)) << bad;
  }
}

TEST(Prc, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Prc{.lever_percent = 75.0,
                            .speed = Demand{90.5, false},
                            .pitch = Demand{-45.1, true},
                            .shaft = 1})),
            "$RCPRC,75.0,A,90.5,R,-45.1,P,B,1");
  EXPECT_EQ(body(encode(Prc{.place = std::nullopt})), "$RCPRC,,V,,V,,V,,0");
  // Navis NavDP 4000, p296.
  const Prc prc = decoded("$RCPRC,-25.0,A,,V,-45.1,P,B,2*60", decode_prc);
  EXPECT_EQ(prc.lever_percent, -25.0);
  EXPECT_FALSE(prc.speed);
  EXPECT_EQ(prc.pitch, (Demand{-45.1, true}));
  EXPECT_EQ(prc.place, CommandPlace::bridge);
  EXPECT_EQ(prc.shaft, 2u);
  EXPECT_EQ(decoded("$RCPRC,75.0,A,,V,85.8,P,B,1*63", decode_prc).shaft, 1u);
  const Prc degrees = decoded(with_checksum("RCPRC,50.0,V,2250.0,R,13.0,D,C,0"), decode_prc);
  EXPECT_FALSE(degrees.lever_percent);
  EXPECT_EQ(degrees.speed, (Demand{2250.0, false}));
  EXPECT_EQ(degrees.pitch, (Demand{13.0, false}));
  for (const char* bad : {"RCPRC,101,A,,V,,V,B,0", "RCPRC,1,A,101,P,,V,B,0",
                          "RCPRC,1,A,10000,R,,V,B,0", "RCPRC,1,A,1,D,,V,B,0",
                          "RCPRC,1,A,,V,91,D,B,0", "RCPRC,1,A,,V,,V,X,0", "RCPRC,1,A,,V,,V,B,x"}) {
    EXPECT_TRUE(is_refused(bad, decode_prc)) << bad;
  }
}

TEST(EtlSentence, IsAsWrittenAndRead) {
  const Etl order{.time_of_day = 9h + 8min + 7s + 60ms,
                  .order = EngineOrder::crash_astern,
                  .sub = SubTelegraph::full_away,
                  .shaft = 2};
  const std::string line = encode(order);
  EXPECT_EQ(body(line), "$RCETL,090807.06,O,15,30,B,2");
  const Etl back = decoded(line, decode_etl);
  EXPECT_EQ(back.time_of_day, order.time_of_day);
  EXPECT_TRUE(back.is_order);
  EXPECT_EQ(back.order, order.order);
  EXPECT_EQ(back.sub, order.sub);
  EXPECT_EQ(back.shaft, order.shaft);
  EXPECT_EQ(body(encode(Etl{.is_order = false})), "$RCETL,,A,00,,B,0");
  EXPECT_FALSE(decoded(with_checksum("RCETL,,A,04,30,B,0"), decode_etl).is_order);
  for (const char* bad : {"RCETL,,X,04,30,B,0", "RCETL,,,04,30,B,0", "RCETL,,O,06,30,B,0",
                          "RCETL,,O,16,30,B,0", "RCETL,,O,,30,B,0", "RCETL,,O,04,25,B,0",
                          "RCETL,,O,04,50,B,0", "RCETL,250000,O,04,30,B,0"}) {
    EXPECT_TRUE(is_refused(bad, decode_etl)) << bad;
  }
}

TEST(EtlSentence, OrdersAreStepsOfTheLever) {
  EXPECT_EQ(lever_percent_of(EngineOrder::stop), 0.0);
  EXPECT_EQ(lever_percent_of(EngineOrder::navigation_full), 100.0);
  EXPECT_EQ(lever_percent_of(EngineOrder::dead_slow_astern), -20.0);
  for (int step = 0; step <= 15; ++step) {
    if (step > 5 && step < 11) continue;
    const auto order = static_cast<EngineOrder>(step);
    EXPECT_EQ(nearest_order(lever_percent_of(order)), order) << step;
  }
  EXPECT_EQ(nearest_order(10.0), EngineOrder::stop) << "the smaller one of two";
  EXPECT_EQ(nearest_order(-10.1), EngineOrder::dead_slow_astern);
  EXPECT_EQ(nearest_order(1e300), EngineOrder::navigation_full);
  EXPECT_EQ(nearest_order(-std::numeric_limits<double>::infinity()), EngineOrder::crash_astern);
  EXPECT_EQ(nearest_order(kNotANumber), EngineOrder::stop);
}

TEST(Trc, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Trc{.number = 1, .speed = Demand{-60.0, true}})),
            "$RCTRC,1,-60.0,P,,V,,B,C");
  // Navis NavDP 4000, p298.
  const Trc tunnel = decoded("$RCTRC,3,15.3,R,,V,,B,C*7B", decode_trc);
  EXPECT_EQ(tunnel.number, 3u);
  EXPECT_TRUE(is_bow_thruster(tunnel.number));
  EXPECT_EQ(tunnel.speed, (Demand{15.3, false}));
  EXPECT_FALSE(tunnel.pitch);
  EXPECT_FALSE(tunnel.azimuth_deg);
  EXPECT_TRUE(tunnel.is_command);
  const Trc turning = decoded("$RCTRC,4,401.4,R,,V,271.8,B,C*68", decode_trc);
  EXPECT_FALSE(is_bow_thruster(turning.number));
  EXPECT_EQ(turning.azimuth_deg, 271.8);
  EXPECT_FALSE(decoded(with_checksum("RCTRC,1,5,P,,V,,B,R"), decode_trc).is_command);
  for (const char* bad :
       {"RCTRC,0,5,P,,V,,B,C", "RCTRC,,5,P,,V,,B,C", "RCTRC,1,5,T,,V,,B,C", "RCTRC,1,101,P,,V,,B,C",
        "RCTRC,1,5,P,,V,361,B,C", "RCTRC,1,5,P,,V,,B,X"}) {
    EXPECT_TRUE(is_refused(bad, decode_trc)) << bad;
  }
}

TEST(Trd, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Trd{.number = 2, .pitch = Demand{40.0, true}, .azimuth_deg = -90.0})),
            "$RCTRD,2,,V,40.0,P,270.0");
  // Navis NavDP 4000, p299.
  const Trd tunnel = decoded("$RCTRD,3,-17.8,R,,V,*59", decode_trd);
  EXPECT_EQ(tunnel.speed, (Demand{-17.8, false}));
  EXPECT_FALSE(tunnel.azimuth_deg);
  EXPECT_EQ(decoded("$RCTRD,2,400.5,R,,V,90.8*55", decode_trd).azimuth_deg, 90.8);
  EXPECT_TRUE(is_refused("RCTRD,100,5,P,,V,", decode_trd));
}

}  // namespace
}  // namespace skerry::nmea
