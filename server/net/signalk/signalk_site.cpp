#include "server/net/signalk/signalk_site.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "protocol/wire/own_ship_place.hpp"
#include "server/net/common/net_clock.hpp"
#include "server/net/signalk/signalk_encoder.hpp"
#include "server/net/signalk/target_documents.hpp"

namespace skerry::server {
namespace {

using signalk::Json;

constexpr std::chrono::seconds kTargetPeriod{1};
// A display that asks now and then finds its targets still tracked.
constexpr std::chrono::minutes kTargetsWanted{2};
constexpr double kVhfRangeNm = 60.0;

unsigned status_of(wire::Reply::Code code) {
  switch (code) {
    case wire::Reply::OK:
      return 200;
    case wire::Reply::UNKNOWN:
      return 404;
    case wire::Reply::REFUSED:
      return 403;
    default:
      return 400;
  }
}

// Whether a path of the stream tells of a plotter's targets or alerts; `base`: "radars.skerry0".
bool is_of_targets(const std::string& path, const std::string& base) {
  return path.starts_with(base + ".targets.") || path.starts_with("notifications." + base + ".");
}

SignalkSite::Mounted mounted(const wire::RadarInfo& info) {
  SignalkSite::Mounted mounted;
  mounted.number = info.radar();
  const SignalkShape shape = signalk_shape(info.spokes_per_turn(), info.cells());
  mounted.radar = {.id = fmt::format("skerry{}", info.radar()),
                   .name = info.name(),
                   .brand = "Skerry",
                   .model = info.set(),
                   .address = {},
                   .spokes_per_turn = shape.turn_spokes,
                   .cells = shape.cells,
                   .legend = signalk::legend_of(info.bits())};
  return mounted;
}

}  // namespace

SignalkSite::SignalkSite(NetContext& context, std::uint32_t radar)
    : context_(context), first_radar_(radar) {
  const wire::Hello hello = context.host.hello();
  server_ = hello.server();
  const auto named = std::find_if(hello.radars().begin(), hello.radars().end(),
                                  [radar](const auto& info) { return info.radar() == radar; });
  if (named == hello.radars().end()) {
    throw std::runtime_error(
        fmt::format("Signal K: there is no radar {}; there are {}, counted from 0", radar,
                    hello.radars_size()));
  }
  for (const wire::RadarInfo& info : hello.radars()) {
    if (info.own_ship() == named->own_ship()) radars_.push_back(mounted(info));
  }
}

SignalkSite::Mounted* SignalkSite::find(std::string_view id) {
  if (id == "_default") return &radars_.front();
  const auto found = std::find_if(radars_.begin(), radars_.end(),
                                  [id](const Mounted& each) { return each.radar.id == id; });
  return found == radars_.end() ? nullptr : &*found;
}

signalk::OwnShip SignalkSite::own_ship() const {
  const wire::OwnShip ship = context_.sensed_own_ship(first_radar_);
  signalk::OwnShip told{.name = ship.name(), .position = wire::place_known_of(ship)};
  if (!ship.no_heading()) told.heading_deg = ship.heading_deg();
  if (wire::knows_turn(ship)) told.rate_of_turn_deg_min = ship.rate_of_turn_deg_min();
  if (ship.no_motion()) return told;
  told.course_over_ground_deg = ship.course_over_ground_deg();
  told.speed_over_ground_mps = ship.speed_over_ground_kn() * kKnot;
  return told;
}

std::vector<TrafficItem> SignalkSite::others() const {
  std::vector<TrafficItem> traffic = context_.host.traffic();
  std::erase_if(traffic, [this](const TrafficItem& item) {
    return std::find(item.radars.begin(), item.radars.end(), first_radar_) != item.radars.end();
  });
  return traffic;
}

std::vector<signalk::OtherVessel> SignalkSite::vessels() {
  std::vector<signalk::OtherVessel> vessels = ais_vessels();
  const auto by_ais = static_cast<std::ptrdiff_t>(vessels.size());
  Mounted& radar = radars_.front();
  const TargetListPtr list = target_list(radar);
  if (list == nullptr) return vessels;
  for (const wire::Target& target : list->targets()) {
    const bool is_lost = target.state() == wire::TARGET_LOST;
    // Who has just fallen silent is still taken to be the same.
    const bool is_told =
        std::any_of(vessels.begin(), vessels.begin() + by_ais,
                    [&](const signalk::OtherVessel& each) { return each.mmsi == target.mmsi(); });
    if (target.is_test() || is_lost || is_told) continue;
    vessels.push_back(tracked_vessel(target, *list));
  }
  return vessels;
}

std::vector<signalk::OtherVessel> SignalkSite::ais_vessels() const {
  const wire::OwnShip own = context_.sensed_own_ship(first_radar_);
  if (own.no_ais()) return {};
  std::vector<TrafficItem> traffic = others();
  std::erase_if(traffic, [](const TrafficItem& item) {
    return item.mmsi == 0 || (item.kind != TrafficKind::ship && item.kind != TrafficKind::boat);
  });
  if (const auto here = wire::place_known_of(own)) {
    // Metres on a sphere are near enough to tell what VHF carries.
    const auto off = [&](const TrafficItem& item) {
      const double north = item.position.latitude_deg - here->latitude_deg;
      const double east = std::remainder(item.position.longitude_deg - here->longitude_deg, 360.0) *
                          std::cos(here->latitude_deg * kRadiansPerDegree);
      return std::hypot(north, east) * 60.0;
    };
    std::erase_if(traffic, [&](const TrafficItem& item) { return off(item) > kVhfRangeNm; });
    std::stable_sort(traffic.begin(), traffic.end(),
                     [&](const TrafficItem& a, const TrafficItem& b) { return off(a) < off(b); });
  }
  if (traffic.size() > kMostVessels) traffic.resize(kMostVessels);
  std::vector<signalk::OtherVessel> vessels;
  for (const TrafficItem& item : traffic) {
    const AisSaid said = said_by_ais(item);
    if (said.silent) continue;
    vessels.push_back({.key = signalk::vessel_key(item.mmsi),
                       .mmsi = item.mmsi,
                       .ship = {.name = item.name,
                                .position = said.position,
                                .heading_deg = said.heading_deg,
                                .course_over_ground_deg = said.course_over_ground_deg,
                                .speed_over_ground_mps = said.speed_mps,
                                .rate_of_turn_deg_min = said.rate_of_turn_deg_min},
                       .length_m = item.length_m,
                       .beam_m = item.beam_m});
  }
  return vessels;
}

signalk::ControlStates SignalkSite::states(Mounted& radar) const {
  signalk::ControlStates states =
      control_states(context_.host.settings(radar.number, 0), radar.sectors);
  states.emplace_back("modelName", signalk::ControlState{.text = radar.radar.model});
  states.emplace_back("firmwareVersion", signalk::ControlState{.text = server_});
  return states;
}

TargetListPtr SignalkSite::target_list(Mounted& radar) {
  TargetPort* port = context_.host.targets();
  if (port == nullptr) return nullptr;
  radar.targets_asked = std::chrono::steady_clock::now();
  if (radar.wanted_targets == nullptr) radar.wanted_targets = port->want(radar.number, 0);
  return port->targets(radar.number, 0);
}

std::vector<Json> SignalkSite::targets(Mounted& radar) {
  std::vector<Json> documents;
  const TargetListPtr list = target_list(radar);
  if (list == nullptr) return documents;
  for (const wire::Target& target : list->targets()) {
    if (!target.is_test()) documents.push_back(target_document(target, *list));
  }
  return documents;
}

SignalkOutcome SignalkSite::set_control(Mounted& radar, std::string_view key, const Json& body,
                                        const std::string& origin) {
  const signalk::ControlDefinition* definition = signalk::find_control(key);
  if (definition == nullptr) return {404, fmt::format("{}: no control of that name", key)};
  const auto change = signalk::read_change(body, *definition);
  if (!change) return {400, change.error()};
  const SectorPlaces sectors = radar.sectors;
  wire::Set set =
      set_of(*definition, *change, context_.host.settings(radar.number, 0), radar.sectors);
  set.set_radar(radar.number);
  const wire::Reply reply = context_.apply(set, origin);
  if (reply.code() != wire::Reply::OK) {
    radar.sectors = sectors;
    return {status_of(reply.code()), reply.text()};
  }
  context_.tell_settings();
  return {};
}

SignalkOutcome SignalkSite::set_controls(Mounted& radar, const Json& bodies,
                                         const std::string& origin) {
  if (!bodies.is_object()) return {400, "expected an object of controls by name"};
  for (const auto& [key, body] : bodies.items()) {
    SignalkOutcome outcome = set_control(radar, key, body, origin);
    if (outcome.status != 200) return outcome;
  }
  return {};
}

SignalkOutcome SignalkSite::acquire(Mounted& radar, const Json& body, const std::string& origin) {
  static constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  const auto number_at = [&body](const char* name) {
    const Json* value = signalk::member(body, name);
    return value != nullptr ? signalk::number_in(*value).value_or(kNone) : kNone;
  };
  const double bearing = number_at("bearing"), distance = number_at("distance");
  constexpr double kFarthest = 400'000.0, kTurn = 7.0;
  if (!(distance >= 0.0 && distance <= kFarthest) || !(std::fabs(bearing) <= kTurn)) {
    return {400, "expected {\"bearing\": radians from true north, \"distance\": metres}"};
  }
  wire::TargetOrder order;
  order.mutable_acquire()->set_range_nm(distance / Length::kMetresPerNauticalMile);
  order.mutable_acquire()->set_bearing_deg(wrapped_degrees(bearing / kRadiansPerDegree));
  return order_targets(radar, order, origin);
}

SignalkOutcome SignalkSite::drop(Mounted& radar, std::string_view text, const std::string& origin) {
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) {
    return {404, "no target of that number is tracked"};
  }
  wire::TargetOrder order;
  order.add_cancel(number);
  return order_targets(radar, order, origin);
}

