// A server that takes real radars from the network: here the radars of another server, of every
// make that it emulates.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "tests/system/display_kit.hpp"
#include "tests/system/receive.hpp"
#include "tests/system/small_scenario.hpp"

namespace skerry::system_test {
namespace {

using testing::HasSubstr;

// A turn of a console as a display has it.
std::vector<SeenSpoke> seen_by(const Scan& scan) {
  std::vector<SeenSpoke> seen;
  for (const auto& spoke : scan.spokes) {
    if (!spoke) continue;
    const SpokeHeader& header = spoke->header;
    SeenSpoke one{static_cast<double>(header.index) / header.geometry.spokes_per_turn,
                  header.reach().in_metres(),
                  {}};
    for (const std::uint8_t cell : spoke->cells) {
      one.cells.push_back(
          static_cast<std::uint8_t>(cell * 255u / ((1u << header.geometry.bits) - 1)));
    }
    seen.push_back(std::move(one));
  }
  return seen;
}

bool transmits(const wire::Status& status) {
  return !status.radars(0).settings().standby() && status.radars(0).spokes() > 0;
}

// A server with a radar of some make at 127.0.0.71, and one that listens for it.
struct Pair {
  Pair(const std::string& kind, const std::string& input_keys,
       const std::vector<std::string>& further = {})
      : radar({"--scenario", folder.write("small.yaml", small_scenario()), "--output",
               kind + ":interface_address=127.0.0.71"}),
        console(subscribed(radar, 0)),
        relay(arguments(kind + ":from=127.0.0.71" + input_keys, further)),
        display(subscribed(relay, 0)) {
    found = await_status(display, transmits);
  }
  std::vector<std::string> arguments(const std::string& input,
                                     const std::vector<std::string>& further) {
    std::vector<std::string> all = {"--scenario", folder.write("small.yaml", small_scenario()),
                                    "--input", input};
    all.insert(all.end(), further.begin(), further.end());
    return all;
  }
  // The picture that is relayed is the radar's own.
  void expect_likeness() {
    const Likeness likeness = compare(seen_by(next_scan(display)), next_scan(console));
    EXPECT_GT(likeness.strong, 1000u) << "an empty picture";
    EXPECT_GT(likeness.confirmed, 0.9) << "of " << likeness.strong << " strong cells";
  }

