#include "server/displays/raymarine/quantum.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/raymarine/quantum_report.hpp"
#include "server/displays/one_range_radar.hpp"
#include "server/displays/raymarine/quantum_controls.hpp"
#include "server/displays/raymarine/quantum_encoder.hpp"

namespace skerry::server {
namespace {

// Everything leaves at ticks of 10 ms of a round of one second, as in the capture.
constexpr Duration kQuantumTick = std::chrono::milliseconds(10);
constexpr std::int64_t kTicksPerRound = 100;
constexpr std::int64_t kStatusTick = 37, kNameTick = 38, kAddressesTick = 39, kReportsTick = 40,
                       kLastReportsTick = 41, kCountsTick = 44;
constexpr std::int64_t kFifthSecondTick = 209, kTicksPerFiveSeconds = 500;
// The 25 counts leave in five groups of four ticks, two at the last of each.
constexpr std::int64_t kCountsPerGroup = 5, kTicksPerGroup = 4;

class Quantum final : public OneRangeRadar<QuantumOptions, QuantumControls> {
 public:
  explicit Quantum(const QuantumOptions& options) : OneRangeRadar(options) {}

  void begin(std::uint32_t interface_address, std::span<const std::uint16_t> ports,
             ScenarioTime now, EmulationPort& port) override;
  void on_time(ScenarioTime now, EmulationPort& port) override;
  void on_datagram(std::size_t listen, const Ipv4Endpoint& from,
                   std::span<const std::uint8_t> payload, ScenarioTime now,
                   EmulationPort& port) override;
  void on_settings(RangeChannel channel, ScenarioTime now, EmulationPort& port) override;

  SectorEncoder spoke_encoder(RangeChannel) const override {
    auto encoder = std::make_shared<QuantumEncoder>(controls_.ranges());
    return [encoder](const Sector& sector) { return encoder->encode(sector); };
  }
  Ipv4Endpoint data_address(RangeChannel) const override { return options_.data; }

 private:
  void tell_range(EmulationPort& port);
  void tell_changes(EmulationPort& port);
  void send_status(EmulationPort& port);
  void send_round(std::int64_t tick, EmulationPort& port);
  void stand_by_if_alone(ScenarioTime now, EmulationPort& port);

