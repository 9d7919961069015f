// What pynmea2 and gpsd's decoder, written by others, make of our sentences: each value is where
// they look for it.
#include <gtest/gtest.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "protocol/nmea/depth_sentences.hpp"
#include "protocol/nmea/engine_sentences.hpp"
#include "protocol/nmea/gnss_sentences.hpp"
#include "protocol/nmea/heading_control_sentences.hpp"
#include "protocol/nmea/log_sentences.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/nmea/rudder_sentences.hpp"
#include "protocol/nmea/track_sentences.hpp"
#include "protocol/nmea/transducer_sentences.hpp"
#include "protocol/nmea/waypoint_sentences.hpp"
#include "protocol/nmea/wind_sentences.hpp"
#include "tests/unit/nmea/sentence_kit.hpp"
#include "tests/unit/signals/outside_tool.hpp"

namespace skerry::nmea {
namespace {

using Json = nlohmann::json;
using client::testing_signals::Folder;
using client::testing_signals::run_tool;

constexpr GeoPoint kNorthWest{60.39, -5.32};
constexpr Duration kNoon = std::chrono::hours(12);

// What a program writes when it is given the lines; `redirect` stands between it and the file.
std::string read_by(const std::string& program, const std::string& redirect,
                    const std::vector<std::string>& lines) {
  const Folder folder;
  const std::string file = folder / "lines.nmea";
  {
    std::ofstream out(file, std::ios::binary);
    for (const std::string& line : lines) out << line;
  }
  const auto result = run_tool(program + redirect + "'" + file + "'");
  EXPECT_EQ(result.code, 0) << program;
  return result.text();
}

class Pynmea2 : public testing::Test {
 protected:
  void SetUp() override {
    if (::access("/usr/lib/python3/dist-packages/pynmea2/__init__.py", R_OK) != 0) {
      GTEST_SKIP() << "pynmea2 is not installed: apt-get install python3-nmea2";
    }
  }

  void read(const std::vector<std::string>& lines) {
    std::istringstream out(read_by(
        "/usr/bin/python3 '" + std::string(SKERRY_SOURCE_DIR) + "/tests/system/read_nmea.py'", " ",
        lines));
    for (std::string line; std::getline(out, line);) {
      const Json object = Json::parse(line);
      read_[object.at("sentence")] = object;
    }
    EXPECT_EQ(read_.size(), lines.size()) << "each is understood";
  }

  // A field as it was written.
  std::string text(const std::string& sentence, const std::string& field) {
    return read_.at(sentence).at(field).get<std::string>();
  }

