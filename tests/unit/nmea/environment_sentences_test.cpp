// Depth, wind, log, compass and roll: letter by letter, back, and as other equipment says them.
#include <gtest/gtest.h>

#include <limits>

#include "protocol/nmea/depth_sentences.hpp"
#include "protocol/nmea/log_sentences.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/transducer_sentences.hpp"
#include "protocol/nmea/wind_sentences.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

TEST(Dpt, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Dpt{.depth_m = 12.34, .offset_m = -1.5, .range_m = 100.0})),
            "$SDDPT,12.3,-1.5,100.0");
  EXPECT_EQ(body(encode(Dpt{.depth_m = -1.0})), "$SDDPT,,,");
  const Dpt noaa = decoded("$SDDPT,0006.29,002.40*6C", decode_dpt);  // NOAA, as archived
  EXPECT_EQ(noaa.depth_m, 6.29);
  EXPECT_EQ(noaa.offset_m, 2.4);
  EXPECT_FALSE(noaa.range_m);
  EXPECT_EQ(decoded("$SDDPT,0.5,0.5,0.1*54", decode_dpt).range_m, 0.1);  // go-nmea
  for (const char* bad : {"SDDPT,-1,0,0", "SDDPT,12001,0,0", "SDDPT,1,101,0", "SDDPT,1.2.3,0,0"}) {
    EXPECT_TRUE(is_refused(bad, decode_dpt)) << bad;
  }
}

TEST(Dbt, IsAsWrittenAndReadInAnyOfItsUnits) {
  EXPECT_EQ(body(encode(Dbt{10.0})), "$SDDBT,32.8,f,10.0,M,5.5,F");
  EXPECT_EQ(body(encode(Dbt{})), "$SDDBT,,f,,M,,F");
  EXPECT_EQ(decoded("$IIDBT,032.93,f,010.04,M,005.42,F*2C", decode_dbt).depth_m, 10.04);
  EXPECT_NEAR(*decoded(with_checksum("IIDBT,032.93,f,,M,,F"), decode_dbt).depth_m, 10.037, 1e-3);
  EXPECT_NEAR(*decoded(with_checksum("IIDBT,,f,,M,5.42,F"), decode_dbt).depth_m, 9.912, 1e-3);
  EXPECT_FALSE(decoded(with_checksum("IIDBT,,f,10,F,,F"), decode_dbt).depth_m) << "no metres";
  EXPECT_TRUE(is_refused("SDDBT,,f,12002,M,,F", decode_dbt));
}

TEST(Mwv, IsAsWrittenAndReadInAnyOfItsUnits) {
  EXPECT_EQ(body(encode(Mwv{.angle_deg = 359.96, .speed_kn = 12.34})), "$WIMWV,0.0,R,12.3,N,A");
  EXPECT_EQ(body(encode(Mwv{.reference = WindReference::theoretical})), "$WIMWV,,T,,N,V");
  const Mwv theoretical = decoded("$WIMWV,12.1,T,10.1,N,A*27", decode_mwv);  // go-nmea
  EXPECT_EQ(theoretical.reference, WindReference::theoretical);
  EXPECT_EQ(theoretical.angle_deg, 12.1);
  EXPECT_EQ(theoretical.speed_kn, 10.1);
  EXPECT_FALSE(decoded("$WIMWV,,T,,N,V*32", decode_mwv).angle_deg);
  const auto knots = [](const char* between) {
    return *decoded(with_checksum(between), decode_mwv).speed_kn;
  };
  EXPECT_NEAR(knots("WIMWV,252.0,R,12.8,M,A"), 24.881, 1e-3);
  EXPECT_NEAR(knots("WIMWV,252.0,R,18.52,K,A"), 10.0, 1e-9);
  EXPECT_NEAR(knots("WIMWV,252.0,R,11.5078,S,A"), 10.0, 1e-3);
  EXPECT_EQ(decoded("$WIMWV,252.0,R,12.8,M,A*1E", decode_mwv).angle_deg, 252.0);  // a ship's log
  for (const char* bad :
       {"WIMWV,361,R,1,N,A", "WIMWV,1,X,1,N,A", "WIMWV,1,,1,N,A", "WIMWV,1,R,1,X,A",
        "WIMWV,1,R,1,,A", "WIMWV,1,R,401,N,A", "WIMWV,1,R,-1,N,A", "WIMWV,1,R,1,N,Q"}) {
    EXPECT_TRUE(is_refused(bad, decode_mwv)) << bad;
  }
}

TEST(Mwd, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Mwd{.from_deg = 10.1, .speed_kn = 12.0})), "$WIMWD,10.1,T,,M,12.0,N,6.2,M");
  EXPECT_EQ(body(encode(Mwd{})), "$WIMWD,,T,,M,,N,,M");
  const Mwd mwd = decoded("$WIMWD,10.1,T,10.1,M,12,N,40,M*5D", decode_mwd);  // go-nmea
  EXPECT_EQ(mwd.from_deg, 10.1);
  EXPECT_EQ(mwd.speed_kn, 12.0);
  EXPECT_FALSE(decoded("$WIMWD,,,,,,,,*40", decode_mwd).speed_kn);
  EXPECT_NEAR(*decoded(with_checksum("WIMWD,,T,,M,,N,10,M"), decode_mwd).speed_kn, 19.438, 1e-3);
  EXPECT_TRUE(is_refused("WIMWD,1,T,,M,1,K,,M", decode_mwd));
}