  TempFolder folder;
  RunningServer radar;
  client::SpokeClient console;
  RunningServer relay;
  client::SpokeClient display;
  wire::Status found;
};

class LiveInput : public testing::TestWithParam<const char*> {};

TEST_P(LiveInput, ShowsTheRadarsPicture) {
  Pair pair(GetParam(), "");
  pair.expect_likeness();
  // A Quantum's spokes reach 2.24 times its range, the native protocol's twice the scale at most.
  const bool reaches_far = std::string(GetParam()) == "raymarine_quantum";
  EXPECT_EQ(pair.found.radars(0).settings().range_nm(), reaches_far ? 12.0 : 6.0);
}

// Under a sanitizer one make will do: what differs between them is in unit tests.
#ifdef SKERRY_ONE_MAKE
const auto kMakes = testing::Values("navico_halo");
const auto kCommanded = kMakes;
#else
const auto kMakes = testing::Values("navico_br24", "navico_3g", "navico_4g", "navico_halo20",
                                    "navico_halo", "garmin_xhd", "raymarine_quantum");
const auto kCommanded =
    testing::Values("navico_br24", "navico_4g", "navico_halo", "garmin_xhd", "raymarine_quantum");
#endif

INSTANTIATE_TEST_SUITE_P(EveryMake, LiveInput, kMakes,
                         [](const auto& one) { return std::string(one.param); });

// Its bearings are from north: the heading comes as sentences.
TEST(LiveInputs, ACat240StreamIsShown) {
  TempFolder folder;
  const std::string scenario = folder.write("small.yaml", small_scenario());
  RunningServer radar({"--scenario", scenario, "--output",
                       "cat240:address=239.192.43.91,port=4391,interface_address=127.0.0.1",
                       "--output", "nmea0183:port=10134"});
  RunningServer relay({"--scenario", scenario, "--input", "cat240:address=239.192.43.91,port=4391",
                       "--input", "nmea0183:port=10134"});
  client::SpokeClient console = subscribed(radar, 0), display = subscribed(relay, 0);
  await_status(display, [](const wire::Status& status) {
    return transmits(status) && !status.radars(0).own_ship().no_heading();
  });
  next_scan(display);
  const Likeness likeness = compare(seen_by(next_scan(display)), next_scan(console));
  EXPECT_GT(likeness.confirmed, 0.9) << "of " << likeness.strong << " strong cells";
}

// Another server's datagrams: cell by cell its picture, in fragments too.
TEST(LiveInputs, ANativeStreamIsShown) {
  TempFolder folder;
  const std::string scenario = folder.write("small.yaml", small_scenario());
  for (const char* datagrams : {"65507", "300"}) {
    RunningServer radar({"--scenario", scenario, "--output",
                         std::string("native:port=17433,max_datagram=") + datagrams});
    RunningServer relay({"--scenario", scenario, "--input", "native:port=17433"});
    client::SpokeClient console = subscribed(radar, 0), display = subscribed(relay, 0);
    const wire::Status found = await_status(display, transmits);
    EXPECT_EQ(found.radars(0).name(), "Skerry radar 0 view 0");
    EXPECT_EQ(found.radars(0).settings().range_nm(), 6.0);
    const Scan scan = next_scan(display);
    EXPECT_EQ(scan.geometry.spokes_per_turn, kSmallSpokes);
    EXPECT_EQ(scan.geometry.cells, kSmallCells);
    const Likeness likeness = compare(seen_by(scan), next_scan(console));
    EXPECT_GT(likeness.confirmed, 0.9) << "of " << likeness.strong << " strong cells";
  }
}

// Range changes at the radar, its standby, its death and its return; what its console may not.
TEST(LiveInputs, FollowTheRadar) {
  Pair pair("navico_halo", "");
  const auto set = [&](const std::vector<std::string>& what) {
    EXPECT_EQ(pair.radar.skerry("set", what).code, 0);
  };
  for (const double nm : {12.0, 3.0}) {
    set({"--range", std::to_string(nm)});
    await_status(pair.display, [nm](const wire::Status& status) {
      return status.radars(0).settings().range_nm() == nm;
    });
    pair.expect_likeness();
  }
  set({"--gain", "80"});
  await_status(pair.display, [](const wire::Status& status) {
    return std::abs(status.radars(0).settings().gain() - 80.0) < 0.5;
  });
  set({"--transmit", "off"});
  await_status(pair.display,
               [](const wire::Status& status) { return status.radars(0).settings().standby(); });
  set({"--transmit", "on"});
  await_status(pair.display, transmits);
  pair.expect_likeness();

  const Ending refused = pair.relay.skerry("set", {"--gain", "20"});
  EXPECT_NE(refused.code, 0);
  EXPECT_THAT(refused.err, HasSubstr("real one"));
  // The simulated radars beside it are as ever.
  EXPECT_EQ(pair.relay.skerry("set", {"--radar", "1", "--gain", "20"}).code, 0);
}

// A console of the second server sets the radar's controls; the radar's own consoles see it.
class LiveCommands : public testing::TestWithParam<const char*> {};

TEST_P(LiveCommands, ReachTheRadar) {
  Pair pair(GetParam(), ",commands=true,interface_address=127.0.0.71");
  const auto await_settings = [](client::SpokeClient& of,
                                 const std::function<bool(const wire::Settings&)>& condition) {
    await_status(
        of, [&](const wire::Status& status) { return condition(status.radars(0).settings()); });
  };
  const auto set = [&](const std::vector<std::string>& what) {
    const Ending ending = pair.relay.skerry("set", what);
    EXPECT_EQ(ending.code, 0) << ending.err;
  };
  set({"--range", "3", "--gain", "80"});
  await_settings(pair.console, [](const wire::Settings& now) {
    return now.range_nm() == 3.0 && std::abs(now.gain() - 80.0) < 0.5;
  });
  set({"--sea-auto", "on"});
  await_settings(pair.console, [](const wire::Settings& now) { return now.sea_auto(); });
  set({"--rain", "40", "--transmit", "off"});
  await_settings(pair.console, [](const wire::Settings& now) {
    return now.standby() && std::abs(now.rain() - 40.0) < 0.5;
  });
  await_settings(pair.display, [](const wire::Settings& now) { return now.standby(); });
  set({"--transmit", "on"});
  await_settings(pair.display, [](const wire::Settings& now) {
    return !now.standby() && std::abs(now.gain() - 80.0) < 0.5;
  });
  const Ending refused = pair.relay.skerry("set", {"--tune", "20"});
  EXPECT_NE(refused.code, 0);
  EXPECT_THAT(refused.err, HasSubstr("has no control 'tune'"));
}

INSTANTIATE_TEST_SUITE_P(EveryMake, LiveCommands, kCommanded,
                         [](const auto& one) { return std::string(one.param); });

// A HALO on a Garmin plotter, which is a third server here.
TEST(LiveInputs, GoOutAsAnotherMake) {
  Pair pair("navico_halo", "", {"--output", "garmin_xhd:interface_address=127.0.0.72"});
  RunningServer plotter({"--scenario", pair.folder.write("third.yaml", small_scenario()), "--input",
                         "garmin_xhd:from=127.0.0.72"});
  client::SpokeClient screen = subscribed(plotter, 0);
  await_status(screen, transmits);
  const Likeness likeness = compare(seen_by(next_scan(screen)), next_scan(pair.console));
  EXPECT_GT(likeness.strong, 1000u);
  EXPECT_GT(likeness.confirmed, 0.9) << "of " << likeness.strong << " strong cells";
}

// A ship at sea with nothing near; the simulation has a tanker 2 NM north of her.
std::string at_sea(const std::string& targets) {
  return R"(name: At sea
sea: {state: 0}
own_ships:
  - name: Petrel
    position: {lat: 61.0, lon: 2.0}
    course_deg: 30
    speed_kn: 0
    radars:
      - {name: Alone, spokes: 512, cells: 512, bits: 8, rpm: 60, range_nm: 6}
)" + targets;
}
constexpr char kTanker[] = R"(targets:
  - {name: Tanker, position: {lat: 61.033333, lon: 2.0}, course_deg: 90, speed_kn: 0,
     length_m: 182, beam_m: 32, height_m: 22}
)";

