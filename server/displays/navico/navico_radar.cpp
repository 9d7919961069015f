#include "server/displays/navico/navico_radar.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "protocol/navico/command.hpp"
#include "protocol/navico/locator.hpp"
#include "protocol/navico/ship_data.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/displays/navico/navico_channel.hpp"

namespace skerry::server {
namespace {

using navico::Command;
using navico::CommandKind;
using namespace std::chrono_literals;

// The radar's own IPv4 port as reported; no display is known to send to it.
constexpr std::uint16_t kRadarPort = 306;
// Answers to questions are not sent more often than this, however many ask.
constexpr Duration kLocatorPause = 50ms;
constexpr Duration kPresencePeriod = 1s, kHeadingPeriod = 100ms, kNavigationPeriod = 250ms,
                   kSpeedPeriod = 500ms;

// The options with what the model makes of them: fixed addresses, no B where there is none.
NavicoOptions settled(NavicoOptions options) {
  options.second_range = options.second_range && navico::has_two_ranges(options.model);
  if (!navico::is_halo(options.model)) {
    options.a = navico::kAddressesA;
    options.b = navico::kAddressesB;
  }
  if (options.serial.empty()) {
    // The first two digits tell displays the family.
    options.serial = options.model == navico::Model::g4       ? "1403302452"
                     : options.model == navico::Model::halo20 ? "2005052001"
                     : options.model == navico::Model::halo   ? "1902501234"
                                                              : "1102302452";
  }
  return options;
}

std::vector<navico::Addresses> addresses_of(const NavicoOptions& options) {
  std::vector<navico::Addresses> all = {options.a};
  if (options.second_range) all.push_back(options.b);
  return all;
}

// Something that is sent again and again.
class Timer {
 public:
  explicit Timer(Duration period) : period_(period) {}
  void begin(ScenarioTime now) { next_ = now + period_; }
  bool is_due(ScenarioTime now) {
    if (now < next_) return false;
    next_ += period_;
    if (next_ <= now) next_ = now + period_;
    return true;
  }

 private:
  Duration period_;
  ScenarioTime next_{};
};

class NavicoRadar final : public RadarEmulation {
 public:
  explicit NavicoRadar(const NavicoOptions& options) : options_(settled(options)) {
    for (const navico::Addresses& each : addresses_of(options_)) {
      const RangeChannel id = channels_.empty() ? RangeChannel::a : RangeChannel::b;
      channels_.emplace_back(id, options_.model, each);
    }
  }

  std::vector<RangeChannel> channels() const override {
    std::vector<RangeChannel> all;
    for (const NavicoChannel& each : channels_) all.push_back(each.id());
    return all;
  }

  std::vector<EmulationListen> listens() const override {
    std::vector<EmulationListen> at;
    for (const NavicoChannel& each : channels_) at.push_back({each.at().send});
    if (has_locator()) at.push_back({navico::kLocatorGroup});
    return at;
  }

  void begin(std::uint32_t interface_address, std::span<const std::uint16_t>, ScenarioTime now,
             EmulationPort& port) override {
    interface_address_ = interface_address;
    heard_ = now;
    located_ = now - kLocatorPause;
    for (Timer* each : {&presence_, &heading_, &navigation_, &speed_}) each->begin(now);
    for (NavicoChannel& each : channels_) each.begin(now, port);
  }

  void on_time(ScenarioTime now, EmulationPort& port) override {
    for (NavicoChannel& each : channels_) each.on_time(now, port);
    if (navico::is_halo(options_.model)) send_halo_packets(now, port);
    const Duration alone = options_.standby_when_alone;
    if (alone > Duration{} && now - heard_ >= alone) stand_by(now, port);
    if (locator_asked_ && now - located_ >= kLocatorPause) send_locator(now, port);
  }

  void on_datagram(std::size_t listen, const Ipv4Endpoint& from,
                   std::span<const std::uint8_t> payload, ScenarioTime now,
                   EmulationPort& port) override {
    if (listen >= channels_.size()) {
      if (!navico::is_locator_question(payload)) return;  // other radars' answers
      locator_asked_ = true;
      if (now - located_ >= kLocatorPause) send_locator(now, port);
      return;
    }
    const auto command = navico::decode_command(payload);
    if (!command.ok()) {
      port.count(fmt::format("navico {} command", name_of(command.error().kind)),
                 fmt::format("{} from {}", command.error().text, text_of(from)));
      return;
    }
    heard_ = now;
    obey(channels_[listen], *command, from, now, port);
  }

  void on_settings(RangeChannel channel, ScenarioTime now, EmulationPort& port) override {
    // While a command is obeyed obey() looks at the settings itself, when all of it is done.
    if (!obeying_) find(channel).observe(now, port, true);
  }

  SectorEncoder spoke_encoder(RangeChannel channel) const override {
    const auto spokes = std::make_shared<NavicoSpokes>(options_.model, find(channel).gate());
    return [spokes](const Sector& sector) { return EncodedSectorPtr(spokes->encode(sector)); };
  }

  Ipv4Endpoint data_address(RangeChannel channel) const override { return find(channel).at().data; }

  bool has_picture(RangeChannel channel) const override { return find(channel).gate()->is_open(); }

  double instrumented_range_m(RangeChannel channel, const wire::Settings& settings) const override {
    const std::uint32_t dm = find(channel).controls().range_dm(settings);
    const double reach_m = navico::spoke_range(options_.model, dm).reach.in_metres();
    // Never short of the range scale: then the spoke is the first part of two, or of more.
    const double scale_m = settings.range_nm() * Length::kMetresPerNauticalMile;
    return reach_m * std::max(1.0, std::ceil(scale_m / reach_m - 1e-9));
  }