TEST(Vlw, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Vlw{.water_total_nm = 1234.5, .ground_trip_nm = 0.1})),
            "$VDVLW,1234.500,N,,N,,N,0.100,N");
  const Vlw old = decoded("$IIVLW,10.1,N,3.2,N*7C", decode_vlw);  // go-nmea
  EXPECT_EQ(old.water_total_nm, 10.1);
  EXPECT_EQ(old.water_trip_nm, 3.2);
  EXPECT_FALSE(old.ground_total_nm);
  const Vlw both = decoded("$IIVLW,10.1,N,3.2,N,1,N,0.1,N*62", decode_vlw);
  EXPECT_EQ(both.ground_total_nm, 1.0);
  EXPECT_EQ(both.ground_trip_nm, 0.1);
  EXPECT_TRUE(is_refused("VDVLW,-1,N,,N", decode_vlw));
  EXPECT_TRUE(is_refused("VDVLW,1000000,N,,N", decode_vlw));
}

TEST(Vdr, IsAsWrittenAndRead) {
  EXPECT_EQ(body(encode(Vdr{.set_deg = -10.0, .drift_kn = 1.2})), "$IIVDR,350.0,T,,M,1.20,N");
  const Vdr vdr = decoded("$IIVDR,10.1,T,12.3,M,1.2,N*3A", decode_vdr);  // go-nmea
  EXPECT_EQ(vdr.set_deg, 10.1);
  EXPECT_EQ(vdr.drift_kn, 1.2);
  EXPECT_TRUE(is_refused("IIVDR,10.1,T,,M,101,N", decode_vdr));
}

TEST(Hdg, IsPositiveToTheEast) {
  EXPECT_EQ(body(encode(Hdg{.sensor_deg = 98.3, .deviation_deg = 0.1, .variation_deg = -12.6})),
            "$HCHDG,98.3,0.1,E,12.6,W");
  EXPECT_EQ(body(encode(Hdg{.sensor_deg = 5.0})), "$HCHDG,5.0,,,,");
  const Hdg hdg = decoded("$HCHDG,98.3,0.1,E,12.6,W*56", decode_hdg);  // go-nmea
  EXPECT_EQ(hdg.sensor_deg, 98.3);
  EXPECT_EQ(hdg.deviation_deg, 0.1);
  EXPECT_EQ(hdg.variation_deg, -12.6);
  for (const char* bad : {"HCHDG,361,,,,", "HCHDG,1,1,,,", "HCHDG,1,1,N,,", "HCHDG,1,,,181,E"}) {
    EXPECT_TRUE(is_refused(bad, decode_hdg)) << bad;
  }
}

TEST(VbwStern, IsWrittenAndRead) {
  const std::string line = encode(Vbw{.ground_ahead_kn = 0.5, .ground_stern_starboard_kn = -0.25});
  EXPECT_EQ(body(line), "$VDVBW,,,V,0.50,,A,,V,-0.25,A");
  const Vbw back = decoded(line, decode_vbw);
  EXPECT_EQ(back.ground_stern_starboard_kn, -0.25);
  EXPECT_FALSE(back.water_stern_starboard_kn);
  EXPECT_FALSE(back.ground_starboard_kn) << "what is not known is not zero";
  const Vbw log = decoded("$VDVBW,016.98,,A,018.50,-000.28,A,,V,-000.20,A*44", decode_vbw);
  EXPECT_EQ(log.water_ahead_kn, 16.98);
  EXPECT_EQ(log.ground_starboard_kn, -0.28);
  EXPECT_EQ(log.ground_stern_starboard_kn, -0.2);
}

TEST(Xdr, RollIsPositiveToStarboard) {
  const auto lines = encode_xdr(std::vector{roll_transducer(-5.25)});
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_EQ(body(lines[0]), "$IIXDR,A,-5.25,D,ROLL");
  const auto back = decoded(lines[0], decode_xdr);
  ASSERT_EQ(back.size(), 1u);
  EXPECT_EQ(back[0].value, -5.25);
  EXPECT_EQ(back[0].name, "ROLL");
}

TEST(Xdr, OfOtherEquipmentIsRead) {
  const auto five = decoded(  // go-nmea
      "$HCXDR,A,171,D,PITCH,A,-37,D,ROLL,G,367,,MAGX,G,2420,,MAGY,G,-8984,,MAGZ*41", decode_xdr);
  ASSERT_EQ(five.size(), 5u);
  EXPECT_EQ(five[1].type, 'A');
  EXPECT_EQ(five[1].value, -37.0);
  EXPECT_EQ(five[1].unit, 'D');
  EXPECT_EQ(five[4].unit, '\0');
  EXPECT_EQ(five[4].name, "MAGZ");
  for (const char* bad : {"IIXDR", "IIXDR,A,1,D", "IIXDR,A,1,D,ROLL,", "IIXDR,AB,1,D,ROLL",
                          "IIXDR,A,x,D,ROLL", "IIXDR,A,1,DD,ROLL"}) {
    EXPECT_TRUE(is_refused(bad, decode_xdr)) << bad;
  }
}

TEST(Xdr, ManyFillAsManySentencesAsNeeded) {
  std::vector<Transducer> many(20, {.type = 'G', .value = -99'999'999.99, .unit = 'D'});
  for (std::size_t i = 0; i < many.size(); ++i)
    many[i].name = "A NAME THAT IS LONG " + std::to_string(i);
  std::size_t read = 0;
  for (const std::string& line : encode_xdr(many)) {
    EXPECT_LE(line.size(), kMaxSentence) << line;
    for (const Transducer& one : decoded(line, decode_xdr)) {
      EXPECT_EQ(one.value, -99'999'999.99);
      EXPECT_EQ(one.name, "A NAME THAT IS ");
      ++read;
    }
  }
  EXPECT_EQ(read, many.size());
  EXPECT_TRUE(encode_xdr({}).empty());
}

}  // namespace
}  // namespace skerry::nmea
