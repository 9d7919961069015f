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

namespace skerry::server {
namespace {

using signalk::Json;

constexpr std::chrono::seconds kTargetPeriod{1};
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

std::optional<signalk::Movement> SignalkSite::movement() const {
  const signalk::OwnShip ship = own_ship();
  if (!ship.position || !ship.course_over_ground_deg || !ship.speed_over_ground_mps) {
    return std::nullopt;
  }
  return signalk::Movement{*ship.position, *ship.course_over_ground_deg,
                           *ship.speed_over_ground_mps};
}

std::vector<TrafficItem> SignalkSite::others() const {
  std::vector<TrafficItem> traffic = context_.host.traffic();
  std::erase_if(traffic, [this](const TrafficItem& item) {
    return std::find(item.radars.begin(), item.radars.end(), first_radar_) != item.radars.end();
  });
  return traffic;
}

std::vector<signalk::OtherVessel> SignalkSite::vessels() const {
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
    vessels.push_back({.mmsi = item.mmsi,
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

std::vector<Json> SignalkSite::targets(Mounted& radar) const {
  const std::vector<TrafficItem> traffic = others();
  const std::optional<signalk::Movement> own = movement();
  if (!own) return {};
  const double range_m =
      nautical_miles(context_.host.settings(radar.number, 0).range_nm()).in_metres();
  std::vector<Json> documents;
  for (const signalk::Target& target : radar.targets.update(traffic, *own, range_m, utc_now())) {
    documents.push_back(signalk::target_document(target, *own));
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
  const wire::Reply reply = context_.host.apply(set, origin);
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

SignalkOutcome SignalkSite::acquire(Mounted& radar, const Json& body) {
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
  const std::optional<signalk::Movement> own = movement();
  if (!own) return {409, "own ship's position or motion is not known"};
  const auto number =
      radar.targets.acquire(others(), *own, bearing / kRadiansPerDegree, distance, utc_now());
  if (!number) return {404, "no target there"};
  return {201, "OK", number};
}

SignalkOutcome SignalkSite::drop(Mounted& radar, std::string_view text) {
  targets(radar);  // what is tracked by now
  std::uint32_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size() || !radar.targets.drop(number)) {
    return {404, "no target of that number is tracked"};
  }
  return {};
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
    const std::string target_base = base + ".targets.";
    if (!targets_too) {
      for (const auto& [path, value] : values_) {
        if (path.starts_with(target_base)) fresh.emplace(path, value);
      }
      continue;
    }
    for (Json& target : targets(radar)) {
      const std::string number = fmt::format("{}", target["id"].get<std::uint32_t>());
      put(fresh, target_base + number, std::move(target));
    }
  }
  values_ = std::move(fresh);
}

void SignalkSite::tick(std::chrono::steady_clock::time_point now) {
  std::erase_if(listeners_, [](const auto& known) { return known.expired(); });
  if (listeners_.empty()) return;
  refresh();
  const auto listeners = listeners_;
  for (const auto& known : listeners) {
    if (const auto listener = known.lock()) listener->on_tick(now);
  }
}

}  // namespace skerry::server