 private:
  bool has_locator() const { return !navico::is_first_generation(options_.model); }
  const NavicoChannel& find(RangeChannel channel) const {
    return channel == RangeChannel::b && channels_.size() > 1 ? channels_[1] : channels_[0];
  }
  NavicoChannel& find(RangeChannel channel) {
    return const_cast<NavicoChannel&>(std::as_const(*this).find(channel));
  }

  void obey(NavicoChannel& channel, const Command& command, const Ipv4Endpoint& from,
            ScenarioTime now, EmulationPort& port) {
    obeying_ = true;
    bool known = true;
    switch (command.kind) {
      case CommandKind::prepare:
      case CommandKind::stay_alive:
      case CommandKind::ask_other:
        break;
      case CommandKind::ask_controls:
        channel.ask(NavicoReport::controls, now);
        channel.ask(NavicoReport::advanced, now);
        break;
      case CommandKind::ask_identity:
        channel.ask(NavicoReport::identity, now);
        break;
      case CommandKind::ask_installation:
        channel.ask(NavicoReport::installation, now);
        if (navico::is_halo(options_.model)) channel.ask(NavicoReport::blanking, now);
        break;
      case CommandKind::transmit:
        known = command.value == 0 || command.value == 1;
        if (known) transmit(channel, command.value == 1, now, port);
        break;
      default:
        known = channel.change(command, now, port);
    }
    if (!known) {
      port.count("navico command out of range",
                 fmt::format("value {} of command {} from {}", command.value,
                             static_cast<int>(command.kind), text_of(from)));
    }
    obeying_ = false;
    // The other range may have the same radar: its antenna, its transmitter.
    for (NavicoChannel& each : channels_) each.observe(now, port, false);
    channel.flush(now, port);
  }

  // The ranges of a radar have one transmitter, which is off when neither shows a picture.
  void transmit(NavicoChannel& channel, bool on, ScenarioTime now, EmulationPort& port) {
    const bool was = channel.shows();
    channel.show(on);
    bool others = false;
    for (const NavicoChannel& each : channels_) others |= &each != &channel && each.shows();
    const bool standby = port.settings(channel.id()).standby();
    channel.ask(NavicoReport::state, now);
    if (on) {
      if (!was || standby) channel.spin_up(now);
    } else if (others) {
      return;
    }
    if (on != standby) return;
    wire::Set set;
    set.set_transmit(on);
    if (!channel.apply(set, port)) channel.show(was);
  }

  void stand_by(ScenarioTime now, EmulationPort& port) {
    heard_ = now;  // asked for once, not every 10 ms
    obeying_ = true;
    for (NavicoChannel& each : channels_) {
      if (each.shows()) transmit(each, false, now, port);
    }
    obeying_ = false;
    for (NavicoChannel& each : channels_) {
      each.observe(now, port, false);
      each.flush(now, port);
    }
  }

  void send_locator(ScenarioTime now, EmulationPort& port) {
    located_ = now;
    locator_asked_ = false;
    port.send(navico::kLocatorGroup,
              navico::encode_locator(navico::make_locator(
                  options_.serial, {interface_address_, kRadarPort}, options_.a,
                  options_.second_range ? std::optional(options_.b) : std::nullopt)));
  }

  void send_halo_packets(ScenarioTime now, EmulationPort& port) {
    if (presence_.is_due(now)) {
      const std::uint8_t here[] = {0x02, 0xA1, 0x20, 0x01};
      port.send(navico::kPresenceGroup, here);
    }
    if (!options_.ship_data) return;
    bool heading = heading_.is_due(now), navigation = navigation_.is_due(now),
         speed = speed_.is_due(now);
    if (!heading && !navigation && !speed) return;
    const wire::OwnShip ship = port.own_ship();
    heading = heading && !ship.no_heading();
    navigation = navigation && !ship.no_motion();
    speed = speed && !ship.no_motion();
    const double course_deg = ship.course_over_ground_deg();
    const double speed_mps = ship.speed_over_ground_kn() * kKnot;
    if (heading) {
      port.send(navico::kHeadingGroup,
                navico::encode(navico::HeadingPacket{counter_++, ship.heading_deg()}));
    }
    if (navigation) {
      port.send(navico::kHeadingGroup,
                navico::encode(navico::NavigationPacket{counter_++, course_deg, speed_mps}));
    }
    if (!speed) return;
    const Bytes packet = navico::encode(navico::SpeedPacket{speed_mps, course_deg});
    for (const Ipv4Endpoint& group : navico::kSpeedGroups) port.send(group, packet);
  }

  NavicoOptions options_;
  std::vector<NavicoChannel> channels_;
  std::uint32_t interface_address_ = 0;
  ScenarioTime heard_{}, located_{};
  bool locator_asked_ = false;
  bool obeying_ = false;
  std::uint16_t counter_ = 0;
  Timer presence_{kPresencePeriod}, heading_{kHeadingPeriod}, navigation_{kNavigationPeriod},
      speed_{kSpeedPeriod};
};

}  // namespace

std::unique_ptr<RadarEmulation> make_navico_radar(const NavicoOptions& options) {
  return std::make_unique<NavicoRadar>(options);
}

EmulationIdentity navico_identity(const NavicoOptions& options) {
  EmulationIdentity identity;
  identity.family = fmt::format("Navico {}", name_of(options.model));
  for (const navico::Addresses& each : addresses_of(settled(options))) {
    identity.fixed_addresses.insert(identity.fixed_addresses.end(),
                                    {each.data, each.send, each.report});
  }
  return identity;
}

}  // namespace skerry::server
