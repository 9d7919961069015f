// Tracks, waypoints and positions: letter by letter, back, and as other equipment says them.
#include <gtest/gtest.h>

#include "protocol/nmea/gnss_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/track_sentences.hpp"
#include "protocol/nmea/waypoint_sentences.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

using namespace std::chrono_literals;

constexpr Duration kMorning = 9h + 8min + 7s + 60ms;
constexpr GeoPoint kSouthWest{-33.5, -70.25};

TEST(Xte, SaysToWhichSideToSteer) {
  EXPECT_EQ(body(encode(Xte{.off_track_nm = 0.25})), "$IIXTE,A,A,0.250,L,N,A");
  EXPECT_EQ(body(encode(Xte{.valid = false, .mode = 'N'})), "$IIXTE,V,V,,,N,N");
  EXPECT_EQ(decoded(encode(Xte{.off_track_nm = -0.25}), decode_xte).off_track_nm, -0.25);
  const Xte old = decoded("$GPXTE,V,V,10.1,L,N*6E", decode_xte);  // go-nmea
  EXPECT_EQ(old.off_track_nm, 10.1) << "she is to starboard and must steer left";
  EXPECT_FALSE(old.valid);
  const Xte simulated = decoded("$GPXTE,V,V,,,N,S*43", decode_xte);
  EXPECT_FALSE(simulated.off_track_nm);
  EXPECT_EQ(simulated.mode, 'S');
  EXPECT_FALSE(decoded(with_checksum("GPXTE,A,V,1,L,N"), decode_xte).valid);
  EXPECT_FALSE(decoded(with_checksum("GPXTE,A,A,1,L,K"), decode_xte).off_track_nm);
  for (const char* bad : {"GPXTE,x,V,,,N,S", "GPXTE,A,A,1,,N,A", "GPXTE,A,A,1,X,N,A",
                          "GPXTE,A,A,100,L,N,A", "GPXTE,A,A,-1,L,N,A", "GPXTE,A,A,1,L,N,X"}) {
    EXPECT_TRUE(is_refused(bad, decode_xte)) << bad;
  }
}

TEST(Apb, IsAsWrittenAndRead) {
  const Apb apb{.off_track_nm = -0.1,
                .arrival_circle_entered = true,
                .track_deg = 175.2,
                .waypoint = "TURN 3",
                .bearing_deg = 175.4,
                .heading_deg = 174.0};
  const std::string line = encode(apb);
  EXPECT_EQ(body(line), "$IIAPB,A,A,0.100,R,N,A,V,175.2,T,TURN 3,175.4,T,174.0,T,A");
  const Apb back = decoded(line, decode_apb);
  EXPECT_TRUE(back.valid);
  EXPECT_EQ(back.off_track_nm, -0.1);
  EXPECT_TRUE(back.arrival_circle_entered);
  EXPECT_FALSE(back.perpendicular_passed);
  EXPECT_EQ(back.track_deg, 175.2);
  EXPECT_EQ(back.waypoint, "TURN 3");
  EXPECT_EQ(back.bearing_deg, 175.4);
  EXPECT_EQ(back.heading_deg, 174.0);
  EXPECT_EQ(back.mode, 'A');
}

TEST(Apb, OfOtherEquipmentIsRead) {
  // go-nmea.
  const Apb magnetic = decoded("$GPAPB,A,A,0.10,R,N,V,V,011,M,DEST,011,M,011,M*3C", decode_apb);
  EXPECT_EQ(magnetic.off_track_nm, -0.1);
  EXPECT_EQ(magnetic.waypoint, "DEST");
  EXPECT_FALSE(magnetic.heading_deg) << "a magnetic heading is none";
  const Apb plotter =
      decoded("$ECAPB,A,A,0.0,L,M,V,V,175.2,T,Antechamber_Bay,175.2,T,175.2,T,V*32", decode_apb);
  EXPECT_EQ(plotter.heading_deg, 175.2);
  EXPECT_FALSE(plotter.off_track_nm) << "in an unknown unit";
  EXPECT_TRUE(is_refused("ECAPB,A,A,0.0,L,N,V,V,361,T,A,1,T,1,T,A", decode_apb));
  EXPECT_TRUE(is_refused("ECAPB,A,A,x.0,L,N,V,V,1,T,A,1,T,1,T,A", decode_apb));
}

