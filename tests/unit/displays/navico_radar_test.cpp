#include "server/displays/navico/navico_radar.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "protocol/navico/command.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/navico/ship_data.hpp"
#include "protocol/navico/spoke_range.hpp"
#include "tests/unit/displays/fake_display_port.hpp"

namespace skerry::server {
namespace {

using navico::Command;
using navico::CommandKind;
using navico::Model;
using namespace std::chrono_literals;

constexpr RangeChannel kA = RangeChannel::a, kB = RangeChannel::b;
constexpr Ipv4Endpoint kDisplay{ipv4(192, 0, 2, 9), 4000};

// A radar on the fake network, and a display's view of it.
class Bench {
 public:
  explicit Bench(Model model, Duration standby_when_alone = {}, bool one_radar = true)
      : port(one_radar), model_(model) {
    radar = make_navico_radar({.model = model, .standby_when_alone = standby_when_alone});
    const std::vector<std::uint16_t> ports(radar->listens().size());
    radar->begin(ipv4(192, 0, 2, 7), ports, now, port);
  }

  void tell(const Command& command, std::size_t listen = 0) {
    tell(navico::encode_command(command, navico::is_halo(model_)), listen);
  }
  void tell(const Bytes& octets, std::size_t listen = 0) {
    radar->on_datagram(listen, kDisplay, octets, now, port);
  }
  void pass(Duration duration) {
    for (const ScenarioTime end = now + duration; now < end;) {
      now += 10ms;
      radar->on_time(now, port);
    }
  }
  // The last report of the kind sent to `group` since the last look.
  template <typename T>
  std::optional<T> last(const Ipv4Endpoint& group) {
    std::optional<T> found;
    for (const SentDatagram& each : port.sent) {
      const auto report = navico::decode_report(each.payload);
      if (each.to != group || !report.ok()) continue;
      if (const T* mine = std::get_if<T>(&*report)) found = *mine;
    }
    port.sent.clear();
    return found;
  }
  template <typename T>
  std::optional<T> last() {
    return last<T>(navico::kAddressesA.report);
  }
  navico::RadarState state(const Ipv4Endpoint& group) {
    port.sent.clear();
    pass(2100ms);
    return last<navico::StateReport>(group)->state;
  }

  FakeDisplayPort port;
  ScenarioTime now{};
  std::unique_ptr<RadarEmulation> radar;

