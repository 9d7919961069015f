// NMEA 0183 as it leaves the running server, read by gpsd's own decoder; and an own ship that an
// outside simulator drives.
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>
#include <variant>
#include <vector>

#include "protocol/nmea/ais_sentences.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "tests/system/receive.hpp"
#include "tests/unit/net/display_socket.hpp"

namespace skerry::system_test {
namespace {

using Json = nlohmann::json;
using server::DisplaySocket;

constexpr std::uint32_t kLoopback = ipv4(127, 0, 0, 1);
constexpr double kNm = 1852.0;

// An own ship on a straight way, and one of each kind that AIS tells apart.
const std::string kScenario = R"(
name: Navigation
own_ships:
  - name: Tern
    mmsi: 257000111
    position: {lat: 60.425, lon: 5.040}
    course_deg: 335
    speed_kn: 12
    length_m: 80
    beam_m: 14
    radars:
      - {name: Radar, spokes: 512, cells: 512, bits: 8, rpm: 60, range_nm: 6}
targets:
  - {name: Tanker, mmsi: 257000222, ship_type: tanker, position: {lat: 60.445, lon: 5.020},
     course_deg: 160, speed_kn: 10, length_m: 182, beam_m: 32, height_m: 22}
  - {name: At anchor, mmsi: 257000223, position: {lat: 60.435, lon: 5.050}, course_deg: 90,
     speed_kn: 0, length_m: 120, beam_m: 20}
  - {name: Angler, kind: small_craft, mmsi: 257000224, position: {lat: 60.43, lon: 5.03}}
  - {name: Hjeltefjorden north, kind: reflector_buoy, mmsi: 992570001,
     aid_type: starboard_hand_buoy, position: {lat: 60.4840, lon: 5.0190}}
)";

class NavigationOutputs : public testing::Test {
 protected:
  // A server with these outputs and inputs, in YAML, whose sensors are exact.
  std::unique_ptr<RunningServer> served(const std::string& config) {
    return served_as(config + "exact_sensors: true\n");
  }
  std::unique_ptr<RunningServer> served_as(const std::string& config) {
    return std::make_unique<RunningServer>(
        std::vector<std::string>{"--scenario", folder_.write("scenario.yaml", kScenario),
                                 "--config", folder_.write("server.yaml", config)});
  }
  std::string port() const { return std::to_string(plotter_.port()); }

  // Datagrams until the condition is met by all that has come.
  std::string heard_until(const std::function<bool(const std::string&)>& condition) {
    std::string text;
    const auto deadline = std::chrono::steady_clock::now() + kAnswerTime;
    while (!condition(text)) {
      const auto datagram = plotter_.receive();
      if (!datagram || std::chrono::steady_clock::now() > deadline) {
        throw std::runtime_error(
            "what was waited for did not come; last:\n" +
            text.substr(text.size() - std::min<std::size_t>(text.size(), 500)));
      }
      text.append(datagram->payload.begin(), datagram->payload.end());
    }
    return text;
  }

  // gpsdecode's reading, one JSON object a line, by class and AIS message type ("TPV", "AIS5").
  std::map<std::string, std::vector<Json>> decoded_by_gpsd(const std::string& text) {
    const std::string file = folder_.write("heard.nmea", text);
    const Ending ending = run({"/bin/sh", "-c", "exec /usr/bin/gpsdecode < '" + file + "'"});
    EXPECT_EQ(ending.code, 0) << ending.err;
    std::map<std::string, std::vector<Json>> found;
    std::istringstream lines(ending.out);
    for (std::string line; std::getline(lines, line);) {
      const Json object = Json::parse(line);
      std::string name = object.at("class");
      if (name == "AIS") name += std::to_string(object.at("type").get<int>());
      found[name].push_back(object);
    }
    return found;
  }