 private:
  std::map<std::string, Json> read_ = {};
};

TEST_F(Pynmea2, FindsWhatTheShipSaysOfHerself) {
  read({encode(Rsa{12.5, -3.5}), encode(Rpm{RevolutionSource::shaft, 2, 95.5, -40.0}),
        encode(Vlw{100.5, 12.25, 99.5, 11.0}), encode(Vdr{45.0, 1.5}),
        encode(Vbw{10.5, -0.25, 11.5, 0.75, 0.1, 0.2}), encode(Dpt{12.5, -6.5, 100.0}),
        encode(Dbt{10.0}), encode(Mwv{350.5, WindReference::theoretical, 12.5}),
        encode(Mwd{270.5, 10.0}), encode(Hdg{98.5, 1.5, -12.5}), encode(Rot{-5.5}),
        encode_xdr(std::vector{roll_transducer(-5.25)}).at(0)});
  EXPECT_EQ(text("RSA", "rsa_starboard"), "12.5");
  EXPECT_EQ(text("RSA", "rsa_starboard_status"), "A");
  EXPECT_EQ(text("RSA", "rsa_port"), "-3.5");
  EXPECT_EQ(text("RPM", "source"), "S");
  EXPECT_EQ(text("RPM", "engine_no"), "2");
  EXPECT_EQ(text("RPM", "speed"), "95.5");
  EXPECT_EQ(text("RPM", "pitch"), "-40.0");
  EXPECT_EQ(text("RPM", "status"), "A");
  EXPECT_EQ(text("VLW", "trip_distance"), "100.500") << "pynmea2 names the total so";
  EXPECT_EQ(text("VLW", "trip_distance_reset"), "12.250");
  EXPECT_EQ(text("VDR", "deg_t"), "45.0");
  EXPECT_EQ(text("VDR", "current"), "1.50");
  EXPECT_EQ(text("VDR", "unit_kn"), "N");
  EXPECT_EQ(text("VBW", "trans_water_spd"), "-0.25");
  EXPECT_EQ(text("VBW", "lon_grnd_spd"), "11.50");
  EXPECT_EQ(text("VBW", "data_validity_grnd_spd"), "A");
  EXPECT_EQ(text("DPT", "depth"), "12.5");
  EXPECT_EQ(text("DPT", "offset"), "-6.5");
  EXPECT_EQ(text("DPT", "range"), "100.0");
  EXPECT_EQ(text("DBT", "depth_feet"), "32.8");
  EXPECT_EQ(text("DBT", "depth_meters"), "10.0");
  EXPECT_EQ(text("DBT", "depth_fathoms"), "5.5");
  EXPECT_EQ(text("MWV", "wind_angle"), "350.5");
  EXPECT_EQ(text("MWV", "reference"), "T");
  EXPECT_EQ(text("MWV", "wind_speed"), "12.5");
  EXPECT_EQ(text("MWV", "wind_speed_units"), "N");
  EXPECT_EQ(text("MWV", "status"), "A");
  EXPECT_EQ(text("MWD", "direction_true"), "270.5");
  EXPECT_EQ(text("MWD", "wind_speed_knots"), "10.0");
  EXPECT_EQ(text("MWD", "wind_speed_meters"), "5.1");
  EXPECT_EQ(text("HDG", "heading"), "98.5");
  EXPECT_EQ(text("HDG", "dev_dir"), "E");
  EXPECT_EQ(text("HDG", "variation"), "12.5");
  EXPECT_EQ(text("HDG", "var_dir"), "W");
  EXPECT_EQ(text("ROT", "rate_of_turn"), "-5.5");
  EXPECT_EQ(text("XDR", "type"), "A");
  EXPECT_EQ(text("XDR", "value"), "-5.25");
  EXPECT_EQ(text("XDR", "units"), "D");
  EXPECT_EQ(text("XDR", "id"), "ROLL");
}

TEST_F(Pynmea2, FindsWhatATrackPilotNeeds) {
  read({encode(Xte{.off_track_nm = 0.25}),
        encode(Apb{.off_track_nm = -0.25,
                   .arrival_circle_entered = true,
                   .track_deg = 10.5,
                   .waypoint = "NEXT",
                   .bearing_deg = 20.5,
                   .heading_deg = 30.5}),
        encode(Rmb{.off_track_nm = 0.25,
                   .origin = "LAST",
                   .destination = "NEXT",
                   .position = kNorthWest,
                   .range_nm = 5.5,
                   .bearing_deg = 20.5,
                   .closing_kn = 12.5,
                   .arrived = true}),
        encode(Bwc{kNoon, kNorthWest, 20.5, 5.5, "NEXT"}), encode(Bod{10.5, "NEXT", "LAST"}),
        encode(Hsc{.true_deg = 30.5, .magnetic_deg = 29.5}),
        encode(Gns{.time_of_day = kNoon,
                   .position = kNorthWest,
                   .modes = "AN",
                   .dilution = 0.5,
                   .altitude_m = 20.5,
                   .geoid_m = 40.5}),
        encode(Gll{kNorthWest, kNoon}), encode(Dtm{"999", 'X', 0.5, -0.25, 1.5})});
  EXPECT_EQ(text("XTE", "cross_track_err_dist"), "0.250");
  EXPECT_EQ(text("XTE", "correction_dir"), "L");
  EXPECT_EQ(text("XTE", "dist_units"), "N");
  EXPECT_EQ(text("APB", "cross_track_err_mag"), "0.250");
  EXPECT_EQ(text("APB", "dir_steer"), "R");
  EXPECT_EQ(text("APB", "arr_circle_entered"), "A");
  EXPECT_EQ(text("APB", "perp_passed"), "V");
  EXPECT_EQ(text("APB", "bearing_to_dest"), "10.5") << "origin to destination";
  EXPECT_EQ(text("APB", "dest_waypoint_id"), "NEXT");
  EXPECT_EQ(text("APB", "bearing_pres_dest"), "20.5");
  EXPECT_EQ(text("APB", "heading_to_dest"), "30.5");
  EXPECT_EQ(text("APB", "heading_to_dest_type"), "T");
  EXPECT_EQ(text("RMB", "cross_track_error"), "0.25");
  EXPECT_EQ(text("RMB", "cte_correction_dir"), "L");
  EXPECT_EQ(text("RMB", "origin_waypoint_id"), "LAST");
  EXPECT_EQ(text("RMB", "dest_waypoint_id"), "NEXT");
  EXPECT_EQ(text("RMB", "dest_lat"), "6023.400");
  EXPECT_EQ(text("RMB", "dest_lon_dir"), "W");
  EXPECT_EQ(text("RMB", "dest_range"), "5.5");
  EXPECT_EQ(text("RMB", "dest_true_bearing"), "20.5");
  EXPECT_EQ(text("RMB", "dest_velocity"), "12.5");
  EXPECT_EQ(text("RMB", "arrival_alarm"), "A");
  EXPECT_EQ(text("BWC", "lat_next"), "6023.400");
  EXPECT_EQ(text("BWC", "true_track"), "20.5");
  EXPECT_EQ(text("BWC", "range_next"), "5.500");
  EXPECT_EQ(text("BWC", "waypoint_name"), "NEXT");
  EXPECT_EQ(text("BOD", "bearing_t"), "10.5");
  EXPECT_EQ(text("BOD", "dest"), "NEXT");
  EXPECT_EQ(text("BOD", "start"), "LAST");
  EXPECT_EQ(text("HSC", "heading_true"), "30.5");
  EXPECT_EQ(text("HSC", "heading_magnetic"), "29.5");
  EXPECT_EQ(text("GNS", "mode_indicator"), "AN");
  EXPECT_EQ(text("GNS", "num_sats"), "12");
  EXPECT_EQ(text("GNS", "hdop"), "0.5");
  EXPECT_EQ(text("GNS", "altitude"), "20.5");
  EXPECT_EQ(text("GNS", "geo_sep"), "40.5");
  EXPECT_EQ(text("GLL", "lon"), "00519.20000");
  EXPECT_EQ(text("GLL", "status"), "A");
  EXPECT_EQ(text("GLL", "faa_mode"), "A");
  EXPECT_EQ(text("DTM", "datum"), "999");
  EXPECT_EQ(text("DTM", "lat"), "0.5000");
  EXPECT_EQ(text("DTM", "lon_dir"), "W");
  EXPECT_EQ(text("DTM", "altitude"), "1.5");
  EXPECT_EQ(text("DTM", "datum_code"), "W84");
}

// It knows neither TLB nor the sentences of alerts.
TEST_F(Pynmea2, FindsWhatAPlotterTracks) {
  read({encode(Ttm{.number = 7,
                   .range_nm = 3.5,
                   .bearing_deg = 45.5,
                   .speed_kn = 12.5,
                   .course_deg = 180.5,
                   .cpa_nm = 0.25,
                   .tcpa_min = -4.5,
                   .name = "ASTRID",
                   .status = TargetStatus::lost,
                   .time_of_day = kNoon,
                   .is_reference = true,
                   .acquisition = TargetAcquisition::manual}),
        encode(Tll{.number = 8,
                   .position = kNorthWest,
                   .name = "BRITT",
                   .time_of_day = kNoon,
                   .status = TargetStatus::acquiring,
                   .is_reference = true})});
  EXPECT_EQ(text("TTM", "target_number"), "07");
  EXPECT_EQ(text("TTM", "distance"), "3.500");
  EXPECT_EQ(text("TTM", "bearing"), "45.5");
  EXPECT_EQ(text("TTM", "brg_ref"), "T");
  EXPECT_EQ(text("TTM", "speed"), "12.5");
  EXPECT_EQ(text("TTM", "cog"), "180.5");
  EXPECT_EQ(text("TTM", "cog_unit"), "T");
  EXPECT_EQ(text("TTM", "dist_cpa"), "0.25");
  EXPECT_EQ(text("TTM", "time_cpa"), "-4.5");
  EXPECT_EQ(text("TTM", "dist_unit"), "N");
  EXPECT_EQ(text("TTM", "name"), "ASTRID");
  EXPECT_EQ(text("TTM", "status"), "L");
  EXPECT_EQ(text("TTM", "reference"), "R");
  EXPECT_EQ(text("TTM", "timestamp"), "120000.00");
  EXPECT_EQ(text("TTM", "acquisition"), "M");
  EXPECT_EQ(text("TLL", "target_number"), "08");
  EXPECT_EQ(text("TLL", "lat"), "6023.40000");
  EXPECT_EQ(text("TLL", "lon_dir"), "W");
  EXPECT_EQ(text("TLL", "target_name"), "BRITT");
  EXPECT_EQ(text("TLL", "target_status"), "Q");
  EXPECT_EQ(text("TLL", "reference"), "R");
}

TEST(Gpsdecode, FindsWindAndPosition) {
  if (::access("/usr/bin/gpsdecode", X_OK) != 0) {
    GTEST_SKIP() << "gpsdecode is not installed: apt-get install gpsd-clients";
  }
  // It reports once it has seen what ends a cycle, which a depth does.
  std::vector<std::string> lines{encode(Dbt{10.0})};
  for (int cycle = 0; cycle < 3; ++cycle) {
    lines.push_back(encode(Mwv{350.5, WindReference::relative, 10.0}));
    lines.push_back(encode(Mwd{270.5, 10.0}));
    lines.push_back(encode(Gll{kNorthWest, kNoon + cycle * std::chrono::seconds(1)}));
  }
  std::map<std::string, double> read;
  std::istringstream out(read_by("/usr/bin/gpsdecode", " < ", lines));
  for (std::string text; std::getline(out, text);) {
    const Json report = Json::parse(text);
    for (const auto& [key, value] : report.items()) {
      if (value.is_number()) read[key] = value.get<double>();
    }
  }
  EXPECT_NEAR(read["wangler"], 350.5, 0.05);
  EXPECT_NEAR(read["wspeedr"], 5.14, 0.06);
  EXPECT_NEAR(read["wanglet"], 270.5, 0.05);
  EXPECT_NEAR(read["wspeedt"], 5.14, 0.06);
  EXPECT_NEAR(read["lat"], 60.39, 1e-7);
  EXPECT_NEAR(read["lon"], -5.32, 1e-7);
}

}  // namespace
}  // namespace skerry::nmea
