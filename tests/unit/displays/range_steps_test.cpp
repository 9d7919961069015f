// Every step from one range to another of every emulated radar, by a display and by a console: the
// spokes that leave afterwards have a point echo where it is, and none in between says a range that
// nobody chose.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <functional>
#include <ostream>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "protocol/captures/picture_decoder.hpp"
#include "protocol/garmin/xhd_packet.hpp"
#include "protocol/garmin/xhd_reports.hpp"
#include "protocol/navico/command.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/navico/report.hpp"
#include "protocol/raymarine/quantum_command.hpp"
#include "protocol/raymarine/quantum_report.hpp"
#include "protocol/video/range_scale.hpp"
#include "server/app/options/charts.hpp"
#include "server/app/radar_server.hpp"
#include "server/displays/emulated_radars.hpp"
#include "server/net/net_server.hpp"
#include "server/world/scenario.hpp"
#include "tests/unit/net/display_socket.hpp"
#include "tests/unit/net/test_client.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

// Each dialect is at an address of its own, so that all can be tried at once.
constexpr std::uint32_t kFirstAddress = ipv4(127, 0, 0, 61);
constexpr std::uint32_t kTurnSpokes = 2048, kRowCells = 1024, kBlocks = 16;
constexpr const char* kScenario =
    "name: s\nown_ships: [{name: F, position: {lat: 60, lon: 5}, radars: [{}]}]\n";
constexpr std::uint8_t kGround = 40;  // everywhere, so that rows that end too soon are seen
constexpr double kEchoShare = 0.55;   // of the range

struct Dialect {
  const char* name;  // of the emulated radar
  captures::Family family;
  navico::Model model = navico::Model::g4;
  std::vector<double> ranges_m;
  std::function<Bytes(std::size_t range)> command;
  Bytes nothing;  // a command that changes nothing
};

void PrintTo(const Dialect& dialect, std::ostream* out) { *out << dialect.name; }

// What radar_pi offers: every range that the display of such a radar can choose, m.
std::vector<double> navico_ranges(navico::Model model) {
  std::vector<double> ranges;
  for (const double nm : {1.0 / 16, 1.0 / 8, 0.25, 3.0 / 8, 0.5,  0.75, 1.0,  1.5,  2.0,  3.0, 4.0,
                          6.0,      8.0,     12.0, 16.0,    24.0, 32.0, 36.0, 48.0, 64.0, 72.0}) {
    const double metres = nm * 1852.0;
    if (std::llround(metres * 10.0) <= navico::max_range_dm(model)) ranges.push_back(metres);
  }
  return ranges;
}

Dialect navico_dialect(const char* name, navico::Model model) {
  const std::vector<double> ranges = navico_ranges(model);
  return {name,
          captures::Family::navico,
          model,
          ranges,
          [ranges](std::size_t i) {
            return navico::encode_command(
                {.kind = navico::CommandKind::range,
                 .value = static_cast<std::int32_t>(std::llround(ranges[i] * 10.0))});
          },
          navico::encode_command({.kind = navico::CommandKind::stay_alive})};
}

Dialect garmin_dialect() {
  return {"garmin_xhd",
          captures::Family::garmin,
          {},
          {garmin::kRanges.begin(), garmin::kRanges.end()},
          [](std::size_t i) {
            return garmin::encode_packet(garmin::Type::range, 4, garmin::kRanges[i]);
          },
          garmin::encode_packet(garmin::Type::gain_auto_level, 1, 0)};
}

Dialect quantum_dialect() {
  std::vector<double> ranges;
  for (const auto range : raymarine::kQuantumRanges) ranges.push_back(range * 1.852);
  return {"raymarine_quantum",
          captures::Family::quantum,
          {},
          ranges,
          [](std::size_t i) {
            return raymarine::encode_quantum_command(raymarine::QuantumControl::range_index,
                                                     static_cast<std::int32_t>(i));
          },
          raymarine::encode_quantum_command(raymarine::QuantumControl::stay_alive, 0)};
}

std::vector<Dialect> all_dialects() {
  return {navico_dialect("navico_br24", navico::Model::br24),
          navico_dialect("navico_3g", navico::Model::g3),
          navico_dialect("navico_4g", navico::Model::g4),
          navico_dialect("navico_halo", navico::Model::halo),
          garmin_dialect(),
          quantum_dialect()};
}

// A closed walk over every ordered pair of 0 .. count-1.
std::vector<std::size_t> every_step(std::size_t count) {
  std::vector<std::size_t> walk;
  for (std::size_t i = 0; i < count; ++i) {
    walk.push_back(i);
    for (std::size_t j = i + 2; j < count; ++j) walk.insert(walk.end(), {j, i});
  }
  for (std::size_t i = count; i-- > 0;) walk.push_back(i);
  return walk;
}

