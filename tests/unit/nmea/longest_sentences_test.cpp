// However large the values, however long the names: a sentence has at most 82 characters, and can
// be read.
#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "protocol/nmea/depth_sentences.hpp"
#include "protocol/nmea/engine_sentences.hpp"
#include "protocol/nmea/gnss_sentences.hpp"
#include "protocol/nmea/heading_control_sentences.hpp"
#include "protocol/nmea/log_sentences.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/rudder_sentences.hpp"
#include "protocol/nmea/thruster_sentences.hpp"
#include "protocol/nmea/track_sentences.hpp"
#include "protocol/nmea/transducer_sentences.hpp"
#include "protocol/nmea/waypoint_sentences.hpp"
#include "protocol/nmea/wind_sentences.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"

namespace skerry::nmea {
namespace {

using namespace std::chrono_literals;

constexpr double kInfinite = std::numeric_limits<double>::infinity();
// Of every order of magnitude that a field may have, at both sides of its ends, and beyond.
constexpr double kAmounts[] = {
    0.0,      0.0499,   0.5,       9.994,      9.996,      59.9999, 90.0,         99.999, 100.0,
    179.96,   180.0,    359.96,    360.0,      400.0,      999.9,   999.96,       1000.0, 9999.9,
    9999.96,  10'000.0, 12'000.0,  99'999.9,   99'999.999, 1e6 - 1, 999'999.9996, 1e6,    1e8,
    1e15 + 1, 1.0e300,  kInfinite, 0.1 + 1e-9, 12.3456789, 1e-300};
const std::string kLongName = "THE LIGHT VESSEL AT THE END OF THE NARROW CHANNEL*,$ AND BEYOND";

// The longest line of each kind.
class LongestSentence : public testing::Test {
 protected:
  template <typename Value, typename Decode>
  void check(const Value& value, Decode decode) {
    check_line(encode(value), decode);
  }

  template <typename Decode>
  void check_line(const std::string& line, Decode decode) {
    ASSERT_LE(line.size(), kMaxSentence) << line;
    const auto sentence = parse_sentence(line);
    ASSERT_TRUE(sentence) << line << sentence.error().text;
    const auto back = decode(*sentence);
    ASSERT_TRUE(back) << line << back.error().text;
    longest_ = std::max(longest_, line.size());
  }

  void TearDown() override { std::printf("the longest has %zu characters\n", longest_); }

