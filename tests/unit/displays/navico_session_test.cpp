// The displays of the recordings, again, at our radar: the commands they sent drive it to the same
// states, and its reports are those of the recorded radar.
#include <gtest/gtest.h>

#include <algorithm>
#include <optional>

#include "protocol/navico/command.hpp"
#include "protocol/navico/report.hpp"
#include "server/displays/navico/navico_radar.hpp"
#include "tests/unit/displays/fake_display_port.hpp"
#include "tests/unit/pcap/radar_captures.hpp"

namespace skerry::server {
namespace {

using navico::Command;
using navico::CommandKind;
using navico::Model;

struct Session {
  const char* file;
  Model model;
  navico::Addresses a, b;
  bool second_range;
  // Counts of the recording, so that a replay of nothing fails.
  std::size_t commands, ranges;
  std::vector<navico::RadarState> states_of_a;
};

constexpr navico::RadarState kStandby = navico::RadarState::standby,
                             kSpinning = navico::RadarState::spinning_up,
                             kTransmit = navico::RadarState::transmit;

navico::Addresses groups(std::uint32_t third, std::uint32_t data, std::uint32_t send,
                         std::uint32_t report, int port) {
  const auto at = [&](std::uint32_t last, std::uint32_t first) {
    return Ipv4Endpoint{ipv4(236, 6, third, last),
                        static_cast<std::uint16_t>(port + static_cast<int>(last - first))};
  };
  return {at(data, data), at(send, data), at(report, data)};
}

const std::vector<Session>& sessions() {
  using navico::kAddressesA;
  using navico::kAddressesB;
  static const std::vector<Session> all = {
      {"br24-ranges-nm.pcap.gz",
       Model::br24,
       kAddressesA,
       kAddressesB,
       false,
       134,
       18,
       {kTransmit}},
      {"3g-trueheading.pcap.gz",
       Model::g3,
       kAddressesA,
       kAddressesB,
       false,
       20,
       2,
       {kStandby, kSpinning, kTransmit, kStandby, kSpinning, kTransmit, kStandby}},
      {"4g-ranges-nm.pcap.gz",
       Model::g4,
       kAddressesA,
       kAddressesB,
       true,
       143,
       17,
       {kStandby, kSpinning, kTransmit}},
      {"halo20-ranges.pcap.gz",
       Model::halo20,
       kAddressesA,
       kAddressesB,
       false,
       75,
       29,
       {kStandby, kSpinning, kTransmit}},
      {"halo3-5-connect-transmit.pcap.gz",
       Model::halo,
       groups(7, 100, 101, 102, 6132),
       groups(7, 103, 104, 105, 6135),
       true,
       8,
       0,
       {kStandby, kSpinning, kTransmit, kStandby}},
      {"halo-velocitytrack-notarget.pcap.gz",
       Model::halo,
       groups(8, 33, 34, 35, 6515),
       groups(8, 38, 39, 37, 6518),
       true,
       0,
       0,
       {kTransmit}},
  };
  return all;
}

// The last report of each kind that a range has sent.
struct Reports {
  std::optional<navico::StateReport> state;
  std::optional<navico::ControlReport> controls;
  std::optional<navico::InstallationReport> installation;
  std::optional<navico::BlankingReport> blanking;
  std::optional<navico::AdvancedReport> advanced;
  std::vector<navico::RadarState> states;  // each as it became another

  void take(const navico::Report& report) {
    std::visit([&](const auto& each) { keep(each); }, report);
  }

 private:
  void keep(const navico::StateReport& report) {
    state = report;
    if (states.empty() || states.back() != report.state) states.push_back(report.state);
  }
  void keep(const navico::ControlReport& report) { controls = report; }
  void keep(const navico::InstallationReport& report) { installation = report; }
  void keep(const navico::BlankingReport& report) { blanking = report; }
  void keep(const navico::AdvancedReport& report) { advanced = report; }
  void keep(const navico::IdentityReport&) {}
  void keep(const navico::HeartbeatReport&) {}
};

class NavicoSession : public testing::TestWithParam<Session> {
 protected:
  void SetUp() override {
    if (!have_radar_captures()) GTEST_SKIP() << kNoRadarCaptures;
    recorded_ = read_radar_capture(GetParam().file);
    NavicoOptions options;
    options.model = GetParam().model;
    options.second_range = GetParam().second_range;
    options.a = GetParam().a;
    options.b = GetParam().b;
    radar_ = make_navico_radar(options);
    const std::vector<std::uint16_t> ports(radar_->listens().size());
    radar_->begin(ipv4(127, 0, 0, 1), ports, now_, port_);
  }

