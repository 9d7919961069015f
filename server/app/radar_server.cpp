#include "server/app/radar_server.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <optional>

#include "server/app/coast_rules.hpp"
#include "server/app/version.hpp"
#include "server/core/process_memory.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

constexpr double kMetresPerSecondPerKnot = 1852.0 / 3600.0;

RadarConfig config_of(const scenario::Radar& radar, std::uint32_t index, std::size_t own_ship,
                      std::uint64_t seed) {
  RadarConfig config;
  config.radar = index;
  config.own_ship = own_ship;
  config.name = radar.name();
  config.set.beam_width_deg = radar.beam_width_deg();
  config.set.antenna_height_m = radar.antenna_height_m();
  config.set.peak_power_w = radar.peak_power_kw() * 1e3;
  config.geometry = {radar.spokes(), radar.cells(), radar.bits()};
  config.rpm = radar.rpm();
  config.controls = {*RangeScale::find(radar.range_nm()), radar.gain(), radar.sea(), radar.rain()};
  config.seed = seed;
  return config;
}

std::string range_scales_text() {
  std::string text;
  for (double nm : RangeScale::kNauticalMiles)
    text += fmt::format("{}{}", text.empty() ? "" : ", ", nm);
  return text;
}

wire::Reply refusal(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return reply;
}

// What is wrong with a value, or nothing.
std::optional<std::string> complaint(const char* key, double value, double min, double max,
                                     const char* unit) {
  if (value >= min && value <= max) return std::nullopt;  // false for NaN
  return fmt::format("{}: {} is out of range; allowed: {} to {}{}", key, value, min, max, unit);
}

}  // namespace

struct RadarServer::Mount {
  std::string own_ship;
  VideoChannel channel;
  RadarUnit unit;
  Mount(std::string ship, const RadarConfig& config, Timeline& timeline, CoastService& coast,
        std::size_t workers)
      : own_ship(std::move(ship)),
        channel(ring_sectors(config)),
        unit(config, timeline, coast, channel, workers) {}
  // Half a second of sectors.
  static std::size_t ring_sectors(const RadarConfig& config) {
    const double sectors =
        config.geometry.spokes_per_turn * config.rpm / 60.0 / RadarUnit::kSectorSpokes;
    return static_cast<std::size_t>(std::max(8.0, std::ceil(0.5 * sectors)));
  }
};

RadarServer::RadarServer(const scenario::Scenario& scenario,
                         std::unique_ptr<const echo::ChartSource> chart, std::size_t workers)
    : scenario_name_(scenario.name()), timeline_(World(scenario)) {
  std::size_t count = 0;
  for (const auto& ship : scenario.own_ships())
    count += static_cast<std::size_t>(ship.radars_size());
  coast_ = std::make_unique<CoastService>(std::move(chart), count, coast_rules(scenario));
  const WorldStatePtr state = timeline_.latest();
  std::uint32_t index = 0;
  for (int i = 0; i < scenario.own_ships_size(); ++i) {
    const scenario::OwnShip& ship = scenario.own_ships(i);
    for (const scenario::Radar& radar : ship.radars()) {
      const RadarConfig config =
          config_of(radar, index, static_cast<std::size_t>(i), scenario.seed());
      radars_.push_back(std::make_unique<Mount>(ship.name(), config, timeline_, *coast_, workers));
      coast_->prepare_now(index,
                          radars_.back()->unit.wish(state->own_ships[static_cast<std::size_t>(i)],
                                                    config.controls));
      ++index;
    }
  }
}

RadarServer::~RadarServer() { stop(); }

void RadarServer::start() {
  const Epoch epoch{std::chrono::steady_clock::now(),
                    std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now())};
  coast_->start();
  for (auto& radar : radars_) radar->unit.start(epoch);
}

void RadarServer::stop() {
  for (auto& radar : radars_) radar->unit.stop();
}

wire::Hello RadarServer::hello() const {
  wire::Hello hello;
  hello.set_protocol_version(1);
  hello.set_server(kServerName);
  hello.set_scenario(scenario_name_);
  for (const auto& mount : radars_) {
    const RadarConfig& config = mount->unit.config();
    wire::RadarInfo* info = hello.add_radars();
    info->set_radar(config.radar);
    info->set_name(config.name);
    info->set_own_ship(mount->own_ship);
    info->set_spokes_per_turn(config.geometry.spokes_per_turn);
    info->set_cells(config.geometry.cells);
    info->set_bits(config.geometry.bits);
    info->set_rpm(config.rpm);
    info->set_beam_width_deg(config.set.beam_width_deg);
  }
  for (double nm : RangeScale::kNauticalMiles) hello.add_range_scales_nm(nm);
  return hello;
}

VideoChannel* RadarServer::find_channel(std::uint32_t radar, std::uint32_t view) {
  return radar < radars_.size() && view == 0 ? &radars_[radar]->channel : nullptr;
}

