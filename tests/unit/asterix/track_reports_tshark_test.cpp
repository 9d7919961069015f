// An independent decoder's opinion of CAT048, CAT062 and CAT010: Wireshark's.
#include <cmath>
#include <map>
#include <sstream>

#include "tests/unit/asterix/track_reports.hpp"
#include "tests/unit/asterix/tshark.hpp"

namespace skerry {
namespace {

using namespace std::chrono_literals;

class ReportTshark : public Cat240Tshark {
 protected:
  // What tshark reads of the only record of a datagram: each field's number, by its name without
  // "asterix.".
  template <typename Report>
  void read(const Report& report, const std::map<std::string, double>& expected) {
    {
      Capture file(capture());
      for (const Bytes& datagram : encoded(std::span(&report, 1), kAsterixDatagram)) {
        file.add(datagram);
      }
    }
    EXPECT_EQ(tshark("-Y '!asterix or _ws.malformed or _ws.expert.severity >= warning'"), "");
    std::string arguments = "-T fields -E separator='|'";
    for (const auto& [name, value] : expected) arguments += " -e asterix." + name;
    std::string line = tshark(arguments);
    line.pop_back();
    std::istringstream in(line + '|');
    for (const auto& [name, value] : expected) {
      std::string text;
      std::getline(in, text, '|');
      ASSERT_FALSE(text.empty()) << name << " is not there";
      EXPECT_NEAR(std::stod(text), value, 1e-6 * std::max(1.0, std::abs(value))) << name;
    }
  }
};

// Values tshark has in nautical miles.
double nm(double metres) { return metres / kNauticalMile; }

TEST_F(ReportTshark, ReadsCat048AtBothEnds) {
  for (const bool most : {false, true}) {
    const Cat048Report r = full_cat048(most);
    read(r, {{"048_010_SAC", 25},
             {"048_010_SIC", 7},
             {"048_140_VALUE", in_seconds(*r.time_of_day)},
             {"048_020_TYP", most ? 7 : 0},
             {"048_020_SIM", most},
             {"048_040_RHO", nm(r.measured->range_m)},
             {"048_040_THETA", r.measured->bearing_deg},
             {"048_130_PRL_VALUE", *r.run_length_deg},
             {"048_130_PAM_VALUE", *r.amplitude_dbm},
             {"048_161_TRN", *r.track_number},
             {"048_042_X", nm(r.position->east_m)},
             {"048_042_Y", nm(r.position->north_m)},
             {"048_200_GSP", nm(r.velocity->speed_mps)},
             {"048_200_HDG", r.velocity->course_deg},
             {"048_170_CNF", most},
             {"048_170_RAD", most ? 3 : 0},
             {"048_170_DOU", most},
             {"048_170_MAH", most},
             {"048_170_CDM", 0},
             {"048_210_SIGX", nm(r.quality->east_m)},
             {"048_210_SIGY", nm(r.quality->north_m)},
             {"048_210_SIGV", nm(r.quality->speed_mps)},
             {"048_210_SIGH", r.quality->course_deg}});
  }
  read(full_cat048(true), {{"048_020_TST", 1}, {"048_170_TRE", 1}, {"048_170_GHO", 1}});
}

TEST_F(ReportTshark, ReadsCat062AtBothEnds) {
  for (const bool most : {false, true}) {
    const Cat062Report r = full_cat062(most);
    read(r, {{"062_010_SAC", 25},
             {"062_010_SIC", 8},
             {"062_015_VALUE", *r.service},
             {"062_070_VALUE", in_seconds(*r.time_of_day)},
             {"062_105_LAT", r.place->latitude_deg},
             {"062_105_LON", r.place->longitude_deg},
             {"062_100_X", r.position->east_m},
             {"062_100_Y", r.position->north_m},
             {"062_185_VX", r.velocity->east},
             {"062_185_VY", r.velocity->north},
             {"062_210_AX", r.acceleration->east},
             {"062_210_AY", r.acceleration->north},
             {"062_040_VALUE", r.track_number},
             {"062_080_MON", most},
             {"062_080_CNF", most},
             {"062_290_TRK_VALUE", *r.track_age_s},
             {"062_290_PSR_VALUE", *r.primary_age_s},
             {"062_200_TRANS", most ? 3 : 0},
             {"062_200_LONG", most ? 3 : 0},
             {"062_270_LENGTH", r.size->length_m},
             {"062_270_ORIENTATION", *r.size->orientation_deg},
             {"062_270_WIDTH", *r.size->width_m},
             {"062_500_APC_X", r.position_deviation->east},
             {"062_500_APC_Y", r.position_deviation->north},
             {"062_500_COV_VALUE", *r.position_covariance_m},
             {"062_500_ATV_X", r.velocity_deviation->east},
             {"062_500_ATV_Y", r.velocity_deviation->north}});
  }
  read(full_cat062(true), {{"062_080_SIM", 1},
                           {"062_080_TSE", 1},
                           {"062_080_TSB", 1},
                           {"062_080_FPC", 0},
                           {"062_080_AMA", 1},
                           {"062_080_CST", 1},
                           {"062_080_PSR", 0}});
}

// Wireshark 4.0 has 1/16 for the unit of 202 and 210, which is 1/4 (cat010.hpp).
constexpr double kItsUnit = 4.0;

TEST_F(ReportTshark, ReadsCat010AtBothEnds) {
  for (const bool most : {false, true}) {
    const Cat010Report r = full_cat010(most);
    read(r, {{"010_010_SAC", 25},
             {"010_010_SIC", 9},
             {"010_000_VALUE", 1},
             {"010_020_TYP", most ? 7 : 0},
             {"010_140_VALUE", in_seconds(*r.time_of_day)},
             {"010_041_LAT", r.place->latitude_deg},
             {"010_041_LON", r.place->longitude_deg},
             {"010_040_RHO", r.measured->range_m},
             {"010_040_TH", r.measured->bearing_deg},
             {"010_042_X", r.position->east_m},
             {"010_042_Y", r.position->north_m},
             {"010_200_GSP", nm(r.velocity->speed_mps)},
             {"010_200_TRA", r.velocity->course_deg},
             {"010_202_VX", r.plane_velocity->east / kItsUnit},
             {"010_202_VY", r.plane_velocity->north / kItsUnit},
             {"010_161_TRK", *r.track_number},
             {"010_170_CNF", most},
             {"010_170_TRE", most},
             {"010_170_CST", most ? 3 : 0},
             {"010_170_MAH", most},
             {"010_170_STH", most},
             {"010_270_LENGTH", r.size->length_m},
             {"010_270_ORIENTATION", *r.size->orientation_deg},
             {"010_270_WIDTH", *r.size->width_m},
             {"010_500_DEVX", r.deviation->east_m},
             {"010_500_DEVY", r.deviation->north_m},
             {"010_500_COVXY", r.deviation->covariance_m},
             {"010_131_VALUE", *r.amplitude},
             {"010_210_AX", r.acceleration->east / kItsUnit},
             {"010_210_AY", r.acceleration->north / kItsUnit}});
  }
  read(full_cat010(true), {{"010_020_SIM", 1}, {"010_020_TST", 1}, {"010_170_GHO", 1}});
  read(Cat010Report{.kind = Cat010Kind::event_status,
                    .time_of_day = 12h,
                    .system_status = Cat010SystemStatus{2, true, true}},
       {{"010_000_VALUE", 4},
        {"010_140_VALUE", 43'200},
        {"010_550_NOGO", 2},
        {"010_550_OVL", 1},
        {"010_550_TSV", 1}});
}

TEST_F(ReportTshark, ReadsManyRecordsOfADatagram) {
  std::vector<Cat048Report> reports;
  std::string expected;
  for (unsigned i = 0; i < 30; ++i) {
    reports.push_back(i % 2 == 0 ? full_cat048(true) : Cat048Report{});
    reports.back().track_number = i;
    expected += (i == 0 ? "" : ",") + std::to_string(i);
  }
  {
    Capture file(capture());
    for (const Bytes& datagram : encode_cat048(reports)) file.add(datagram);
  }
  EXPECT_EQ(tshark("-Y '!asterix or _ws.malformed or _ws.expert.severity >= warning'"), "");
  EXPECT_EQ(tshark("-T fields -e asterix.048_161_TRN"), expected + "\n");
}

// Which shows that they are what they are said to be.
TEST_F(ReportTshark, ReadsTheRecordsOfOthersToo) {
  {
    Capture file(capture());
    file.add(cat048_of_others());
    file.add(cat062_of_others());
  }
  EXPECT_EQ(tshark("-Y '!asterix or _ws.malformed or _ws.expert.severity >= warning'"), "");
  EXPECT_EQ(tshark("-T fields -e asterix.062_040_VALUE -e asterix.062_390_TOD_SEC"),
            "\t\n0x0007\t4\n");
}

}  // namespace
}  // namespace skerry