  TempFolder folder_;
  DisplaySocket plotter_{{}, kLoopback};
};

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

// That of the MMSI, which must be there.
Json of(const std::vector<Json>& messages, std::uint32_t mmsi) {
  for (const Json& message : messages) {
    if (message.at("mmsi") == mmsi) return message;
  }
  ADD_FAILURE() << "nothing of " << mmsi;
  return Json::object();
}

TEST_F(NavigationOutputs, AreReadByGpsdWithTheRightValues) {
  if (::access("/usr/bin/gpsdecode", X_OK) != 0) {
    GTEST_SKIP() << "gpsdecode is not installed: apt-get install gpsd-clients";
  }
  const auto server = served("outputs:\n  - kind: nmea0183\n    port: " + port() +
                             "\n    static_period_s: 1\n    sentences: [rmc=0.5, gga=0.5, vtg=0.5, "
                             "zda=0.5, hdt=0.5, ths=0.5, rot=0.5, vhw=0.5, vbw=0.5, rsd=1, osd=1, "
                             "vdm=0.5, vdo=0.5, ttm=1, tll=1, ttd=1]\n    targets: truth\n");
  const std::string text = heard_until([](const std::string& all) {
    return count(all, "$GPRMC") >= 10 && count(all, "$RATTM") >= 4 && count(all, "!AIVDM") >= 60;
  });
  const auto read = decoded_by_gpsd(text);

  const std::vector<Json>& fixes = read.at("TPV");
  ASSERT_GE(fixes.size(), 5u);
  for (const Json& fix : fixes) {
    EXPECT_EQ(fix.at("mode"), 3);
    EXPECT_NEAR(fix.at("lat").get<double>(), 60.425, 0.05);
    EXPECT_NEAR(fix.at("lon").get<double>(), 5.040, 0.05);
    EXPECT_NEAR(fix.at("track").get<double>(), 335.0, 0.1);
    EXPECT_NEAR(fix.at("speed").get<double>(), 12 * kNm / 3600, 0.01);
  }
  // She makes good what she says: between the first and the last fix.
  const auto metres = [&](const char* key, double scale) {
    return (fixes.back().at(key).get<double>() - fixes.front().at(key).get<double>()) * scale;
  };
  const double way = std::hypot(metres("lat", 111'420), metres("lon", 55'150));
  const auto seconds_of = [](const Json& fix) {
    const std::string time = fix.at("time");  // "2026-11-21T09:08:07.000Z"
    return std::stod(time.substr(11, 2)) * 3600 + std::stod(time.substr(14, 2)) * 60 +
           std::stod(time.substr(17, 6));
  };
  const double time = seconds_of(fixes.back()) - seconds_of(fixes.front());
  if (time > 0) {  // not over midnight
    EXPECT_NEAR(way, time * 12 * kNm / 3600, 0.5 + 0.02 * way);
  }

  const Json own = of(read.at("AIS1"), 257'000'111);
  EXPECT_EQ(own.at("heading"), 335);
  EXPECT_NEAR(own.at("speed").get<double>(), 12.0, 0.05);
  const Json tanker = of(read.at("AIS1"), 257'000'222);
  EXPECT_NEAR(tanker.at("speed").get<double>(), 10.0, 0.05);
  EXPECT_NEAR(tanker.at("course").get<double>(), 160.0, 0.05);
  EXPECT_EQ(tanker.at("heading"), 160);
  EXPECT_NEAR(tanker.at("lat").get<double>(), 60.445, 0.02);
  const Json anchored = of(read.at("AIS1"), 257'000'223);
  EXPECT_NEAR(anchored.at("lat").get<double>(), 60.435, 2e-6);
  EXPECT_NEAR(anchored.at("lon").get<double>(), 5.05, 2e-6);
  EXPECT_EQ(anchored.at("status"), 1);

  const Json voyage = of(read.at("AIS5"), 257'000'222);
  EXPECT_EQ(voyage.at("shipname"), "TANKER");
  EXPECT_EQ(voyage.at("shiptype"), 80);
  EXPECT_EQ(voyage.at("to_bow").get<int>() + voyage.at("to_stern").get<int>(), 182);
  EXPECT_EQ(voyage.at("to_port").get<int>() + voyage.at("to_starboard").get<int>(), 32);
  EXPECT_EQ(of(read.at("AIS5"), 257'000'111).at("shipname"), "TERN");

  const Json boat = of(read.at("AIS18"), 257'000'224);
  EXPECT_NEAR(boat.at("lat").get<double>(), 60.43, 1e-3);
  EXPECT_EQ(boat.at("cs"), true);
  EXPECT_EQ(of(read.at("AIS24"), 257'000'224).at("shipname"), "ANGLER");

  const Json buoy = of(read.at("AIS21"), 992'570'001);
  EXPECT_EQ(buoy.at("name"), "HJELTEFJORDEN NORTH");
  EXPECT_EQ(buoy.at("aid_type"), 25);
  EXPECT_NEAR(buoy.at("lat").get<double>(), 60.484, 2e-6);
  EXPECT_NEAR(buoy.at("lon").get<double>(), 5.019, 2e-6);
  EXPECT_EQ(buoy.at("virtual_aid"), false);

  // Own ship is not among the others.
  for (std::size_t at = text.find("$RATTM"); at != std::string::npos;
       at = text.find("$RATTM", at + 1)) {
    EXPECT_EQ(text.substr(at, text.find('\n', at) - at).find("Tern"), std::string::npos);
  }
}

// The first fix of a log is said before 30 s, and then the ship sails as the log has her.
TEST_F(NavigationOutputs, SayShipsOfAnAisLogThatAScenarioIncludes) {
  const std::string log =
      folder_.write("log.csv",
                    "mmsi,time,lat,lon,name,type,length,beam,class\n"
                    "219000001,2026-01-01T00:00:00Z,60.45,5.00,LOGGED,70,90,14,A\n"
                    "219000001,2026-01-01T00:10:00Z,60.45,5.10,LOGGED,70,90,14,A\n"
                    "219000002,2026-01-01T00:00:00Z,60.44,5.02,SMALL,36,12,4,B\n"
                    "219000002,2026-01-01T00:10:00Z,60.44,5.02,SMALL,36,12,4,B\n");
  const std::string part = folder_.write("traffic.yaml", "");
  const Ending made = run({skerry_program(), "traffic", "import", log, "-o", part, "--force"});
  ASSERT_EQ(made.code, 0) << made.err;
  EXPECT_NE(made.out.find("2 ships in 2 tracks, 4 fixes"), std::string::npos) << made.out;
  const RunningServer server(
      {"--scenario", folder_.write("scenario.yaml", "include: [traffic.yaml]" + kScenario),
       "--config",
       folder_.write("server.yaml", "outputs:\n  - kind: nmea0183\n    port: " + port() +
                                        "\n    static_period_s: 1\n    sentences: [vdm=0.2]\n")});
  std::map<std::uint32_t, nmea::AisPosition> last;
  std::map<std::uint32_t, std::string> names;
  nmea::AisAssembler assembler;
  std::size_t taken = 0;
  heard_until([&](const std::string& all) {
    for (std::size_t end = all.find('\n', taken); end != std::string::npos;
         taken = end + 1, end = all.find('\n', taken)) {
      const std::string line = all.substr(taken, end - taken);
      const auto sentence = nmea::parse_sentence(line);
      if (!sentence) continue;
      const auto heard = assembler.feed(*sentence);
      if (!heard || !heard->has_value()) continue;
      const nmea::AisMessage& message = (*heard)->message;
      if (const auto* fix = std::get_if<nmea::AisPosition>(&message)) last[fix->mmsi] = *fix;
      if (const auto* who = std::get_if<nmea::AisVoyage>(&message)) names[who->mmsi] = who->name;
      if (const auto* who = std::get_if<nmea::AisStatic>(&message); who && !who->part_b) {
        names[who->mmsi] = who->name;
      }
    }
    return names.contains(219'000'001) && names.contains(219'000'002) &&
           last[219'000'001].position && last[219'000'001].position->longitude_deg > 5.0001 &&
           last[219'000'002].position;
  });
  EXPECT_EQ(names[219'000'001], "LOGGED");
  EXPECT_EQ(names[219'000'002], "SMALL");
  const nmea::AisPosition& ship = last[219'000'001];
  EXPECT_FALSE(ship.class_b);
  EXPECT_NEAR(ship.position->latitude_deg, 60.45, 2e-6);
  EXPECT_NEAR(*ship.course_deg, 90.0, 0.1);
  // A tenth of a degree of longitude in 10 minutes.
  EXPECT_NEAR(*ship.speed_kn, 0.1 * 60 * 6 * std::cos(60.45 * 3.14159265 / 180), 0.1);
  EXPECT_TRUE(last[219'000'002].class_b);
  EXPECT_NEAR(last[219'000'002].position->longitude_deg, 5.02, 2e-6);
}

// Those that gpsd does not know.
// Unless told otherwise own ship is as real sensors tell of her: never twice the same.
TEST_F(NavigationOutputs, HaveTheErrorsOfSensors) {
  const auto server = served_as("outputs:\n  - kind: nmea0183\n    port: " + port() +
                                "\n    sentences: [hdt=0.2]\n");
  const std::string text =
      heard_until([](const std::string& all) { return count(all, "HDT,") >= 20; });
  std::set<double> headings;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const auto sentence = nmea::parse_sentence(line);
    if (!sentence || sentence->formatter != "HDT") continue;
    const double heading = nmea::decode_hdt(*sentence).value().heading_deg.value();
    EXPECT_NEAR(heading, 335.0, 0.5);
    headings.insert(heading);
  }
  EXPECT_GE(headings.size(), 3u);  // of tenths of a degree
}

