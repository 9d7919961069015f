// Each sentence as it must read, letter by letter, and read back.
#include <gtest/gtest.h>

#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

using namespace std::chrono_literals;

// 2026-11-21 09:08:07.060.
constexpr UtcTime kUtc{Duration(1'795'252'087'060'000'000)};
constexpr GeoPoint kBergen{60.39, 5.32};

TEST(Rmc, HasTheDateAsDdmmyy) {
  const std::string line =
      encode(Rmc{.utc = kUtc, .position = kBergen, .speed_kn = 12.34, .course_deg = 270.06});
  EXPECT_EQ(body(line), "$GPRMC,090807.06,A,6023.40000,N,00519.20000,E,12.34,270.1,211126,,,A,V");
  const Rmc rmc = decoded(line, decode_rmc);
  EXPECT_EQ(rmc.utc, kUtc);
  EXPECT_NEAR(rmc.position->latitude_deg, 60.39, 1e-7);
  EXPECT_EQ(rmc.speed_kn, 12.34);
  EXPECT_EQ(rmc.course_deg, 270.1);
  EXPECT_TRUE(rmc.valid);
}

TEST(Rmc, SimulatedIsNotValidAsTheStandardWants) {
  const std::string line = encode(Rmc{.utc = kUtc, .position = kBergen, .mode = 'S'});
  EXPECT_EQ(body(line), "$GPRMC,090807.06,V,6023.40000,N,00519.20000,E,,,211126,,,S,V");
  EXPECT_FALSE(decoded(line, decode_rmc).valid);
}