SignalkOutcome SignalkSite::order_targets(Mounted& radar, const wire::TargetOrder& order,
                                          const std::string& origin) {
  target_list(radar);  // its plotter is at work from now on
  if (context_.host.targets() == nullptr) return {404, "this server has no plotter"};
  wire::TargetOrder of_view = order;
  of_view.set_radar(radar.number);
  const wire::Reply reply = context_.order(of_view, origin);
  if (reply.code() != wire::Reply::OK) return {status_of(reply.code()), reply.text()};
  SignalkOutcome outcome;
  if (!order.has_acquire()) return outcome;
  std::uint32_t number = 0;
  std::from_chars(reply.text().data(), reply.text().data() + reply.text().size(), number);
  return {201, "OK", number};
}

const signalk::ControlDefinition* SignalkSite::definition_at(std::string_view path) {
  constexpr std::string_view kControls = ".controls.";
  const auto at = path.find(kControls);
  if (!path.starts_with("radars.") || at == std::string_view::npos) return nullptr;
  return signalk::find_control(path.substr(at + kControls.size()));
}

void SignalkSite::enter(std::weak_ptr<SignalkListener> listener) {
  std::erase_if(listeners_, [](const auto& known) { return known.expired(); });
  listeners_.push_back(std::move(listener));
  refresh();
}