TEST_F(NavigationOutputs, AreReadByPynmea2WithTheRightValues) {
  if (::access("/usr/lib/python3/dist-packages/pynmea2/__init__.py", R_OK) != 0) {
    GTEST_SKIP() << "pynmea2 is not installed: apt-get install python3-nmea2";
  }
  const auto server = served("outputs:\n  - kind: nmea0183\n    port: " + port() +
                             "\n    sentences: [vbw=0.2, osd=0.2, rot=0.2, hdt=0.2, ttm=0.2, "
                             "tll=0.2, rmc=0.2]\n    targets: truth\n");
  const std::string text = heard_until([](const std::string& all) {
    return count(all, "$RATTM") >= 9 && count(all, "$RATLL") >= 9;
  });
  const Ending ending =
      run({"/usr/bin/python3", std::string(SKERRY_SOURCE_DIR) + "/tests/system/read_nmea.py",
           folder_.write("heard.nmea", text)});
  ASSERT_EQ(ending.code, 0) << ending.err;
  std::map<std::string, std::vector<Json>> read;
  std::istringstream lines(ending.out);
  for (std::string line; std::getline(lines, line);) {
    const Json object = Json::parse(line);
    read[object.at("sentence")].push_back(object);
  }
  const auto number = [](const Json& object, const char* key) {
    return std::stod(object.at(key).get<std::string>());
  };
  ASSERT_GE(read["VBW"].size(), 3u);
  EXPECT_EQ(read["VBW"][0].at("data_validity_water_spd"), "A");
  EXPECT_NEAR(number(read["VBW"][0], "lon_water_spd"), 12.0, 0.01);
  EXPECT_NEAR(number(read["VBW"][0], "lon_grnd_spd"), 12.0, 0.01);
  EXPECT_NEAR(number(read["VBW"][0], "trans_grnd_spd"), 0.0, 0.01);
  EXPECT_NEAR(number(read["OSD"].at(0), "heading"), 335.0, 0.05);
  EXPECT_EQ(read["OSD"][0].at("status"), "A");
  EXPECT_NEAR(number(read["OSD"][0], "course"), 335.0, 0.05);
  EXPECT_NEAR(number(read["OSD"][0], "speed"), 12.0, 0.01);
  EXPECT_NEAR(number(read["ROT"].at(0), "rate_of_turn"), 0.0, 0.05);

  // The ship at anchor, which alone stays where the scenario has her.
  const auto of_name = [](const std::vector<Json>& all, const char* key, const std::string& name) {
    for (const Json& one : all) {
      if (one.at(key) == name) return one;
    }
    ADD_FAILURE() << "nothing of " << name;
    return Json::object();
  };
  const Json tll = of_name(read["TLL"], "target_name", "At anchor");
  EXPECT_EQ(tll.at("lat"), "6026.10000");
  EXPECT_EQ(tll.at("lat_dir"), "N");
  EXPECT_EQ(tll.at("lon"), "00503.00000");
  EXPECT_EQ(tll.at("target_status"), "T");
  const Json ttm = of_name(read["TTM"], "name", "Tanker");
  EXPECT_NEAR(number(ttm, "distance"), 1.35, 0.35) << "1.34 NM when she began, and nearer since";
  EXPECT_NEAR(number(ttm, "speed"), 10.0, 0.05);
  EXPECT_NEAR(number(ttm, "cog"), 160.0, 0.05);
  EXPECT_EQ(ttm.at("dist_unit"), "N");
  EXPECT_EQ(ttm.at("acquisition"), "A");
  // Head on: 22 kn towards each other.
  EXPECT_NEAR(number(ttm, "time_cpa"), number(ttm, "distance") / 22 * 60, 0.1);
}