// A server without antennas, whose spokes the test makes, and a display of its emulated radar.
class Exchange {
 public:
  explicit Exchange(const Dialect& dialect, std::uint32_t address = kFirstAddress)
      : address_(address),
        row_(*find_emulated_radar(dialect.name)),
        probe_(row_.make({})),
        server_(parse_scenario(kScenario, "test.yaml"), open_charts({}, {}), 0, {}),
        net_(server_, config(), {}),
        data_(probe_->data_address(RangeChannel::a), address_),
        sends_({0, 0}, address_) {
    commands_ = probe_->listens().front().at;
    if (commands_.address == 0) commands_.address = address_;
    shown_ = server_.views(0).back().number;
    captures::PictureTraits traits;
    traits.key = {dialect.family, address_, probe_->data_address(RangeChannel::a), 0};
    traits.model = dialect.model;
    decoder_ = captures::make_picture(traits);
    net_.start();
  }

  // Returns once it has been obeyed.
  void command(const Bytes& bytes, const Bytes& nothing) {
    commands_sent_ += 2;
    sends_.send(commands_, bytes);
    sends_.send(commands_, nothing);
    while (net_.status().outputs(0).commands() < commands_sent_) std::this_thread::sleep_for(200us);
    if (net_.status().outputs(0).commands_dropped() > 0)
      throw std::runtime_error("too many commands");
    std::this_thread::sleep_for(11ms);  // two of the 200 commands that it takes in a second
  }
  // As a console, which knows nothing of the display.
  void console(const wire::Set& set) {
    ASSERT_EQ(server_.apply(set, "console").code(), wire::Reply::OK);
  }
  void console(double range_nm) {
    wire::Set set;
    set.set_range_nm(range_nm);
    console(set);
  }
  // Whether the rows of the view are as long as those of a radar that no display has set.
  bool is_fitted() const {
    return server_.settings(0, shown_).instrumented_range_m() ==
           probe_->instrumented_range_m(RangeChannel::a, server_.settings(0, 0));
  }

  // The next sixteenth of a turn, as the view's settings have it now, with an echo so far away.
  void publish(double echo_m, Duration spoke_time = 1us) {
    const wire::Settings settings = server_.settings(0, shown_);
    Sector sector;
    for (std::uint32_t i = 0; i < kTurnSpokes / kBlocks; ++i, ++sequence_) {
      Spoke spoke;
      spoke.header.view = shown_;
      spoke.header.sequence = sequence_;
      spoke.header.index = static_cast<std::uint32_t>(sequence_ % kTurnSpokes);
      spoke.header.scan = static_cast<std::uint32_t>(sequence_ / kTurnSpokes);
      spoke.header.geometry = {kTurnSpokes, kRowCells, 8};
      spoke.header.range_scale = *RangeScale::find(settings.range_nm());
      spoke.header.instrumented_range = metres(settings.instrumented_range_m());
      spoke.header.scenario_time = ScenarioTime(spoke_time * static_cast<std::int64_t>(sequence_));
      spoke.cells.resize(kRowCells, kGround);
      const auto cell = static_cast<std::size_t>(echo_m / spoke.header.cell_size().in_metres());
      if (cell < kRowCells) spoke.cells[cell] = 250;
      sector.spokes.push_back(std::make_shared<const Spoke>(std::move(spoke)));
    }
    server_.find_channel(0, shown_)->publish(sector);
  }
  // Of the middle half of the last block published; waits for it.
  std::vector<captures::CapturedSpoke> receive() {
    const double begin =
        std::fmod(static_cast<double>(sequence_) / kTurnSpokes + 1.0 - 0.75 / kBlocks, 1.0);
    std::vector<captures::CapturedSpoke> mine;
    for (bool past = false; !past;) {
      for (const captures::CapturedSpoke& spoke : next()) {
        const double at = static_cast<double>(spoke.index) / spoke.spokes_per_turn;
        const double into = std::fmod(at - begin + 1.0, 1.0) * kBlocks;
        if (into < 0.5) mine.push_back(spoke);
        past = past || (!mine.empty() && into >= 0.45 && into < 0.75);
      }
    }
    return mine;
  }
  // Those that come within `patience`.
  std::vector<captures::CapturedSpoke> next(std::chrono::milliseconds patience = 30s) {
    std::vector<captures::CapturedSpoke> spokes;
    const auto received = data_.receive(address_, patience);
    if (!received) {
      if (patience >= 30s) throw std::runtime_error("no spoke came");
      return spokes;
    }
    ++datagrams_;
    const pcap::Datagram datagram{.time = {},
                                  .from = received->from,
                                  .to = probe_->data_address(RangeChannel::a),
                                  .payload = received->payload};
    decoder_->hear(datagram);
    if (!captures::picture_of(datagram)) return spokes;
    if (const auto wrong = decoder_->decode(datagram, spokes))
      throw std::runtime_error(wrong->text);
    for (const captures::CapturedSpoke& spoke : spokes) {
      if (spoke.index == last_index_) ++repeated;
      last_index_ = spoke.index;
    }
    return spokes;
  }