 private:
  std::size_t longest_ = 0;
};

// Each amount, its negative, and not a number.
template <typename Check>
void for_each_amount(Check check) {
  for (const double amount : kAmounts) {
    check(amount);
    check(-amount);
  }
  check(std::numeric_limits<double>::quiet_NaN());
}

TEST_F(LongestSentence, OfRudderEnginesAndThrusters) {
  for_each_amount([&](double x) {
    check(Rsa{x, -x}, decode_rsa);
    check(Ror{x, -x}, decode_ror);
    check(Rpm{RevolutionSource::engine, 4'000'000'000u, x, -x}, decode_rpm);
    for (const bool in_percent : {true, false}) {
      const Demand demand{x, in_percent};
      check(Prc{x, demand, demand, CommandPlace::wing, 4'000'000'000u}, decode_prc);
      check(Trc{4'000'000'000u, demand, demand, x}, decode_trc);
      check(Trd{0, demand, demand, x}, decode_trd);
    }
  });
  check(Etl{24h - 10ms, false, EngineOrder::crash_astern, SubTelegraph::finished,
            CommandPlace::local, 4'000'000'000u},
        decode_etl);
}

TEST_F(LongestSentence, OfHeadingControllers) {
  for_each_amount([&](double x) {
    const SteeringFields fields{.is_overridden = true,
                                .rudder_deg = x,
                                .steering = SelectedSteering::track,
                                .turn = TurnMode::radius,
                                .rudder_limit_deg = x,
                                .off_heading_limit_deg = x,
                                .turn_radius_nm = x,
                                .turn_rate_deg_min = x,
                                .heading_deg = x,
                                .off_track_limit_nm = x,
                                .track_deg = x};
    check(Htc{fields}, decode_htc);
    check(Htd{fields, true, false, true, x}, decode_htd);
    check(Hsc{x, x}, decode_hsc);
  });
  // Each field as long as it may be, which no one amount makes them.
  const SteeringFields longest{.rudder_deg = -90.0,
                               .steering = SelectedSteering::main,
                               .turn = TurnMode::rate,
                               .rudder_limit_deg = 90.0,
                               .off_heading_limit_deg = 180.0,
                               .turn_radius_nm = 99.999,
                               .turn_rate_deg_min = 999.9,
                               .heading_deg = 359.9,
                               .off_track_limit_nm = 99.999,
                               .track_deg = 359.9};
  check(Htc{longest}, decode_htc);
  check(Htd{longest, true, true, true, 359.9}, decode_htd);
}

TEST_F(LongestSentence, OfLogDepthWindAndCompass) {
  for_each_amount([&](double x) {
    check(Vlw{x, x, x, x}, decode_vlw);
    check(Vdr{x, x}, decode_vdr);
    check(Dpt{x, -x, x}, decode_dpt);
    check(Dbt{x}, decode_dbt);
    check(Mwv{x, WindReference::relative, x}, decode_mwv);
    check(Mwd{x, x}, decode_mwd);
    check(Hdg{x, x, -x}, decode_hdg);
    check(Hdt{x}, decode_hdt);
    check(Ths{x}, decode_ths);
    check(Rot{x}, decode_rot);
    check(Vhw{x, x}, decode_vhw);
    check(Vbw{x, -x, x, -x, x, -x}, decode_vbw);
    const Transducer one{'A', x, 'D', kLongName};
    for (const std::string& line : encode_xdr(std::vector(7, one))) check_line(line, decode_xdr);
  });
}

TEST_F(LongestSentence, OfPositionsAndTracks) {
  // No more minutes than these: 8959.99999 and 17959.99999.
  constexpr GeoPoint kFar{-89.9999999, -179.9999999};
  constexpr Duration kLate = 24h - 10ms;
  const UtcTime utc{Duration(1'795'305'599'990'000'000)};  // 2026-11-21 23:59:59.990
  for_each_amount([&](double x) {
    check(Rmc{.utc = utc, .position = kFar, .speed_kn = x, .course_deg = x}, decode_rmc);
    check(Gga{kLate, kFar, 4'000'000'000u, 4'000'000'000u, x, x}, decode_gga);
    check(Vtg{x, x}, decode_vtg);
    check(Gns{.time_of_day = kLate,
              .position = kFar,
              .modes = "AAAAAAAAAA",
              .satellites = 4'000'000'000u,
              .dilution = x,
              .altitude_m = x,
              .geoid_m = x},
          decode_gns);
    check(Dtm{kLongName, 'X', x, x, x, kLongName}, decode_dtm);
    check(Xte{.off_track_nm = x}, decode_xte);
    check(Apb{.off_track_nm = x,
              .track_deg = x,
              .waypoint = kLongName,
              .bearing_deg = x,
              .heading_deg = x},
          decode_apb);
    check(Rmb{.off_track_nm = x,
              .origin = kLongName,
              .destination = kLongName,
              .position = kFar,
              .range_nm = x,
              .bearing_deg = x,
              .closing_kn = x},
          decode_rmb);
    check(Bwc{kLate, kFar, x, x, kLongName}, decode_bwc);
    check(Bod{x, kLongName, kLongName}, decode_bod);
    check(Gll{.position = GeoPoint{x, x}, .time_of_day = kLate}, decode_gll);
    check(Zda{.utc = utc}, decode_zda);
  });
  check(Gns{.time_of_day = kLate,
            .position = kFar,
            .modes = "AAAAAA",
            .satellites = 99,
            .dilution = 99.9,
            .altitude_m = 99'999.9,
            .geoid_m = -999.9},
        decode_gns);
}

TEST(LongestRmb, HasRoomForBothNames) {
  const std::string line = encode(Rmb{.off_track_nm = -9.99,
                                      .origin = "EASTERN ENTRANCE",
                                      .destination = "INNER HARBOUR",
                                      .position = GeoPoint{-60.5, 170.5},
                                      .range_nm = 999.9,
                                      .bearing_deg = 359.9,
                                      .closing_kn = -999.9});
  EXPECT_EQ(body(line),
            "$GPRMB,A,9.99,R,EASTERN,INNER H,6030.000,S,17030.000,E,999.9,359.9,-999.9,V,A");
  EXPECT_EQ(line.size(), kMaxSentence);
}

}  // namespace
}  // namespace skerry::nmea