// A ship of another simulator, on a straight way.
class OutsideShip {
 public:
  OutsideShip(GeoPoint begin, double course_deg, double speed_kn)
      : begin_(begin), course_deg_(course_deg), speed_kn_(speed_kn) {}

  GeoPoint position() const {
    const double s =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const double way_nm = speed_kn_ * s / 3600, course = course_deg_ * M_PI / 180;
    return {begin_.latitude_deg + way_nm / 60 * std::cos(course),
            begin_.longitude_deg +
                way_nm / 60 * std::sin(course) / std::cos(begin_.latitude_deg * M_PI / 180)};
  }
  std::string sentences() const {
    return encode(nmea::Rmc{.utc = UtcTime{},
                            .position = position(),
                            .speed_kn = speed_kn_,
                            .course_deg = course_deg_}) +
           encode(nmea::Hdt{.heading_deg = course_deg_ - 5});
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  GeoPoint begin_;
  double course_deg_, speed_kn_;
};

double metres_between(GeoPoint a, GeoPoint b) {
  return std::hypot(
      (a.latitude_deg - b.latitude_deg) * 111'420,
      (a.longitude_deg - b.longitude_deg) * 111'420 * std::cos(a.latitude_deg * M_PI / 180));
}

TEST_F(NavigationOutputs, AnOutsideSimulatorDrivesOwnShip) {
  // Free a moment ago.
  const std::uint16_t input = DisplaySocket({}, kLoopback).port();
  const auto server = served("outputs:\n  - kind: nmea0183\n    port: " + port() +
                             "\n    sentences: [rmc=0.1, hdt=0.1]\ninputs:\n"
                             "  - kind: nmea0183\n    port: " +
                             std::to_string(input) + "\n");
  DisplaySocket simulator({}, kLoopback);
  // Sends whenever the plotter hears something, until what it hears is where the ship is.
  const auto drive_until_there = [&](const OutsideShip& ship) {
    bool heading = false, there = false;
    heard_until([&](const std::string& all) {
      simulator.send({kLoopback, input}, ship.sentences());
      for (const char* noise : {"$GPRMC,garbage*00\r\n", "\x00\xFF", "$HEHDT,999.0,T*20\r\n"}) {
        simulator.send({kLoopback, input}, std::string(noise));
      }
      const std::size_t begin = all.rfind('$');
      const std::string last = begin == std::string::npos ? "" : all.substr(begin);
      const auto sentence = nmea::parse_sentence(last);
      if (!sentence) return false;
      if (sentence->formatter == "HDT") {
        heading = std::abs(nmea::decode_hdt(*sentence).value().heading_deg.value() - 95) < 0.1;
      } else {
        const auto rmc = nmea::decode_rmc(*sentence).value();
        there = metres_between(*rmc.position, ship.position()) < 20 &&
                std::abs(*rmc.speed_kn - 15) < 0.1 && std::abs(*rmc.course_deg - 100) < 0.2;
      }
      return heading && there;
    });
  };
  drive_until_there(OutsideShip({60.2, 4.5}, 100, 15));
  // The instructor puts her elsewhere.
  drive_until_there(OutsideShip({59.0, 4.0}, 100, 15));

  client::SpokeClient console = subscribed(*server, 0);
  const wire::Status status = await_status(
      console, [](const wire::Status& all) { return all.errors().contains("nmea input jump"); });
  EXPECT_GE(status.errors().at("nmea input fault"), 3u);
  EXPECT_NEAR(status.radars(0).own_ship().latitude_deg(), 59.0, 0.1);
}

}  // namespace
}  // namespace skerry::system_test