// The levels of a turn near a true bearing and range, as parts of the greatest.
double strongest_near(const Scan& scan, double bearing_deg, double range_m) {
  double strongest = 0.0;
  for (const auto& spoke : scan.spokes) {
    if (!spoke) continue;
    const SpokeHeader& header = spoke->header;
    const Angle off = header.bearing() - TrueBearing::from(degrees(bearing_deg));
    if (std::abs(off.in_degrees()) > 3.0) continue;
    const double cell = range_m / header.cell_size().in_metres();
    for (std::size_t i = 0; i < spoke->cells.size(); ++i) {
      if (std::abs(static_cast<double>(i) - cell) > 120.0 / header.cell_size().in_metres())
        continue;
      strongest = std::max(strongest, spoke->cells[i] / ((1u << header.geometry.bits) - 1.0));
    }
  }
  return strongest;
}

// The tanker is where she is simulated, on the relay alone; after each change of the real radar's
// range.  When the real ship moves 1 NM north, so she is 1 NM nearer.
TEST(LiveInputs, ASimulationIsLaidOverAPicture) {
  TempFolder folder;
  RunningServer radar({"--scenario", folder.write("real.yaml", at_sea("")), "--output",
                       "navico_halo:interface_address=127.0.0.71"});
  RunningServer relay({"--scenario", folder.write("simulated.yaml", at_sea(kTanker)), "--input",
                       "navico_halo:from=127.0.0.71,simulated=true", "--input",
                       "nmea0183:port=10135"});
  client::SpokeClient console = subscribed(radar, 0), display = subscribed(relay, 0);
  const wire::Status found = await_status(display, transmits);
  EXPECT_EQ(found.radars(0).name(), "HALO + simulated");
  constexpr double kMile = 1852.0;
  const auto shows = [&](double range_m) {
    for (int turn = 0; turn < 20; ++turn) {
      if (strongest_near(next_scan(display), 0.0, range_m) > 0.5) return true;
    }
    return false;
  };
  EXPECT_TRUE(shows(2.0 * kMile));
  next_scan(console);
  EXPECT_EQ(strongest_near(next_scan(console), 0.0, 2.0 * kMile), 0.0);
  for (const char* range : {"3", "12"}) {
    EXPECT_EQ(radar.skerry("set", {"--range", range}).code, 0);
    await_status(display, [&](const wire::Status& status) {
      return status.radars(0).settings().range_nm() == std::stod(range);
    });
    next_scan(display);
    EXPECT_TRUE(shows(2.0 * kMile)) << range << " NM";
  }
  server::DisplaySocket sensor({}, ipv4(127, 0, 0, 1));
  const Ipv4Endpoint to{ipv4(127, 0, 0, 1), 10135};
  for (int second = 0; second < 10 && strongest_near(next_scan(display), 0.0, kMile) < 0.5;
       ++second) {
    const std::string fix = "$GPGGA,120000.00,6101.000,N,00200.000,E,1,08,1.0,0.0,M,,M,,*7C\r\n";
    const std::string heading = "$HEHDT,30.0,T*1C\r\n";
    sensor.send(to, fix);
    sensor.send(to, heading);
  }
  EXPECT_TRUE(shows(kMile));
}

TEST(LiveInputs, OwnShipComesAsSentences) {
  Pair pair("navico_br24", "", {"--input", "nmea0183:port=10133"});
  RunningServer ship({"--scenario", pair.folder.write("ship.yaml", small_scenario()), "--output",
                      "nmea0183:port=10133"});
  const wire::Status status = await_status(pair.display, [](const wire::Status& now) {
    return !now.radars(0).own_ship().no_position();
  });
  EXPECT_NEAR(status.radars(0).own_ship().latitude_deg(), 60.425, 0.05);
}

TEST(LiveInputs, OneThatWouldHearItsOwnDatagramsIsRefused) {
  for (const auto& [input, advice] : {std::pair{"native", "--no-udp"},
                                      {"cat240", "--no-cat240"},
                                      {"native:address=127.0.0.1,port=7411", "--no-udp"}}) {
    const Ending ending = run({skerryd_program(), "--input", input, "--check"});
    EXPECT_EQ(ending.code, 2) << input;
    EXPECT_THAT(ending.err, HasSubstr(advice));
  }
  EXPECT_EQ(run({skerryd_program(), "--input", "native", "--no-udp", "--check"}).code, 0);
}

TEST(LiveInputs, OneThatWouldHearItselfIsRefused) {
  const Ending ending =
      run({skerryd_program(), "--check", "--output", "navico_4g", "--input", "navico_halo"});
  EXPECT_EQ(ending.code, 2);
  EXPECT_THAT(ending.err, HasSubstr("from=ADDRESS"));
}

}  // namespace
}  // namespace skerry::system_test