TEST(Rmb, IsAsWrittenAndRead) {
  const Rmb rmb{.off_track_nm = 12.0,
                .origin = "START",
                .destination = "TURN 3",
                .position = kSouthWest,
                .range_nm = 1234.0,
                .bearing_deg = 52.5,
                .closing_kn = -0.5};
  const std::string line = encode(rmb);
  EXPECT_EQ(body(line), "$GPRMB,A,9.99,L,START,TURN 3,3330.000,S,07015.000,W,999.9,52.5,-0.5,V,A");
  const Rmb back = decoded(line, decode_rmb);
  EXPECT_EQ(back.origin, "START");
  EXPECT_EQ(back.destination, "TURN 3");
  EXPECT_EQ(back.position, kSouthWest);
  EXPECT_EQ(back.closing_kn, -0.5);
  EXPECT_EQ(body(encode(Rmb{.mode = 'S'})), "$GPRMB,V,,,,,,,,,,,,V,S") << "not valid";
}

TEST(Rmb, OfOtherEquipmentIsRead) {
  const Rmb old = decoded(  // go-nmea
      "$GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,001.3,052.5,000.5,V*20", decode_rmb);
  EXPECT_TRUE(old.valid);
  EXPECT_EQ(old.off_track_nm, 0.66);
  EXPECT_EQ(old.origin, "003");
  EXPECT_EQ(old.destination, "004");
  EXPECT_NEAR(old.position->longitude_deg, -123.1595, 1e-9);
  EXPECT_EQ(old.range_nm, 1.3);
  EXPECT_EQ(old.bearing_deg, 52.5);
  EXPECT_EQ(old.closing_kn, 0.5);
  EXPECT_FALSE(old.arrived);
  EXPECT_EQ(old.mode, 'A');
  EXPECT_EQ(
      decoded("$GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,001.3,052.5,000.5,V,D*48", decode_rmb)
          .mode,
      'D');
  for (const char* bad : {"GPRMB,x,0.66,L,003,004,4917.24,N,12309.57,W,1,52,0,V,D",
                          "GPRMB,A,0.66,x,003,004,4917.24,N,12309.57,W,1,52,0,V,D",
                          "GPRMB,A,0.66,L,003,004,4x17.24,N,12309.57,W,1,52,0,V,D",
                          "GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,-1,52,0,V,D",
                          "GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,1,361,0,V,D",
                          "GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,1,52,1000,V,D",
                          "GPRMB,A,0.66,L,003,004,4917.24,N,12309.57,W,1,52,0,x,D"}) {
    EXPECT_TRUE(is_refused(bad, decode_rmb)) << bad;
  }
}

TEST(Bwc, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Bwc{.time_of_day = kMorning,
                            .position = kSouthWest,
                            .bearing_deg = 213.8,
                            .range_nm = 4.6,
                            .waypoint = "EGLM"})),
            "$GPBWC,090807.06,3330.000,S,07015.000,W,213.8,T,,M,4.600,N,EGLM,A");
  const Bwc bwc = decoded(  // go-nmea
      "$GPBWC,220516,5130.02,N,00046.34,W,213.8,T,218.0,M,0004.6,N,EGLM*21", decode_bwc);
  EXPECT_EQ(bwc.time_of_day, 22h + 5min + 16s);
  EXPECT_EQ(bwc.bearing_deg, 213.8);
  EXPECT_EQ(bwc.range_nm, 4.6);
  EXPECT_EQ(bwc.waypoint, "EGLM");
  const Bwc none = decoded("$GPBWC,081837,,,,,,T,,M,,N,*13", decode_bwc);
  EXPECT_FALSE(none.position);
  EXPECT_FALSE(none.range_nm);
  EXPECT_TRUE(is_refused("GPBWC,2x0516,5130.02,N,00046.34,W,213.8,T,,M,4,N,A", decode_bwc));
}