void SignalkSite::put(Values& fresh, const std::string& path, Json value) const {
  const auto known = values_.find(path);
  if (known != values_.end() && *known->second == value) {
    fresh.emplace(path, known->second);
  } else {
    fresh.emplace(path, std::make_shared<const Json>(std::move(value)));
  }
}

void SignalkSite::refresh() {
  const auto now = std::chrono::steady_clock::now();
  const bool targets_too = now >= targets_due_;
  if (targets_too) targets_due_ = now + kTargetPeriod;
  Values fresh;
  signalk::OwnShip ship = own_ship();
  // Freeboard-SK turns its radar picture only on a course or heading that differs from the last it
  // was told, and misses the first: a ship that steers like a ruler would have her picture north up
  // for ever.
  constexpr double kStirDeg = 1e-10;
  const double stir = kStirDeg * static_cast<double>(++refreshes_ % 997);
  if (ship.heading_deg) *ship.heading_deg += stir;
  if (ship.course_over_ground_deg) *ship.course_over_ground_deg += stir;
  for (auto& [path, value] : signalk::own_ship_values(ship)) put(fresh, path, std::move(value));
  for (Mounted& radar : radars_) {
    const std::string base = "radars." + radar.radar.id;
    for (const auto& [key, state] : states(radar)) {
      put(fresh, base + ".controls." + key,
          signalk::state_document(*signalk::find_control(key), state));
    }
    if (targets_too) {
      put_targets(radar, fresh);
      continue;
    }
    for (const auto& [path, value] : values_) {
      if (is_of_targets(path, base)) fresh.emplace(path, value);
    }
  }
  values_ = std::move(fresh);
}

void SignalkSite::put_targets(Mounted& radar, Values& fresh) {
  const TargetListPtr list = target_list(radar);
  if (list == nullptr) return;
  const std::string base = "radars." + radar.radar.id;
  for (const wire::Target& target : list->targets()) {
    if (target.is_test()) continue;
    put(fresh, fmt::format("{}.targets.{}", base, target.number()), target_document(target, *list));
  }
  for (const wire::Alert& alert : list->alerts()) {
    put(fresh, fmt::format("notifications.{}.{}.{}", base, alert.number(), alert.instance()),
        notification_of(alert));
  }
}

void SignalkSite::tick(std::chrono::steady_clock::time_point now) {
  std::erase_if(listeners_, [](const auto& known) { return known.expired(); });
  for (Mounted& radar : radars_) {
    if (now - radar.targets_asked > kTargetsWanted) radar.wanted_targets = nullptr;
  }
  if (listeners_.empty()) return;
  refresh();
  const auto listeners = listeners_;
  for (const auto& known : listeners) {
    if (const auto listener = known.lock()) listener->on_tick(now);
  }
}

}  // namespace skerry::server