  std::size_t channels() const { return GetParam().second_range ? 2 : 1; }
  const navico::Addresses& at(std::size_t channel) const {
    return channel == 0 ? GetParam().a : GetParam().b;
  }
  std::optional<std::size_t> channel_of(const Ipv4Endpoint& report_group) const {
    for (std::size_t c = 0; c < channels(); ++c) {
      if (at(c).report == report_group) return c;
    }
    return std::nullopt;
  }

  void command(std::size_t channel, const Command& command) {
    send(channel, navico::encode_command(command, navico::is_halo(GetParam().model)));
  }
  void send(std::size_t channel, const Bytes& octets) {
    radar_->on_datagram(channel, {ipv4(192, 0, 2, 9), 4000}, octets, now_, port_);
    collect();
  }
  void advance(ScenarioTime to) {
    while (now_ + kTick <= to) {
      now_ += kTick;
      radar_->on_time(now_, port_);
    }
    collect();
  }
  void collect() {
    for (const SentDatagram& each : port_.sent) {
      const auto channel = channel_of(each.to);
      if (!channel) continue;
      const auto report = navico::decode_report(each.payload);
      ASSERT_TRUE(report.ok()) << report.error().text;
      ours_[*channel].take(*report);
    }
    port_.sent.clear();
  }

  void set_up_as_recorded();
  void set_up(std::size_t channel, const navico::ControlReport& first);
  void set_up(std::size_t channel, const navico::AdvancedReport& first);
  void set_up(std::size_t channel, const navico::InstallationReport& first);