 private:
  Model model_;
};

TEST(NavicoRadar, BringsEveryLevelBackExactly) {
  Bench bench(Model::g4);
  for (int raw = 0; raw <= 255; ++raw) {
    bench.tell({CommandKind::gain, raw, 0});
    bench.tell({CommandKind::rain, raw});
    bench.tell({CommandKind::sea, raw, 0});
    bench.tell({CommandKind::side_lobe, raw, 0});
    bench.pass(10ms);
    const wire::Settings settings = bench.port.settings(kA);
    EXPECT_NEAR(settings.gain(), raw / 2.55, 1e-9);
    EXPECT_NEAR(settings.side_lobe_suppression(), raw / 2.55, 1e-9);
    std::optional<navico::ControlReport> controls;
    std::optional<navico::AdvancedReport> advanced;
    for (const SentDatagram& each : bench.port.sent) {
      const auto report = navico::decode_report(each.payload);
      if (each.to != navico::kAddressesA.report || !report.ok()) continue;
      if (const auto* c = std::get_if<navico::ControlReport>(&*report)) controls = *c;
      if (const auto* a = std::get_if<navico::AdvancedReport>(&*report)) advanced = *a;
    }
    bench.port.sent.clear();
    ASSERT_TRUE(controls && advanced) << raw;
    EXPECT_EQ(controls->gain, raw);
    EXPECT_EQ(controls->rain, raw);
    EXPECT_EQ(controls->sea, raw);
    EXPECT_EQ(advanced->side_lobe, raw);
  }
}

// A display shows whole percents, and cuts off or rounds: 50 used to leave as 127 and came back
// as 49.
TEST(NavicoRadar, TellsEveryPercentSoThatDisplaysShowIt) {
  for (const Model model : {Model::br24, Model::g3, Model::g4, Model::halo}) {
    Bench bench(model);
    for (int percent = 0; percent <= 100; ++percent) {
      wire::Settings& settings = bench.port.at(kA);
      settings.set_gain(percent);
      settings.set_rain(percent);
      bench.radar->on_settings(kA, bench.now, bench.port);
      bench.pass(200ms);
      const auto controls = bench.last<navico::ControlReport>();
      ASSERT_TRUE(controls) << percent;
      for (const int level : {controls->gain, controls->rain}) {
        EXPECT_EQ(level * 100 / 255, percent) << "cut off, level " << level;
        EXPECT_EQ(std::lround(level * 100.0 / 255.0), percent) << "rounded, level " << level;
      }
    }
  }
}

TEST(NavicoRadar, ObeysAHalosOwnCommands) {
  Bench bench(Model::halo);
  bench.tell({CommandKind::halo_sea_adjust, -20, 1});
  EXPECT_TRUE(bench.port.settings(kA).sea_auto());
  EXPECT_EQ(bench.port.settings(kA).sea(), 30.0);
  bench.tell({CommandKind::halo_sea, 77});
  EXPECT_FALSE(bench.port.settings(kA).sea_auto());
  EXPECT_EQ(bench.port.settings(kA).sea(), 77.0);
  bench.tell({CommandKind::doppler, 1});
  bench.tell({CommandKind::doppler_threshold, 250});
  bench.tell({CommandKind::target_separation, 2});
  bench.tell({CommandKind::noise_rejection, 3});
  bench.tell({CommandKind::expansion, 1});
  bench.tell({CommandKind::scan_speed, 3});
  bench.tell({CommandKind::bearing_alignment, 3592});
  bench.tell({CommandKind::antenna_height, 9000});
  bench.tell({CommandKind::blanking_angles, 1, 0, 2, 900, 1805});
  const wire::Settings settings = bench.port.settings(kA);
  EXPECT_EQ(settings.doppler(), wire::DOPPLER_BOTH);
  EXPECT_EQ(settings.doppler_threshold_mps(), 2.5);
  EXPECT_NEAR(settings.target_separation(), 200.0 / 3.0, 1e-9);
  EXPECT_EQ(settings.noise_rejection(), 100.0);
  EXPECT_NEAR(settings.echo_stretch(), 100.0 / 3.0, 1e-9);
  EXPECT_EQ(settings.rotation_rpm(), 48.0);
  EXPECT_NEAR(settings.bearing_alignment_deg(), -0.8, 1e-9);
  EXPECT_EQ(settings.antenna_height_m(), 9.0);
  ASSERT_EQ(settings.blanked_sectors().sectors_size(), 1);
  EXPECT_EQ(settings.blanked_sectors().sectors(0).from_deg(), 90.0);
  EXPECT_EQ(settings.blanked_sectors().sectors(0).to_deg(), 180.5);
  bench.tell({CommandKind::blanking_on, 0, 0, 2});
  EXPECT_EQ(bench.port.settings(kA).blanked_sectors().sectors_size(), 0);
  bench.pass(10ms);
  const auto blanking = bench.last<navico::BlankingReport>();
  ASSERT_TRUE(blanking.has_value());
  EXPECT_EQ(blanking->sectors[2], (navico::BlankedSector{false, 900, 1805}));
}

TEST(NavicoRadar, HasTheRangeADisplayChoseUntilSomebodyElseChoosesAnother) {
  for (const Model model : {Model::br24, Model::g4, Model::halo}) {
    Bench bench(model);
    for (const std::int32_t m :
         {50,   75,   100,  231,  250,  463,   500,   750,   926,   1500, 1852,
          3000, 3704, 4000, 6000, 7408, 12000, 14816, 22224, 36000, 44448}) {
      bench.tell({CommandKind::range, m * 10});
      const wire::Settings settings = bench.port.settings(kA);
      const double scale_m = settings.range_nm() * 1852.0;
      EXPECT_GE(scale_m + 1.0, m);
      EXPECT_LE(scale_m, std::max(2.0 * m + 1.0, 0.125 * 1852.0));
      bench.pass(10ms);
      EXPECT_EQ(bench.last<navico::ControlReport>()->range_dm, m * 10u);
      // The view reaches as far as the spoke, or a whole number of times as far.
      const double reach_m =
          navico::spoke_range(model, static_cast<std::uint32_t>(m * 10)).reach.in_metres();
      const double view_m = bench.radar->instrumented_range_m(kA, settings);
      EXPECT_GE(view_m, scale_m - 1e-6);
      EXPECT_LE(view_m, 2.0 * scale_m);
      EXPECT_NEAR(view_m / reach_m, std::round(view_m / reach_m), 1e-9);
    }
    bench.port.at(kA).set_range_nm(1.5);
    bench.radar->on_settings(kA, bench.now, bench.port);
    bench.pass(10ms);
    EXPECT_EQ(bench.last<navico::ControlReport>()->range_dm, 27780u);
    bench.port.at(kA).set_range_nm(96.0);
    bench.radar->on_settings(kA, bench.now, bench.port);
    bench.pass(10ms);
    EXPECT_EQ(bench.last<navico::ControlReport>()->range_dm, navico::max_range_dm(model));
  }
}

TEST(NavicoRadar, ReportsAtTheBeatOfARealOne) {
  Bench bench(Model::halo);
  bench.port.sent.clear();
  std::map<unsigned, std::vector<int>> ticks;
  for (int tick = 1; tick <= 3000; ++tick) {
    bench.pass(10ms);
    for (const Bytes& each : bench.port.take(navico::kAddressesA.report)) {
      ticks[each[0]].push_back(tick);
    }
    bench.port.sent.clear();
  }
  for (const auto& [kind, period] : std::map<unsigned, int>{{0x01, 200},
                                                            {0x11, 200},
                                                            {0x02, 500},
                                                            {0x03, 500},
                                                            {0x04, 500},
                                                            {0x06, 500},
                                                            {0x08, 500}}) {
    ASSERT_EQ(ticks[kind].size(), 3000u / static_cast<unsigned>(period)) << kind;
    for (std::size_t i = 0; i < ticks[kind].size(); ++i) {
      EXPECT_EQ(ticks[kind][i], period * static_cast<int>(i + 1)) << kind;
    }
  }
  bench.pass(10ms);
  bench.port.sent.clear();
  bench.tell({CommandKind::ask_controls});
  EXPECT_TRUE(bench.last<navico::ControlReport>().has_value());
  bench.tell({CommandKind::ask_identity});
  EXPECT_TRUE(bench.last<navico::IdentityReport>().has_value());
  bench.tell({CommandKind::ask_installation});
  EXPECT_TRUE(bench.last<navico::InstallationReport>().has_value());
}

TEST(NavicoRadar, TransmitsAfterItsAntennaCameUpToSpeed) {
  Bench bench(Model::halo);
  EXPECT_EQ(bench.last<navico::StateReport>()->state, navico::RadarState::standby);
  bench.pass(10ms);
  bench.tell({CommandKind::prepare, 1});
  bench.tell({CommandKind::transmit, 1});
  EXPECT_FALSE(bench.port.settings(kA).standby());
  EXPECT_EQ(bench.last<navico::StateReport>()->state, navico::RadarState::spinning_up);
  bench.pass(1500ms);
  EXPECT_EQ(bench.last<navico::StateReport>()->state, navico::RadarState::transmit);
  bench.tell({CommandKind::transmit, 0});
  EXPECT_TRUE(bench.port.settings(kA).standby());
  EXPECT_EQ(bench.last<navico::StateReport>()->state, navico::RadarState::standby);
  // At a console.
  bench.port.at(kA).set_standby(false);
  bench.radar->on_settings(kA, bench.now, bench.port);
  EXPECT_EQ(bench.state(navico::kAddressesA.report), navico::RadarState::transmit);
}

TEST(NavicoRadar, StopsItsTransmitterWhenNeitherRangeShowsAPicture) {
  Bench bench(Model::g4);
  const Ipv4Endpoint a = navico::kAddressesA.report, b = navico::kAddressesB.report;
  bench.tell({CommandKind::transmit, 1}, 0);
  EXPECT_EQ(bench.state(a), navico::RadarState::transmit);
  EXPECT_EQ(bench.state(b), navico::RadarState::standby);
  bench.tell({CommandKind::transmit, 1}, 1);
  EXPECT_EQ(bench.state(b), navico::RadarState::transmit);
  bench.tell({CommandKind::transmit, 0}, 0);
  EXPECT_FALSE(bench.port.settings(kA).standby());
  EXPECT_EQ(bench.state(a), navico::RadarState::standby);
  EXPECT_EQ(bench.state(b), navico::RadarState::transmit);
  bench.tell({CommandKind::transmit, 0}, 1);
  EXPECT_TRUE(bench.port.settings(kB).standby());
  // The controls of the two are their own.
  bench.tell({CommandKind::gain, 10, 0}, 1);
  EXPECT_NEAR(bench.port.settings(kB).gain(), 10 / 2.55, 1e-9);
  EXPECT_EQ(bench.port.settings(kA).gain(), 50.0);
}

TEST(NavicoRadar, GoesToStandbyWhenNoDisplayIsLeft) {
  Bench bench(Model::g4, 20s);
  bench.tell({CommandKind::transmit, 1});
  for (int i = 0; i < 10; ++i) {
    bench.pass(15s);
    bench.tell({CommandKind::stay_alive});
  }
  EXPECT_FALSE(bench.port.settings(kA).standby());
  bench.pass(19s);
  EXPECT_FALSE(bench.port.settings(kA).standby());
  bench.pass(2s);
  EXPECT_TRUE(bench.port.settings(kA).standby());
  EXPECT_EQ(bench.last<navico::StateReport>()->state, navico::RadarState::standby);
  Bench patient(Model::g4);
  patient.tell({CommandKind::transmit, 1});
  patient.pass(60s);
  EXPECT_FALSE(patient.port.settings(kA).standby());
}

TEST(NavicoRadar, CountsWhatItDoesNotObey) {
  Bench bench(Model::g4);
  bench.port.changes.clear();
  bench.tell(Bytes{0x03});
  bench.tell(Bytes{0x03, 0xC1, 0x16});
  bench.tell(Bytes{0xFF, 0xC1, 0x16});
  bench.tell(Bytes(65, 0x03));
  EXPECT_EQ(bench.port.counts["navico truncated command"], 2u);
  EXPECT_EQ(bench.port.counts["navico unknown kind command"], 1u);
  EXPECT_EQ(bench.port.counts["navico oversized command"], 1u);
  bench.tell({CommandKind::range, 499});
  bench.tell({CommandKind::range, 666'721});
  bench.tell({CommandKind::transmit, 2});
  bench.tell({CommandKind::mode, 6});
  bench.tell({CommandKind::bearing_alignment, 3600});
  bench.tell({CommandKind::blanking_on, 1, 0, 4});
  bench.tell({CommandKind::sea, 10, 3});
  bench.tell({CommandKind::doppler, 1});  // a 4G has none
  EXPECT_EQ(bench.port.counts["navico command out of range"], 8u);
  EXPECT_TRUE(bench.port.changes.empty());
  EXPECT_NE(bench.port.last_detail.find("192.0.2.9:4000"), std::string::npos);
  // A step beyond the last is the last.
  bench.tell({CommandKind::interference, 9});
  EXPECT_EQ(bench.port.settings(kA).interference_rejection(), 100.0);
}

TEST(NavicoRadar, SaysTheOldValueOfALockedControl) {
  Bench bench(Model::g4);
  bench.tell({CommandKind::gain, 100, 0});
  bench.tell({CommandKind::range, 4630});
  bench.pass(10ms);
  bench.port.sent.clear();
  bench.port.refusal = "gain is locked by the instructor";
  bench.tell({CommandKind::gain, 200, 0});
  bench.pass(10ms);
  EXPECT_EQ(bench.last<navico::ControlReport>()->gain, 100);
  bench.tell({CommandKind::range, 7500});
  bench.tell({CommandKind::transmit, 1});
  bench.pass(10ms);
  EXPECT_EQ(bench.last<navico::ControlReport>()->range_dm, 4630u);
  EXPECT_EQ(bench.state(navico::kAddressesA.report), navico::RadarState::standby);
  EXPECT_EQ(bench.port.counts["navico command refused"], 3u);
}

TEST(NavicoRadar, AnswersTenThousandCommandsWithBoundedReports) {
  Bench bench(Model::halo);
  bench.port.sent.clear();
  for (int i = 0; i < 10'000; ++i) {
    bench.tell(i % 2 == 0 ? Command{CommandKind::gain, i % 256, 0}
                          : Command{CommandKind::ask_controls});
    if (i % 100 == 99) bench.pass(10ms);
  }
  bench.pass(10ms);
  // One second: at most every 2 ms one of each kind.
  EXPECT_LT(bench.port.sent.size(), 2500u);
  EXPECT_EQ(bench.last<navico::ControlReport>()->gain, 9998 % 256);
}

TEST(NavicoRadar, IsFoundByItsLocator) {
  for (const Model model : {Model::g4, Model::halo20, Model::halo}) {
    Bench bench(model);
    const std::size_t locator = bench.radar->listens().size() - 1;
    EXPECT_EQ(bench.radar->listens()[locator].at, navico::kLocatorGroup);
    bench.port.sent.clear();
    bench.tell(navico::encode_locator_question(), locator);
    const auto answers = bench.port.take(navico::kLocatorGroup);
    ASSERT_EQ(answers.size(), 1u);
    EXPECT_EQ(answers[0].size(), navico::has_two_ranges(model) ? 222u : 150u);
    const auto read = navico::decode_locator(answers[0]);
    ASSERT_TRUE(read.ok());
    EXPECT_EQ(read->radar.address, ipv4(192, 0, 2, 7));
    EXPECT_EQ(read->find_picture(1), navico::kAddressesA);
    EXPECT_EQ(read->find_picture(2).has_value(), navico::has_two_ranges(model));
    const std::string family = read->serial.substr(0, 2);
    EXPECT_EQ(family == "14" || family == "13", model == Model::g4) << read->serial;
    for (int i = 0; i < 100; ++i) bench.tell(navico::encode_locator_question(), locator);
    bench.tell(answers[0], locator);  // another radar's
    bench.pass(60ms);
    EXPECT_EQ(bench.port.take(navico::kLocatorGroup).size(), 1u);
    EXPECT_TRUE(bench.port.counts.empty());
  }
  EXPECT_EQ(Bench(Model::br24).radar->listens().size(), 1u);
}

TEST(NavicoRadar, TellsAHalosNetworkHowTheShipMoves) {
  Bench bench(Model::halo);
  bench.port.sent.clear();
  bench.pass(10s);
  const auto ship = bench.port.take(navico::kHeadingGroup);
  std::size_t headings = 0, navigations = 0;
  for (const Bytes& each : ship) {
    const auto packet = navico::decode_ship_packet(each);
    ASSERT_TRUE(packet.ok());
    if (const auto* heading = std::get_if<navico::HeadingPacket>(&*packet)) {
      EXPECT_NEAR(heading->heading_deg, 123.4, 0.003);
      ++headings;
    } else {
      const auto& navigation = std::get<navico::NavigationPacket>(*packet);
      EXPECT_NEAR(navigation.course_deg, 126.7, 0.003);
      EXPECT_NEAR(navigation.speed_mps, 5.144, 0.006);
      ++navigations;
    }
  }
  EXPECT_EQ(headings, 100u);
  EXPECT_EQ(navigations, 40u);
  for (const Ipv4Endpoint& group : navico::kSpeedGroups) {
    EXPECT_EQ(bench.port.take(group).size(), 20u);
  }
  const auto presence = bench.port.take(navico::kPresenceGroup);
  EXPECT_EQ(presence.size(), 10u);
  EXPECT_EQ(presence.at(0), (Bytes{0x02, 0xA1, 0x20, 0x01}));
}

TEST(NavicoRadar, OfAFixedFamilySaysWhichAddressesItNeeds) {
  const EmulationIdentity br24 = navico_identity({.model = Model::br24});
  EXPECT_EQ(br24.family, "Navico BR24");
  EXPECT_EQ(br24.fixed_addresses.size(), 3u);
  EXPECT_EQ(navico_identity({.model = Model::g4}).fixed_addresses.size(), 6u);
  EXPECT_EQ(navico_identity({.model = Model::g4, .second_range = false}).fixed_addresses.size(),
            3u);
}

}  // namespace
}  // namespace skerry::server