  // Until nothing comes for 2 ms.
  std::vector<captures::CapturedSpoke> all_that_came() {
    std::vector<captures::CapturedSpoke> spokes;
    for (std::uint64_t before = UINT64_MAX; before != datagrams_;) {
      before = datagrams_;
      const auto some = next(2ms);
      spokes.insert(spokes.end(), some.begin(), some.end());
    }
    return spokes;
  }

  // The datagrams of spokes, until none comes for so long.
  std::vector<DisplaySocket::Received> data_of(std::chrono::milliseconds patience) {
    std::vector<DisplaySocket::Received> all;
    while (auto received = data_.receive(address_, patience)) all.push_back(std::move(*received));
    return all;
  }

  unsigned repeated = 0;  // azimuths that came twice running

 private:
  NetConfig config() const {
    NetConfig config = test_config();
    DisplayOutputConfig display;
    display.name = row_.name;
    display.make = [this] { return row_.make({}); };
    display.identity = row_.identity({});
    const std::string at = text_of({address_, 0});
    display.interface_address = at.substr(0, at.find(':'));
    config.displays = {display};
    return config;
  }

  const std::uint32_t address_;
  const EmulatedRadar& row_;
  std::unique_ptr<RadarEmulation> probe_;
  RadarServer server_;
  NetServer net_;
  DisplaySocket data_, sends_;
  Ipv4Endpoint commands_;
  std::uint32_t shown_ = 0;
  std::unique_ptr<captures::PictureDecoder> decoder_;
  std::uint64_t sequence_ = 0, commands_sent_ = 0;
  std::uint32_t last_index_ = UINT32_MAX;
  std::uint64_t datagrams_ = 0;
};

// Where the strongest cell is, m.
double echo_of(const captures::CapturedSpoke& spoke) {
  const auto strongest = std::max_element(spoke.cells.begin(), spoke.cells.end());
  if (*strongest == 0) return 0.0;
  const double cell = static_cast<double>(strongest - spoke.cells.begin()) + 0.5;
  return cell / static_cast<double>(spoke.cells.size()) * spoke.reach.in_metres();
}

class RangeSteps : public testing::TestWithParam<Dialect> {};

void try_every_step(const Dialect& dialect, std::uint32_t address) {
  Exchange exchange(dialect, address);
  double worst = 0.0;
  std::size_t steps = 0;
  double before_m = 0.0;
  for (const std::size_t range : every_step(dialect.ranges_m.size())) {
    const double range_m = dialect.ranges_m[range];
    exchange.command(dialect.command(range), dialect.nothing);
    exchange.publish(kEchoShare * range_m);
    for (const captures::CapturedSpoke& spoke : exchange.receive()) {
      const double off = std::abs(echo_of(spoke) / range_m - kEchoShare);
      worst = std::max(worst, off);
      ASSERT_LT(off, 0.004) << dialect.name << ": from " << before_m << " to " << range_m
                            << " m, the echo at " << kEchoShare * range_m << " m stands at "
                            << echo_of(spoke) << " m of " << spoke.reach.in_metres();
      ASSERT_GE(spoke.reach.in_metres(), 0.99 * range_m) << "the picture ends before the range";
      ASSERT_GT(spoke.cells.back(), 0) << dialect.name << ": from " << before_m << " to " << range_m
                                       << " m, the rows end before the spoke";
      if (dialect.family != captures::Family::navico) {  // which say their reach alone
        ASSERT_NEAR(spoke.nominal.in_metres(), range_m, 0.5)
            << dialect.name << ": from " << before_m << ", the spoke says another range";
      }
    }
    before_m = range_m;
    ++steps;
  }
  EXPECT_EQ(exchange.repeated, 0u) << "azimuths that left twice";
  std::printf(
      "%s: %zu ranges, %zu steps by a display, an echo off by at most %.2f %% of the range\n",
      dialect.name, dialect.ranges_m.size(), steps - 1, 100.0 * worst);
}