wire::Reply RadarServer::apply(const wire::Set& set) {
  if (!find_channel(set.radar(), set.view())) {
    return refusal(wire::Reply::UNKNOWN,
                   fmt::format("no view {} of radar {}; there are radars 0 to {}, each with view 0",
                               set.view(), set.radar(), radars_.size() - 1));
  }
  const auto check = [](bool given, const char* key, double value, double min, double max,
                        const char* unit) {
    return given ? complaint(key, value, min, max, unit) : std::nullopt;
  };
  for (const auto& wrong :
       {check(set.has_course_deg(), "course", set.course_deg(), 0.0, 360.0, " deg"),
        check(set.has_speed_kn(), "speed", set.speed_kn(), -10.0, 60.0, " kn"),
        check(set.has_gain(), "gain", set.gain(), 0.0, 100.0, ""),
        check(set.has_sea(), "sea", set.sea(), 0.0, 100.0, ""),
        check(set.has_rain(), "rain", set.rain(), 0.0, 100.0, "")}) {
    if (wrong) return refusal(wire::Reply::OUT_OF_RANGE, *wrong);
  }
  const auto scale = set.has_range_nm() ? RangeScale::find(set.range_nm()) : std::nullopt;
  if (set.has_range_nm() && !scale) {
    return refusal(wire::Reply::OUT_OF_RANGE,
                   fmt::format("range: {} NM is no range scale; allowed: {}", set.range_nm(),
                               range_scales_text()));
  }
  RadarUnit& unit = radars_[set.radar()]->unit;
  if (set.has_course_deg() || set.has_speed_kn()) {
    timeline_.order(unit.config().own_ship,
                    set.has_course_deg() ? std::optional(set.course_deg()) : std::nullopt,
                    set.has_speed_kn() ? std::optional(set.speed_kn()) : std::nullopt);
  }
  {
    const std::lock_guard lock(apply_mutex_);
    echo::ViewControls controls = unit.controls();
    if (scale) controls.range_scale = *scale;
    if (set.has_gain()) controls.gain = set.gain();
    if (set.has_sea()) controls.sea = set.sea();
    if (set.has_rain()) controls.rain = set.rain();
    if (!(controls == unit.controls())) {
      unit.set_controls(controls);
      settings_version_.fetch_add(1);
    }
  }
  return {};
}

wire::Settings RadarServer::settings(std::uint32_t radar, std::uint32_t view) const {
  const echo::ViewControls controls = radars_.at(radar)->unit.controls();
  wire::Settings settings;
  settings.set_radar(radar);
  settings.set_view(view);
  settings.set_range_nm(controls.range_scale.in_nautical_miles());
  settings.set_gain(controls.gain);
  settings.set_sea(controls.sea);
  settings.set_rain(controls.rain);
  return settings;
}

wire::OwnShip RadarServer::own_ship(std::uint32_t radar) const {
  const Mount& mount = *radars_.at(radar);
  const ShipState ship = timeline_.latest()->own_ships[mount.unit.config().own_ship];
  wire::OwnShip out;
  out.set_radar(radar);
  out.set_name(mount.own_ship);
  out.set_latitude_deg(ship.position.latitude_deg);
  out.set_longitude_deg(ship.position.longitude_deg);
  out.set_heading_deg(ship.heading_deg);
  out.set_speed_kn(ship.speed_mps / kMetresPerSecondPerKnot);
  out.set_rate_of_turn_deg_min(ship.rate_of_turn_deg_s * 60.0);
  out.set_ordered_course_deg(ship.ordered_course_deg);
  out.set_ordered_speed_kn(ship.ordered_speed_mps / kMetresPerSecondPerKnot);
  return out;
}

wire::Status RadarServer::status() const {
  wire::Status status;
  status.set_server(kServerName);
  status.set_scenario(scenario_name_);
  const auto up = std::chrono::steady_clock::now() - made_;
  status.set_scenario_s(in_seconds(timeline_.latest()->time.time_since_epoch()));
  status.set_uptime_s(std::chrono::duration<double>(up).count());
  status.set_resident_mib(resident_mib());
  for (const auto& mount : radars_) {
    const RadarCounters counters = mount->unit.counters();
    wire::RadarStatus* radar = status.add_radars();
    const std::uint32_t index = mount->unit.config().radar;
    radar->set_radar(index);
    radar->set_name(mount->unit.config().name);
    *radar->mutable_settings() = settings(index, 0);
    *radar->mutable_own_ship() = own_ship(index);
    radar->set_spokes(counters.spokes);
    radar->set_spokes_late(counters.spokes_late);
    radar->set_sectors_skipped(counters.sectors_skipped);
    radar->set_lateness_max_ms(counters.lateness_max_ms);
    radar->set_render_ns_per_cell(counters.render_ns_per_cell);
    radar->set_scan(counters.scan);
    radar->set_coast_edges(counters.coast_edges);
    for (const auto& [format, spokes] : mount->channel.spokes_encoded()) {
      (*radar->mutable_encodes())[format] = spokes;
    }
  }
  return status;
}

}  // namespace skerry::server
