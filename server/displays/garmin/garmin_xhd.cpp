#include "server/displays/garmin/garmin_xhd.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "protocol/garmin/xhd_reports.hpp"
#include "server/displays/garmin/xhd_controls.hpp"
#include "server/displays/garmin/xhd_encoder.hpp"
#include "server/displays/garmin/xhd_scanner.hpp"
#include "server/displays/one_range_radar.hpp"

namespace skerry::server {
namespace {

using garmin::Type;

constexpr Duration kXhdTick = std::chrono::milliseconds(garmin::kTickMs);
constexpr std::int64_t kHeartbeatTicks = garmin::kHeartbeatSeconds * 1000 / garmin::kTickMs;

// Reports of unknown meaning that follow from what is known.
constexpr std::uint32_t kAnotherRange = 0x91f;  // half the range in the capture
constexpr std::uint32_t kRotationSet = 0x917;   // rpm * 100
constexpr std::uint32_t kMotion = 0x918;
constexpr std::uint32_t kAskedFor = 0x99d;

// Reports that leave as soon as they have changed; the others wait for their turn.
constexpr std::array kAtOnce = {
    Type::speed,
    Type::transmit,
    Type::rejection,
    Type::gain_auto_level,
    Type::range,
    Type::gain_auto,
    Type::gain,
    Type::alignment,
    Type::crosstalk,
    Type::rain_on,
    Type::rain,
    Type::sea_mode,
    Type::sea,
    Type::sea_auto_level,
    Type::no_transmit_on,
    Type::no_transmit_from,
    Type::no_transmit_to,
    Type::timed_on,
    Type::timed_idle,
    Type::timed_run,
    Type::scanner_state,
};

const garmin::ReportSlot* find_slot(Type type) {
  const auto slots = garmin::report_slots();
  const auto found = std::find_if(slots.begin(), slots.end(), [&](const garmin::ReportSlot& slot) {
    return slot.type == static_cast<std::uint32_t>(type);
  });
  return found == slots.end() ? nullptr : &*found;
}

class GarminXhd final : public OneRangeRadar<GarminOptions, XhdControls> {
 public:
  explicit GarminXhd(const GarminOptions& options) : OneRangeRadar(options) {}

  void begin(std::uint32_t interface_address, std::span<const std::uint16_t> ports,
             ScenarioTime now, EmulationPort& port) override;
  void on_time(ScenarioTime now, EmulationPort& port) override;
  void on_datagram(std::size_t listen, const Ipv4Endpoint& from,
                   std::span<const std::uint8_t> payload, ScenarioTime now,
                   EmulationPort& port) override;
  void on_settings(RangeChannel channel, ScenarioTime now, EmulationPort& port) override;

  SectorEncoder spoke_encoder(RangeChannel) const override {
    auto encoder = std::make_shared<XhdEncoder>(controls_.ranges(), antenna_);
    return [encoder](const Sector& sector) { return encoder->encode(sector); };
  }
  Ipv4Endpoint data_address(RangeChannel) const override { return options_.spokes; }

 private:
  void obey(const garmin::Command& command, ScenarioTime now, EmulationPort& port);
  void ask_transmit(bool on, ScenarioTime now, EmulationPort& port);
  void step_scanner(ScenarioTime now, EmulationPort& port);
  void turn_antenna(ScenarioTime now, const wire::Settings& settings);
  void send_changes(ScenarioTime now, const wire::Settings& settings, EmulationPort& port);
  void send_round(std::int64_t tick, ScenarioTime now, const wire::Settings& settings,
                  EmulationPort& port);
  void send(const garmin::ReportSlot& slot, std::int64_t number, EmulationPort& port);
  std::int64_t number_of(const garmin::ReportSlot& slot, ScenarioTime now,
                         const wire::Settings& settings) const;