  static constexpr Duration kTick = std::chrono::milliseconds(10);
  std::vector<CapturedDatagram> recorded_;
  std::unique_ptr<RadarEmulation> radar_;
  FakeDisplayPort port_;
  ScenarioTime now_{};
  Reports ours_[2];
};

void NavicoSession::set_up(std::size_t channel, const navico::ControlReport& first) {
  using K = CommandKind;
  command(channel, {K::range, static_cast<std::int32_t>(first.range_dm)});
  command(channel, {K::mode, first.mode});
  command(channel, {K::gain, first.gain, first.gain_auto});
  if (!navico::is_halo(GetParam().model)) {
    command(channel, {K::sea, first.sea, first.sea_auto});
  }
  command(channel, {K::rain, first.rain});
  command(channel, {K::interference, first.interference});
  command(channel, {K::expansion, first.expansion});
  command(channel, {K::boost, first.boost});
}

void NavicoSession::set_up(std::size_t channel, const navico::AdvancedReport& first) {
  using K = CommandKind;
  command(channel, {K::sea_state, first.sea_state});
  command(channel, {K::local_interference, first.local_interference});
  command(channel, {K::scan_speed, first.scan_speed});
  command(channel, {K::side_lobe, first.side_lobe, first.side_lobe_auto});
  command(channel, {K::noise_rejection, first.noise_rejection});
  command(channel, {K::target_separation, first.target_separation});
  if (!navico::is_halo(GetParam().model)) return;
  command(channel, {K::halo_sea, first.halo_sea});
  command(channel, {K::halo_sea_adjust, first.halo_sea_adjust});
  command(channel, {K::doppler, first.doppler});
  command(channel, {K::doppler_threshold, first.doppler_threshold_cms});
}

void NavicoSession::set_up(std::size_t channel, const navico::InstallationReport& first) {
  using K = CommandKind;
  command(channel, {K::bearing_alignment, first.bearing_alignment});
  command(channel, {K::parking, first.parking});
  command(channel, {K::antenna_height, first.antenna_height_mm});
  command(channel, {K::accent_light, first.accent_light});
  if (!navico::is_halo(GetParam().model)) return;
  for (std::uint8_t s = 0; s < first.sectors.size(); ++s) {
    const navico::BlankedSector& each = first.sectors[s];
    command(channel, {K::blanking_angles, each.on ? 1 : 0, 0, s, each.from, each.to});
  }
}

// Sets it up by commands, so that the recorded radar's earlier settings are a session too.
void NavicoSession::set_up_as_recorded() {
  Reports first[2];
  bool transmits[2] = {false, false}, commanded = false;
  for (const CapturedDatagram& each : recorded_) {
    commanded = commanded || each.to == at(0).send;
    const auto channel = channel_of(each.to);
    const auto report = navico::decode_report(each.payload);
    if (!channel || !report.ok()) continue;
    Reports& mine = first[*channel];
    if (!mine.controls && std::holds_alternative<navico::ControlReport>(*report))
      mine.take(*report);
    if (!mine.advanced && std::holds_alternative<navico::AdvancedReport>(*report)) {
      mine.take(*report);
    }
    if (!mine.installation && std::holds_alternative<navico::InstallationReport>(*report)) {
      mine.take(*report);
    }
    if (!mine.state && !commanded && std::holds_alternative<navico::StateReport>(*report)) {
      mine.take(*report);
      transmits[*channel] = mine.state->state == kTransmit;
    }
  }
  for (std::size_t c = 0; c < channels(); ++c) {
    if (first[c].controls) set_up(c, *first[c].controls);
    if (first[c].advanced) set_up(c, *first[c].advanced);
    if (first[c].installation) set_up(c, *first[c].installation);
    if (transmits[c]) command(c, {CommandKind::transmit, 1});
  }
  advance(now_ + std::chrono::seconds(3));
  for (Reports& each : ours_) {
    if (each.state) each.states = {each.state->state};
  }
  port_.counts.clear();
}

TEST_P(NavicoSession, ReplayedDrivesOurRadarToTheSameStatesAndReports) {
  set_up_as_recorded();
  const ScenarioTime start = now_;
  std::size_t commands = 0, ranges = 0, compared = 0;
  Reports theirs[2];
  for (const CapturedDatagram& each : recorded_) {
    advance(start + (each.time - recorded_.front().time));
    if (each.to == at(0).send) {
      const auto read = navico::decode_command(each.payload);
      ASSERT_TRUE(read.ok());
      ++commands;
      ranges += read->kind == CommandKind::range;
      send(0, each.payload);
      continue;
    }
    const auto channel = channel_of(each.to);
    const auto report = navico::decode_report(each.payload);
    if (!channel || !report.ok()) continue;
    const auto* state = std::get_if<navico::StateReport>(&*report);
    if (state != nullptr && state->state == navico::RadarState::off) {
      // The recorded 3G has gone off by itself: our radar is switched off at its console.
      if (!port_.at(RangeChannel::a).standby()) {
        port_.at(RangeChannel::a).set_standby(true);
        radar_->on_settings(RangeChannel::a, now_, port_);
      }
      theirs[*channel].take(navico::StateReport{kStandby});
      continue;
    }
    theirs[*channel].take(*report);
    const Reports& mine = ours_[*channel];
    ++compared;
    if (std::holds_alternative<navico::ControlReport>(*report)) {
      EXPECT_EQ(mine.controls, theirs[*channel].controls)
          << compared << ": range " << mine.controls->range_dm << " instead of "
          << theirs[*channel].controls->range_dm << " dm";
    }
    if (std::holds_alternative<navico::AdvancedReport>(*report)) {
      navico::AdvancedReport expected = *theirs[*channel].advanced;
      // A HALO20 has no Doppler; what it says of one is not ours to set.
      if (!navico::has_doppler(GetParam().model)) expected.doppler_threshold_cms = 0;
      // Its ranges wish for a speed each; ours share the antenna's.
      if (channels() == 2) expected.scan_speed = mine.advanced->scan_speed;
      EXPECT_EQ(*mine.advanced, expected) << compared;
    }
    if (std::holds_alternative<navico::InstallationReport>(*report)) {
      EXPECT_EQ(mine.installation, theirs[*channel].installation) << compared;
    }
    if (std::holds_alternative<navico::BlankingReport>(*report)) {
      EXPECT_EQ(mine.blanking, theirs[*channel].blanking) << compared;
    }
  }
  EXPECT_EQ(commands, GetParam().commands);
  EXPECT_EQ(ranges, GetParam().ranges);
  EXPECT_GT(compared, 5u);
  for (std::size_t c = 0; c < channels(); ++c) {
    if (theirs[c].states.empty()) continue;
    std::vector<navico::RadarState> expected = theirs[c].states;
    // A recording that begins with the command that starts the radar.
    if (expected.front() == kSpinning) expected.insert(expected.begin(), kStandby);
    EXPECT_EQ(ours_[c].states, expected) << "range " << c;
    if (c == 0) {
      EXPECT_EQ(expected, GetParam().states_of_a);
    }
  }
  // The one command of a recording that no radar of that kind obeys: 36 NM at a HALO20, twice.
  const std::uint64_t ignored = GetParam().model == Model::halo20 ? 2 : 0;
  EXPECT_EQ(port_.counts["navico command out of range"], ignored);
}

INSTANTIATE_TEST_SUITE_P(Recordings, NavicoSession, testing::ValuesIn(sessions()),
                         [](const auto& each) { return test_name_of(each.param.file); });

}  // namespace
}  // namespace skerry::server
