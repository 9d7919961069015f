#include "server/displays/navico/navico_channel.hpp"

#include <algorithm>
#include <string>

#include "protocol/video/range_scale.hpp"

namespace skerry::server {
namespace {

using navico::Command;
using navico::CommandKind;
using namespace std::chrono_literals;

constexpr Duration kStatePeriod = 2s, kReportPeriod = 5s;
// From `transmit` to the first frame: 1.0 s (4G) to 1.7 s (HALO3) in the recordings.
constexpr Duration kSpinUp = 1400ms;
// However often a display asks.
constexpr Duration kShortestPause = 2ms;
constexpr NavicoReport kAll[] = {NavicoReport::state,    NavicoReport::controls,
                                 NavicoReport::identity, NavicoReport::installation,
                                 NavicoReport::blanking, NavicoReport::advanced,
                                 NavicoReport::heartbeat};
// Those that tell of settings: sent when one of them is different.
constexpr NavicoReport kOfSettings[] = {NavicoReport::state, NavicoReport::controls,
                                        NavicoReport::installation, NavicoReport::blanking,
                                        NavicoReport::advanced};
constexpr const char* kFirmwareDate = "Nov  2 2018";
constexpr const char* kFirmwareTime = "05:24:49 70";

Duration period_of(NavicoReport report) {
  return report == NavicoReport::state || report == NavicoReport::heartbeat ? kStatePeriod
                                                                            : kReportPeriod;
}

// The report that holds a change of that kind.
NavicoReport report_of(CommandKind kind) {
  switch (kind) {
    case CommandKind::range:
    case CommandKind::gain:
    case CommandKind::sea:
    case CommandKind::rain:
    case CommandKind::interference:
    case CommandKind::expansion:
    case CommandKind::boost:
    case CommandKind::mode:
    case CommandKind::halo_sea_mode:
      return NavicoReport::controls;
    case CommandKind::blanking_on:
    case CommandKind::blanking_angles:
      return NavicoReport::blanking;
    case CommandKind::bearing_alignment:
    case CommandKind::antenna_height:
    case CommandKind::antenna_offset:
    case CommandKind::accent_light:
    case CommandKind::parking:
      return NavicoReport::installation;
    default:
      return NavicoReport::advanced;
  }
}

}  // namespace

NavicoChannel::NavicoChannel(RangeChannel id, navico::Model model, const navico::Addresses& at)
    : id_(id), model_(model), at_(at), controls_(model) {}

bool NavicoChannel::has(NavicoReport report) const {
  return navico::is_halo(model_) ||
         (report != NavicoReport::blanking && report != NavicoReport::heartbeat);
}

void NavicoChannel::begin(ScenarioTime now, EmulationPort& port) {
  began_ = now;
  const wire::Settings settings = port.settings(id_);
  was_standby_ = settings.standby();
  shows_ = !was_standby_;
  for (Slot& each : slots_) each = {now, now - kReportPeriod, {}};
  observe(now, port, true);
  flush(now, port);
}

void NavicoChannel::on_time(ScenarioTime now, EmulationPort& port) {
  if (!gate_->is_open() && shows_ && now >= picture_from_) observe(now, port, false);
  flush(now, port);
}

void NavicoChannel::spin_up(ScenarioTime now) { picture_from_ = now + kSpinUp; }

bool NavicoChannel::change(const Command& command, ScenarioTime now, EmulationPort& port) {
  const wire::Settings settings = port.settings(id_);
  NavicoControls next = controls_;
  const auto set = next.change(command, settings);
  if (!set) return false;
  ask(report_of(command.kind), now);
  // A HALO tells of its sea control twice, and sends both after every command.
  if (navico::is_halo(model_) && report_of(command.kind) == NavicoReport::controls) {
    ask(NavicoReport::advanced, now);
  }
  if (set->ByteSizeLong() == 0 || apply(*set, port)) controls_ = next;
  return true;
}

bool NavicoChannel::apply(const wire::Set& set, EmulationPort& port) {
  const wire::Reply reply = port.change(id_, set);
  if (reply.code() == wire::Reply::OK) return true;
  port.count("navico command refused", reply.text());
  return false;
}

void NavicoChannel::ask(NavicoReport report, ScenarioTime now) {
  Slot& asked = slot(report);
  asked.due = std::min(asked.due, std::max(now, asked.sent + kShortestPause));
}

navico::RadarState NavicoChannel::state(const wire::Settings& settings, ScenarioTime now) const {
  if (settings.standby() || !shows_) return navico::RadarState::standby;
  return now < picture_from_ ? navico::RadarState::spinning_up : navico::RadarState::transmit;
}

void NavicoChannel::observe(ScenarioTime now, EmulationPort& port, bool from_outside) {
  const wire::Settings settings = port.settings(id_);
  if (settings.standby() != was_standby_) {
    was_standby_ = settings.standby();
    if (was_standby_) {
      shows_ = false;
    } else if (from_outside) {
      shows_ = true;
      spin_up(now);
    }
  }
  controls_.observe(settings);
  if (const auto scale = RangeScale::find(settings.range_nm())) {
    gate_->set_range(*scale, controls_.range_dm(settings));
  }
  gate_->open(state(settings, now) == navico::RadarState::transmit);
  for (const NavicoReport each : kOfSettings) {
    if (has(each) && slot(each).last != encode(each, settings, now)) ask(each, now);
  }
}

Bytes NavicoChannel::encode(NavicoReport report, const wire::Settings& settings,
                            ScenarioTime now) const {
  switch (report) {
    case NavicoReport::state:
      return navico::encode(model_, navico::StateReport{state(settings, now)});
    case NavicoReport::controls:
      return navico::encode(model_, controls_.controls(settings));
    case NavicoReport::identity: {
      const auto hours = std::chrono::duration_cast<std::chrono::hours>(now - began_).count();
      return navico::encode(model_, navico::IdentityReport{navico::identity_type(model_),
                                                           static_cast<std::uint32_t>(hours),
                                                           kFirmwareDate, kFirmwareTime});
    }
    case NavicoReport::installation:
      return navico::encode(model_, controls_.installation(settings));
    case NavicoReport::blanking:
      return navico::encode(model_, navico::BlankingReport{controls_.sectors(settings)});
    case NavicoReport::advanced:
      return navico::encode(model_, controls_.advanced(settings));
    case NavicoReport::heartbeat:
      return navico::encode(model_, navico::HeartbeatReport{});
  }
  return {};
}

void NavicoChannel::flush(ScenarioTime now, EmulationPort& port) {
  const auto is_due = [&](NavicoReport each) { return has(each) && slot(each).due <= now; };
  if (std::none_of(std::begin(kAll), std::end(kAll), is_due)) return;
  const wire::Settings settings = port.settings(id_);
  for (const NavicoReport each : kAll) {
    if (!is_due(each)) continue;
    Slot& mine = slot(each);
    // A report that nobody asked for keeps its beat.
    const Duration period = period_of(each);
    mine.due = now - mine.due < period ? mine.due + period : now + period;
    mine.sent = now;
    mine.last = encode(each, settings, now);
    port.send(at_.report, mine.last);
  }
}

}  // namespace skerry::server
