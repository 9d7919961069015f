// NavicoChannel: one range, A or B, of an emulated Navico radar: its state, and when it reports.
#pragma once

#include <array>
#include <cstdint>
#include <memory>

#include "protocol/navico/command.hpp"
#include "protocol/navico/model.hpp"
#include "protocol/navico/report.hpp"
#include "server/displays/navico/navico_controls.hpp"
#include "server/displays/navico/navico_spokes.hpp"
#include "server/displays/radar_emulation.hpp"

namespace skerry::server {

enum class NavicoReport : std::uint8_t {
  state,
  controls,
  identity,
  installation,
  blanking,
  advanced,
  heartbeat,
};

// State and heartbeat are sent every 2 s, the others every 5 s, and each at once when a display
// asks for it or what it says has changed.  Thread: net-0.
class NavicoChannel {
 public:
  NavicoChannel(RangeChannel id, navico::Model model, const navico::Addresses& at);

  RangeChannel id() const { return id_; }
  const navico::Addresses& at() const { return at_; }
  std::shared_ptr<const NavicoGate> gate() const { return gate_; }
  const NavicoControls& controls() const { return controls_; }

  void begin(ScenarioTime now, EmulationPort& port);
  void on_time(ScenarioTime now, EmulationPort& port);

  // Whether displays have this range transmitting; the radar may still be in standby.
  bool shows() const { return shows_; }
  void show(bool on) { shows_ = on; }
  // The antenna comes up to speed first: no picture until then.
  void spin_up(ScenarioTime now);

  // False for a value or a command that the radar does not know.
  bool change(const navico::Command& command, ScenarioTime now, EmulationPort& port);
  // False if it was refused; that is counted.
  bool apply(const wire::Set& set, EmulationPort& port);

  void ask(NavicoReport report, ScenarioTime now);
  // Takes note of the settings and reports what is different.  `from_outside`: another display or
  // console may have changed them, so that what it started this range shows.
  void observe(ScenarioTime now, EmulationPort& port, bool from_outside);
  // Sends what is due.
  void flush(ScenarioTime now, EmulationPort& port);

 private:
  static constexpr std::size_t kReports = 7;
  struct Slot {
    ScenarioTime due{}, sent{};
    Bytes last;
  };
  Slot& slot(NavicoReport report) { return slots_[static_cast<std::size_t>(report)]; }
  bool has(NavicoReport report) const;
  navico::RadarState state(const wire::Settings& settings, ScenarioTime now) const;
  Bytes encode(NavicoReport report, const wire::Settings& settings, ScenarioTime now) const;

  RangeChannel id_;
  navico::Model model_;
  navico::Addresses at_;
  NavicoControls controls_;
  std::shared_ptr<NavicoGate> gate_ = std::make_shared<NavicoGate>();
  bool shows_ = false;
  bool was_standby_ = true;
  ScenarioTime picture_from_{};
  ScenarioTime began_{};
  std::array<Slot, kReports> slots_;
};

}  // namespace skerry::server