  Ipv4Endpoint radar_;  // where it takes commands
  ScenarioTime begin_{}, heard_at_{};
  std::int64_t next_tick_ = 0;
  bool dirty_ = false;    // the status may have changed
  bool obeying_ = false;  // what changes comes of a display's command
  bool answer_ = false;   // a command was obeyed and not yet reported
  raymarine::QuantumStatus sent_;
};

void Quantum::begin(std::uint32_t interface_address, std::span<const std::uint16_t> ports,
                    ScenarioTime now, EmulationPort& port) {
  radar_ = {interface_address, ports.empty() ? options_.command_port : ports[0]};
  begin_ = heard_at_ = now;
  const wire::Settings settings = port.settings(RangeChannel::a);
  controls_.observe(settings);
  sent_ = controls_.status(settings);
}

void Quantum::on_time(ScenarioTime now, EmulationPort& port) {
  stand_by_if_alone(now, port);
  tell_changes(port);
  const std::int64_t current = (now - begin_) / kQuantumTick;
  next_tick_ = std::max(next_tick_, current - kMostTicksBehind);
  for (; next_tick_ <= current; ++next_tick_) send_round(next_tick_, port);
}

void Quantum::on_settings(RangeChannel, ScenarioTime, EmulationPort& port) {
  dirty_ = true;
  if (obeying_) return;
  controls_.observe(port.settings(RangeChannel::a));
  tell_range(port);
}

// Before the next spoke, which is of the new range and does not say so.
void Quantum::tell_range(EmulationPort& port) {
  const raymarine::QuantumStatus status = controls_.status(port.settings(RangeChannel::a));
  if (status.range_index != sent_.range_index || status.ranges != sent_.ranges) tell_changes(port);
}

void Quantum::tell_changes(EmulationPort& port) {
  if (!dirty_) return;
  const bool changed = !(controls_.status(port.settings(RangeChannel::a)) == sent_);
  if (changed || answer_) send_status(port);
  dirty_ = answer_ = false;
}

void Quantum::on_datagram(std::size_t, const Ipv4Endpoint& from,
                          std::span<const std::uint8_t> payload, ScenarioTime now,
                          EmulationPort& port) {
  const auto command = raymarine::decode_quantum_command(payload);
  if (!command) {
    port.count(fmt::format("quantum {} command", name_of(command.error().kind)),
               fmt::format("{}: {}", text_of(from), command.error().text));
    return;
  }
  heard_at_ = now;
  if (command->control == raymarine::QuantumControl::stay_alive) return;
  if (command->clamped) {
    port.count("quantum value out of range",
               fmt::format("{}: control {} was taken as {}", text_of(from),
                           static_cast<int>(command->control), command->value));
  }
  if (const auto set = controls_.set_of(*command, port.settings(RangeChannel::a))) {
    obeying_ = true;
    const wire::Reply reply = port.change(RangeChannel::a, *set);
    obeying_ = false;
    if (reply.code() != wire::Reply::OK) {
      port.count("quantum refused command", reply.text());
      return;
    }
  }
  controls_.accept(*command, port.settings(RangeChannel::a));
  dirty_ = answer_ = true;
  tell_range(port);
}

void Quantum::stand_by_if_alone(ScenarioTime now, EmulationPort& port) {
  if (!options_.standby_after || now - heard_at_ < *options_.standby_after) return;
  heard_at_ = now;
  if (port.settings(RangeChannel::a).standby()) return;
  wire::Set set;
  set.set_transmit(false);
  const wire::Reply reply = port.change(RangeChannel::a, set);
  if (reply.code() != wire::Reply::OK) port.count("quantum refused standby", reply.text());
  dirty_ = true;
}

void Quantum::send_status(EmulationPort& port) {
  sent_ = controls_.status(port.settings(RangeChannel::a));
  port.send(options_.data, raymarine::encode_quantum_status(sent_));
}

void Quantum::send_round(std::int64_t tick, EmulationPort& port) {
  const std::int64_t in_round = tick % kTicksPerRound;
  switch (in_round) {
    case kStatusTick:
      send_status(port);
      port.send(options_.data,
                raymarine::encode_quantum_info({options_.part_number, options_.serial_number}));
      break;
    case kNameTick: {
      const raymarine::LocatorName name{{options_.link_id, raymarine::kQuantumDevice},
                                        "QuantumRadar"};
      port.send(options_.locator, raymarine::encode_locator_name(name));
      port.send(options_.locator, raymarine::encode_locator_long_name(name, radar_));
      break;
    }
    case kAddressesTick:
      port.send(options_.locator,
                raymarine::encode_locator_addresses(
                    {{options_.link_id, raymarine::kQuantumModel}, options_.data, radar_}));
      break;
    case kReportsTick:
      port.send(options_.data, raymarine::encode_quantum_short(0x280007));
      port.send(options_.data, raymarine::encode_quantum_long());
      break;
    case kLastReportsTick:
      port.send(options_.data, raymarine::encode_quantum_short(0x280030));
      port.send(options_.data, raymarine::encode_quantum_short(0x280031));
      break;
    default:
      break;
  }
  const std::int64_t counts = in_round - kCountsTick;
  if (counts >= 0 && counts < kTicksPerGroup * raymarine::kQuantumCounts / kCountsPerGroup) {
    const std::int64_t within = counts % kTicksPerGroup;
    const std::int64_t count = counts / kTicksPerGroup * kCountsPerGroup + within;
    port.send(options_.data, raymarine::encode_quantum_count(static_cast<std::uint32_t>(count)));
    if (within == kTicksPerGroup - 1) {
      port.send(options_.data,
                raymarine::encode_quantum_count(static_cast<std::uint32_t>(count + 1)));
    }
  }
  if (tick % kTicksPerFiveSeconds == kFifthSecondTick) {
    port.send(options_.data, raymarine::encode_quantum_short(0x280b01));
  }
}

}  // namespace

std::unique_ptr<RadarEmulation> make_quantum(const QuantumOptions& options) {
  return std::make_unique<Quantum>(options);
}

EmulationIdentity identity_of(const QuantumOptions& options) {
  return {"Raymarine Quantum", {options.data, Ipv4Endpoint{0, options.command_port}}};
}

}  // namespace skerry::server