TEST(Bod, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Bod{.bearing_deg = 97.0, .destination = "B", .origin = "A"})),
            "$GPBOD,97.0,T,,M,B,A");
  const Bod bod = decoded("$GPBOD,097.0,T,103.2,M,POINTB,POINTA*4A", decode_bod);  // go-nmea
  EXPECT_EQ(bod.bearing_deg, 97.0);
  EXPECT_EQ(bod.destination, "POINTB");
  EXPECT_EQ(bod.origin, "POINTA");
  EXPECT_EQ(decoded("$GPBOD,099.3,T,105.6,M,POINTB*64", decode_bod).origin, "");
  EXPECT_TRUE(is_refused("GPBOD,-1,T,,M,B,A", decode_bod));
}

TEST(Gns, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Gns{.time_of_day = kMorning,
                            .position = kSouthWest,
                            .modes = "AAN",
                            .dilution = 0.6,
                            .altitude_m = 25.63,
                            .geoid_m = -11.2})),
            "$GNGNS,090807.06,3330.00000,S,07015.00000,W,AAN,12,0.6,25.6,-11.2,,,V");
  const Gns gns = decoded(  // go-nmea
      "$GNGNS,014035.00,4332.69262,S,17235.48549,E,RR,13,0.9,25.63,11.24,,*70", decode_gns);
  EXPECT_EQ(gns.modes, "RR");
  EXPECT_EQ(gns.satellites, 13u);
  EXPECT_EQ(gns.dilution, 0.9);
  EXPECT_EQ(gns.altitude_m, 25.63);
  EXPECT_EQ(gns.geoid_m, 11.24);
  EXPECT_EQ(gns.navigation_status, 'V');
  EXPECT_TRUE(is_refused("GNGNS,094821.0,,,,,AAX,14,0.6,161.5,48.0,,", decode_gns));
  EXPECT_TRUE(is_refused("GNGNS,094821.0,,,,,AAAAAAA,14,0.6,161.5,48.0,,", decode_gns));
  EXPECT_TRUE(is_refused("GNGNS,094821.0,,,,,A,100,0.6,161.5,48.0,,", decode_gns));
}

TEST(Dtm, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Dtm{})), "$GPDTM,W84,,0.0000,N,0.0000,E,0.0,W84");
  EXPECT_EQ(decoded("$GPDTM,W84,,0.0,N,0.0,E,0.0,W84*6F", decode_dtm).local, "W84");  // go-nmea
  const Dtm dtm = decoded("$GPDTM,W84,X,00.1200,S,12.0000,W,100,W84*27", decode_dtm);
  EXPECT_EQ(dtm.subdivision, 'X');
  EXPECT_EQ(dtm.north_min, -0.12);
  EXPECT_EQ(dtm.east_min, -12.0);
  EXPECT_EQ(dtm.up_m, 100.0);
  EXPECT_EQ(dtm.reference, "W84");
  EXPECT_TRUE(is_refused("GPDTM,W84,,x,N,0.0,E,0.0,W84", decode_dtm));
  EXPECT_TRUE(is_refused("GPDTM,WGS84,,0,N,0.0,E,0.0,W84", decode_dtm));
}

TEST(GllWritten, IsAsWrittenAndRead) {
  const std::string line = encode(Gll{.position = kSouthWest, .time_of_day = kMorning});
  EXPECT_EQ(body(line), "$GPGLL,3330.00000,S,07015.00000,W,090807.06,A,A");
  EXPECT_EQ(decoded(line, decode_gll).position, kSouthWest);
  EXPECT_EQ(body(encode(Gll{.mode = 'N'})), "$GPGLL,,,,,,V,N");
  const Gll gll = decoded("$GPGLL,3926.7952,N,12000.5947,W,022732,A,A*58", decode_gll);  // go-nmea
  EXPECT_EQ(gll.time_of_day, 2h + 27min + 32s);
  EXPECT_TRUE(gll.valid);
}

}  // namespace
}  // namespace skerry::nmea