  XhdScanner scanner_{{}, false, ScenarioTime{}};
  XhdAntenna antenna_ = std::make_shared<std::atomic<std::uint32_t>>(0);
  double spin_angle_ = 0.0;  // of kAnglesPerTurn, while there is no picture
  ScenarioTime begin_{}, turned_at_{};
  std::int64_t next_tick_ = 0;
  std::uint16_t heartbeats_ = 0;
  bool obeying_ = false;    // what changes comes of a display's command
  bool dirty_ = true;       // something that leaves at once may have changed
  std::set<Type> answers_;  // types of commands that were obeyed, not yet reported
  std::map<std::uint32_t, std::int64_t> sent_;  // what each report said last
};

void GarminXhd::begin(std::uint32_t, std::span<const std::uint16_t>, ScenarioTime now,
                      EmulationPort& port) {
  const wire::Settings settings = port.settings(RangeChannel::a);
  controls_.observe(settings);
  scanner_ = XhdScanner(
      {options_.starting, options_.spinning_up, options_.stopping, options_.spinning_down},
      !settings.standby(), now);
  begin_ = turned_at_ = now;
  for (const Type type : kAtOnce) {
    const auto* slot = find_slot(type);
    sent_[slot->type] = number_of(*slot, now, settings);
  }
}

void GarminXhd::on_time(ScenarioTime now, EmulationPort& port) {
  step_scanner(now, port);
  const wire::Settings settings = port.settings(RangeChannel::a);
  turn_antenna(now, settings);
  if (dirty_) send_changes(now, settings, port);
  const std::int64_t current = (now - begin_) / kXhdTick;
  next_tick_ = std::max(next_tick_, current - kMostTicksBehind);
  for (; next_tick_ <= current; ++next_tick_) send_round(next_tick_, now, settings, port);
}

void GarminXhd::on_settings(RangeChannel, ScenarioTime now, EmulationPort& port) {
  const wire::Settings settings = port.settings(RangeChannel::a);
  if (!obeying_) controls_.observe(settings);
  scanner_.follow(!settings.standby(), now);
  dirty_ = true;
}

void GarminXhd::on_datagram(std::size_t, const Ipv4Endpoint& from,
                            std::span<const std::uint8_t> payload, ScenarioTime now,
                            EmulationPort& port) {
  const auto command = garmin::decode_command(payload);
  if (!command) {
    port.count(fmt::format("garmin {} command", name_of(command.error().kind)),
               fmt::format("{}: {}", text_of(from), command.error().text));
    return;
  }
  if (command->clamped) {
    port.count("garmin value out of range",
               fmt::format("{}: {:#x} was taken as {}", text_of(from),
                           static_cast<std::uint32_t>(command->type), command->value));
  }
  obey(*command, now, port);
}

void GarminXhd::obey(const garmin::Command& command, ScenarioTime now, EmulationPort& port) {
  if (command.type == Type::transmit) {
    ask_transmit(command.value != 0, now, port);
  } else {
    if (const auto set = controls_.set_of(command, port.settings(RangeChannel::a))) {
      obeying_ = true;
      const wire::Reply reply = port.change(RangeChannel::a, *set);
      obeying_ = false;
      if (reply.code() != wire::Reply::OK) {
        port.count("garmin refused command", reply.text());
        return;
      }
    }
    controls_.accept(command, port.settings(RangeChannel::a));
  }
  if (find_slot(command.type) != nullptr) answers_.insert(command.type);
  dirty_ = true;
}

void GarminXhd::ask_transmit(bool on, ScenarioTime now, EmulationPort& port) {
  if (on) {
    const wire::Settings settings = port.settings(RangeChannel::a);
    const auto& locked = settings.locked();
    if (std::find(locked.begin(), locked.end(), "transmit") != locked.end()) {
      port.count("garmin refused command", "transmit is locked by the instructor");
      return;
    }
    if (settings.standby()) scanner_.ask(true, now);
    step_scanner(now, port);
    return;
  }
  wire::Set set;
  set.set_transmit(false);
  const wire::Reply reply = port.change(RangeChannel::a, set);
  if (reply.code() != wire::Reply::OK) {
    port.count("garmin refused command", reply.text());
    return;
  }
  scanner_.ask(false, now);
}

void GarminXhd::step_scanner(ScenarioTime now, EmulationPort& port) {
  const garmin::ScannerState before = scanner_.state();
  if (scanner_.step(now)) {
    wire::Set set;
    set.set_transmit(true);
    const wire::Reply reply = port.change(RangeChannel::a, set);
    if (reply.code() != wire::Reply::OK) {
      port.count("garmin refused command", reply.text());
      scanner_.follow(false, now);
    }
  }
  if (scanner_.state() != before) dirty_ = true;
}

// The last spoke tells where the antenna is; one that turns without a picture is turned here.
void GarminXhd::turn_antenna(ScenarioTime now, const wire::Settings& settings) {
  const double seconds = in_seconds(now - turned_at_);
  turned_at_ = now;
  if (scanner_.state() == garmin::ScannerState::transmitting) {
    spin_angle_ = antenna_->load(std::memory_order_relaxed);
    return;
  }
  spin_angle_ +=
      scanner_.rpm(now, settings.rotation_rpm()) / 60.0 * seconds * garmin::kAnglesPerTurn;
  spin_angle_ = std::fmod(spin_angle_, garmin::kAnglesPerTurn);
}

void GarminXhd::send_changes(ScenarioTime now, const wire::Settings& settings,
                             EmulationPort& port) {
  for (const Type type : kAtOnce) {
    const auto* slot = find_slot(type);
    const std::int64_t number = number_of(*slot, now, settings);
    if (answers_.contains(type) || sent_[slot->type] != number) send(*slot, number, port);
  }
  answers_.clear();
  dirty_ = false;
}

void GarminXhd::send_round(std::int64_t tick, ScenarioTime now, const wire::Settings& settings,
                           EmulationPort& port) {
  const auto in_round = static_cast<std::uint32_t>(tick % garmin::kTicksPerRound);
  for (const garmin::ReportSlot& slot : garmin::report_slots()) {
    if (in_round % slot.period == slot.tick) send(slot, number_of(slot, now, settings), port);
  }
  if (in_round == garmin::kAbilitiesTick) port.send(options_.reports, garmin::encode_abilities());
  if (in_round == garmin::kRangesTick) port.send(options_.reports, garmin::encode_ranges());
  if (tick % kHeartbeatTicks == garmin::kHeartbeatTick) {
    port.send(options_.heartbeat, garmin::encode_heartbeat(heartbeats_++));
  }
}

void GarminXhd::send(const garmin::ReportSlot& slot, std::int64_t number, EmulationPort& port) {
  sent_[slot.type] = number;
  port.send(options_.reports,
            garmin::encode_packet(static_cast<Type>(slot.type), slot.octets, number));
}

std::int64_t GarminXhd::number_of(const garmin::ReportSlot& slot, ScenarioTime now,
                                  const wire::Settings& settings) const {
  switch (slot.type) {
    case kAnotherRange:
      return std::llround(controls_.range_m(settings) / 2.0);
    case kRotationSet:
      return std::llround(settings.rotation_rpm() * 100.0);
    case kMotion:
      return scanner_.motion();
    case kAskedFor:
      return scanner_.is_asked_for() ? 1 : 0;
    default:
      break;
  }
  const auto type = static_cast<Type>(slot.type);
  switch (type) {
    case Type::transmit:
      return scanner_.is_asked_for() ? 1 : 0;
    case Type::scanner_state:
      return static_cast<std::int64_t>(scanner_.state());
    case Type::until_change:
      return scanner_.until_change_ms(now);
    case Type::rotation:
      return std::llround(scanner_.rpm(now, settings.rotation_rpm()) * 100.0);
    case Type::antenna:
      return static_cast<std::int64_t>(spin_angle_);
    case Type::last_spoke:
      return antenna_->load(std::memory_order_relaxed);
    default:
      return controls_.report(type, settings).value_or(std::int64_t{slot.number});
  }
}

}  // namespace

std::unique_ptr<RadarEmulation> make_garmin_xhd(const GarminOptions& options) {
  return std::make_unique<GarminXhd>(options);
}

EmulationIdentity identity_of(const GarminOptions& options) {
  return {"Garmin xHD", {options.reports, options.spokes, Ipv4Endpoint{0, options.command_port}}};
}

}  // namespace skerry::server