TEST(Rmc, OfOlderEquipmentIsRead) {
  const Rmc rmc =
      decoded("$GPRMC,092204.999,A,4250.5589,S,14718.5084,E,5.50,89.68,211200,,*25", decode_rmc);
  EXPECT_TRUE(rmc.valid);
  EXPECT_NEAR(rmc.position->latitude_deg, -42.842648333, 1e-8);
  EXPECT_NEAR(rmc.position->longitude_deg, 147.30847333, 1e-8);
  EXPECT_EQ(rmc.utc, UtcTime(Duration(977'390'524'999'000'000)));
  EXPECT_THROW(decoded(with_checksum("GPRMC,092204,A,,,,,1,1,20261121,,"), decode_rmc),
               std::runtime_error)
      << "a date as yyyymmdd";
  EXPECT_THROW(decoded(with_checksum("GPRMC,092204,A,,,,,1,1,310226,,"), decode_rmc),
               std::runtime_error)
      << "a 31st of February";
  EXPECT_FALSE(decoded(with_checksum("GPRMC,092204,A,,,,,,,,,,N"), decode_rmc).valid);
}

TEST(Gga, IsAsWritten) {
  const std::string line = encode(Gga{.time_of_day = time_of_day(kUtc), .position = kBergen});
  EXPECT_EQ(body(line), "$GPGGA,090807.06,6023.40000,N,00519.20000,E,1,12,0.8,0.0,M,0.0,M,,");
  const Gga gga = decoded(line, decode_gga);
  EXPECT_EQ(gga.quality, 1u);
  EXPECT_EQ(gga.time_of_day, 9h + 8min + 7s + 60ms);
  const Gga published =
      decoded("$GPGGA,123519,4807.038,N,01131.000,E,1,08,0.9,545.4,M,46.9,M,,*47", decode_gga);
  EXPECT_EQ(published.altitude_m, 545.4);
  EXPECT_EQ(published.satellites, 8u);
}

TEST(Gll, IsRead) {
  const Gll gll = decoded(with_checksum("GPGLL,4916.45,N,12311.12,W,225444,A"), decode_gll);
  EXPECT_NEAR(gll.position->longitude_deg, -123.18533333, 1e-8);
  EXPECT_TRUE(gll.valid);
  EXPECT_FALSE(decoded(with_checksum("GPGLL,4916.45,N,12311.12,W,225444,V"), decode_gll).valid);
}

// As a device sent it that leaves out leading zeros.
TEST(Gll, WithoutLeadingZerosIsReadWhereItCanMeanOneThingOnly) {
  const Gll gll = decoded(with_checksum("GPGLL,5154.1234,N,516.0606,E,225444,A"), decode_gll);
  EXPECT_NEAR(gll.position->latitude_deg, 51.902056667, 1e-8);
  EXPECT_NEAR(gll.position->longitude_deg, 5.267676667, 1e-8);
  const Gll near = decoded(with_checksum("GPGLL,016.5,S,4516.0606,W,225444,A"), decode_gll);
  EXPECT_NEAR(near.position->latitude_deg, -0.275, 1e-9);
  EXPECT_NEAR(near.position->longitude_deg, -45.267676667, 1e-8);
  for (const char* body : {"GPGLL,5154.1234,N,16.0606,E,225444,A",      // no degrees, or no minutes
                           "GPGLL,5154.1234,N,561.0606,E,225444,A",     // 61 minutes
                           "GPGLL,5154.1234,N,1005160.606,E,225444,A",  // too many digits
                           "GPGLL,05154.1234,N,00516.06,E,225444,A"}) {
    EXPECT_THROW(decoded(with_checksum(body), decode_gll), std::runtime_error) << body;
  }
}

TEST(Vtg, IsAsWritten) {
  const std::string line = encode(Vtg{.course_deg = 5.0, .speed_kn = 10.0});
  EXPECT_EQ(body(line), "$GPVTG,5.0,T,,M,10.00,N,18.52,K,A");
  const Vtg vtg = decoded(line, decode_vtg);
  EXPECT_EQ(vtg.course_deg, 5.0);
  EXPECT_EQ(vtg.speed_kn, 10.0);
  EXPECT_FALSE(decoded(with_checksum("GPVTG,5.0,M,,,10.0,K"), decode_vtg).course_deg)
      << "a magnetic course is none";
}

TEST(Zda, IsAsWritten) {
  const std::string line = encode(Zda{.utc = kUtc});
  EXPECT_EQ(body(line), "$GPZDA,090807.06,21,11,2026,00,00");
  EXPECT_EQ(decoded(line, decode_zda).utc, kUtc);
  EXPECT_THROW(decoded(with_checksum("GPZDA,090807,30,02,2026,00,00"), decode_zda),
               std::runtime_error);
}

TEST(Heading, IsAsWritten) {
  EXPECT_EQ(body(encode(Hdt{.heading_deg = 359.996})), "$HEHDT,0.00,T");
  EXPECT_EQ(body(encode(Hdt{})), "$HEHDT,,T");
  EXPECT_EQ(decoded("$HEHDT,123.4,T*2B", decode_hdt).heading_deg, 123.4);
  EXPECT_EQ(body(encode(Ths{.heading_deg = 77.123, .mode = 'S'})), "$HETHS,77.12,S");
  const Ths ths = decoded(with_checksum("HETHS,77.1,V"), decode_ths);
  EXPECT_EQ(ths.mode, 'V');
  EXPECT_THROW(decoded(with_checksum("HEHDT,361.0,T"), decode_hdt), std::runtime_error);
}

TEST(Rot, IsPositiveToStarboard) {
  const std::string line = encode(Rot{.rate_deg_min = -12.34});
  EXPECT_EQ(body(line), "$TIROT,-12.3,A");
  EXPECT_EQ(decoded(line, decode_rot).rate_deg_min, -12.3);
  EXPECT_FALSE(decoded(with_checksum("TIROT,5.0,V"), decode_rot).valid);
}

TEST(Log, IsAsWritten) {
  const std::string vhw = encode(Vhw{.heading_deg = 90.0, .speed_kn = 5.0});
  EXPECT_EQ(body(vhw), "$VWVHW,90.00,T,,M,5.00,N,9.26,K");
  EXPECT_EQ(decoded(vhw, decode_vhw).speed_kn, 5.0);
  const std::string vbw = encode(Vbw{.water_ahead_kn = -1.5,
                                     .water_starboard_kn = 0.25,
                                     .ground_ahead_kn = 2.0,
                                     .ground_starboard_kn = -0.004});
  EXPECT_EQ(body(vbw), "$VDVBW,-1.50,0.25,A,2.00,0.00,A,,V,,V");
  EXPECT_EQ(decoded(vbw, decode_vbw).water_ahead_kn, -1.5);
  EXPECT_EQ(body(encode(Vbw{})), "$VDVBW,,,V,,,V,,V,,V");
  EXPECT_FALSE(decoded(with_checksum("VDVBW,1.0,2.0,V,3.0,4.0,A"), decode_vbw).water_ahead_kn);
}

}  // namespace
}  // namespace skerry::nmea