TEST_P(RangeSteps, AConsolesStepShowsNoRangeInBetween) {
  const Dialect& dialect = GetParam();
  Exchange exchange(dialect);
  std::vector<double> scales;
  for (const double nm : RangeScale::kNauticalMiles) {
    if (nm * 1852.0 <= dialect.ranges_m.back() * 1.01) scales.push_back(nm);
  }
  // Where the display last stood on a range that is no scale of ours.
  const auto odd =
      static_cast<std::size_t>(std::find_if(dialect.ranges_m.begin(), dialect.ranges_m.end(),
                                            [](double m) { return m > 3.5 * 1852.0; }) -
                               dialect.ranges_m.begin());
  exchange.command(dialect.command(odd), dialect.nothing);
  std::size_t steps = 0;
  double before_nm = scales.front(), before_m = 0.0;
  for (const std::size_t scale : every_step(scales.size())) {
    const double nm = scales[scale], echo_m = kEchoShare * nm * 1852.0;
    exchange.console(nm);
    std::vector<double> reaches;
    const auto keep = [&](const std::vector<captures::CapturedSpoke>& spokes) {
      for (const auto& spoke : spokes) reaches.push_back(spoke.reach.in_metres());
    };
    // At first the view has the new scale, and not yet the fit to it.
    do {
      exchange.publish(echo_m);
      keep(exchange.all_that_came());
    } while (!exchange.is_fitted());
    exchange.publish(echo_m);
    const auto spokes = exchange.receive();
    keep(spokes);
    for (const captures::CapturedSpoke& spoke : spokes) {
      ASSERT_NEAR(echo_of(spoke) / echo_m, 1.0, 0.0075)
          << dialect.name << ": from " << before_nm << " to " << nm << " NM";
    }
    const double reach_m = spokes.back().reach.in_metres();
    for (const double seen_m : reaches) {
      ASSERT_TRUE(seen_m == reach_m || seen_m == before_m || before_m == 0.0)
          << dialect.name << ": from " << before_nm << " to " << nm << " NM a spoke reached "
          << seen_m << " m, before " << before_m << ", after " << reach_m;
    }
    before_nm = nm;
    before_m = reach_m;
    ++steps;
  }
  EXPECT_EQ(exchange.repeated, 0u) << "azimuths that left twice";
  std::printf("%s: %zu scales, %zu steps by a console\n", dialect.name, scales.size(), steps - 1);
}

// Displays say "transmitting" for seconds after a spoke.
TEST(Standby, NoSpokeLeavesAfterTheReportOfIt) {
  for (const auto& [name, model] : {std::pair{"navico_br24", navico::Model::br24},
                                    std::pair{"navico_halo", navico::Model::halo}}) {
    const Dialect dialect = navico_dialect(name, model);
    Exchange exchange(dialect);
    DisplaySocket reports(navico::kAddressesA.report, kFirstAddress);
    exchange.command(dialect.command(8), dialect.nothing);  // obeyed: it is on the network
    exchange.publish(1000.0, 2ms);  // the frames of it would leave over a quarter of a second
    std::this_thread::sleep_for(150ms);
    wire::Set off;
    off.set_transmit(false);
    exchange.console(off);
    const auto spokes = exchange.data_of(400ms);
    ASSERT_FALSE(spokes.empty()) << name << ": nothing left before it either";
    std::chrono::nanoseconds told{};
    while (const auto report = reports.receive(kFirstAddress, 100ms)) {
      const auto decoded = navico::decode_report(report->payload);
      const auto* state = decoded ? std::get_if<navico::StateReport>(&*decoded) : nullptr;
      if (state != nullptr && state->state == navico::RadarState::standby && told == told.zero()) {
        told = report->time;
      }
    }
    ASSERT_GT(told, told.zero()) << name << ": no report of standby";
    for (const auto& spoke : spokes) EXPECT_LE(spoke.time, told) << name;
    std::printf("%s: %zu of four frames left before the standby\n", name, spokes.size());
    EXPECT_LT(spokes.size(), 4u) << name;
  }
}

// All at once: each waits most of the time for the next command that its radar may take.
TEST(AllDialects, ADisplaysStepLeavesEveryEchoWhereItIs) {
  const std::vector<Dialect> dialects = all_dialects();
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < dialects.size(); ++i) {
    threads.emplace_back([&dialects, i] {
      try {
        try_every_step(dialects[i], kFirstAddress + static_cast<std::uint32_t>(i));
      } catch (const std::exception& error) {
        ADD_FAILURE() << dialects[i].name << ": " << error.what();
      }
    });
  }
  for (std::thread& each : threads) each.join();
}

INSTANTIATE_TEST_SUITE_P(AllDialects, RangeSteps, testing::ValuesIn(all_dialects()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace skerry::server
