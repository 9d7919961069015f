#include "server/app/radar_server.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "server/app/coast_rules.hpp"
#include "server/app/control_ranges.hpp"
#include "server/app/radar_config.hpp"
#include "server/app/version.hpp"
#include "server/app/world_change.hpp"
#include "server/core/process_memory.hpp"
#include "server/radar/turn_echoes.hpp"
#include "server/world/board_registers.hpp"
#include "server/world/ship_units.hpp"
#include "server/world/world.hpp"

namespace skerry::server {
namespace {

std::size_t count_radars(const scenario::Scenario& scenario) {
  std::size_t count = 0;
  for (const auto& ship : scenario.own_ships())
    count += static_cast<std::size_t>(ship.radars_size());
  return count;
}

echo::PulseChoice choice_of(wire::PulseChoice pulse) {
  switch (pulse) {
    case wire::PULSE_SHORT:
      return echo::PulseChoice::short_pulse;
    case wire::PULSE_MEDIUM:
      return echo::PulseChoice::medium_pulse;
    case wire::PULSE_LONG:
      return echo::PulseChoice::long_pulse;
    default:
      return echo::PulseChoice::automatic;
  }
}

wire::PulseChoice message_of(echo::PulseChoice pulse) {
  switch (pulse) {
    case echo::PulseChoice::short_pulse:
      return wire::PULSE_SHORT;
    case echo::PulseChoice::medium_pulse:
      return wire::PULSE_MEDIUM;
    case echo::PulseChoice::long_pulse:
      return wire::PULSE_LONG;
    case echo::PulseChoice::automatic:
      break;
  }
  return wire::PULSE_AUTO;
}

}  // namespace

struct RadarServer::Mount {
  std::string own_ship;
  RadarUnit unit;
  Mount(std::string ship, const RadarConfig& config, Timeline& timeline, CoastService& coast,
        Airwaves& airwaves, std::size_t workers)
      : own_ship(std::move(ship)), unit(config, timeline, coast, airwaves, workers) {}
};

RadarServer::RadarServer(const scenario::Scenario& scenario,
                         std::unique_ptr<const echo::ChartSource> chart, std::size_t workers)
    : scenario_name_(scenario.name()),
      timeline_(World(scenario)),
      coast_(std::make_unique<CoastService>(std::move(chart), count_radars(scenario),
                                            coast_rules(scenario))),
      airwaves_(count_radars(scenario)) {
  const WorldStatePtr state = timeline_.latest();
  std::uint32_t index = 0;
  for (int i = 0; i < scenario.own_ships_size(); ++i) {
    const scenario::OwnShip& ship = scenario.own_ships(i);
    for (const scenario::Radar& radar : ship.radars()) {
      const RadarConfig config =
          radar_config(radar, index, static_cast<std::size_t>(i), scenario.seed());
      radars_.push_back(
          std::make_unique<Mount>(ship.name(), config, timeline_, *coast_, airwaves_, workers));
      coast_->prepare_now(index,
                          radars_.back()->unit.wish(state->own_ships[static_cast<std::size_t>(i)],
                                                    config.controls));
      ++index;
    }
  }
  mount_boards(scenario);
}

void RadarServer::mount_boards(const scenario::Scenario& scenario) {
  const auto index_of = [this](const std::string& name) {
    const auto found = std::find_if(radars_.begin(), radars_.end(), [&](const auto& mount) {
      return mount->unit.config().name == name;
    });
    return static_cast<std::uint32_t>(found - radars_.begin());
  };
  for (const scenario::OwnShip& ship : scenario.own_ships()) {
    for (const scenario::Radar& radar : ship.radars()) {
      const auto index = static_cast<std::uint32_t>(boards_.size());
      BoardSetup setup;
      setup.radar = index;
      setup.set = radars_[index]->unit.config().set;
      setup.initial = board_registers(radar, index_of);
      setup.echoes = [this, index](std::uint32_t source) { return echoes_of(source, index); };
      setup.has_radar = [this, index](std::uint32_t source) { return is_shipmate(source, index); };
      setup.on_air = [&unit = radars_[index]->unit]() -> BoardSetup::OnAir {
        return {unit.pulse_on_air(), unit.radar_controls().transmit};
      };
      boards_.push_back(std::make_shared<BoardUnit>(std::move(setup), radar.name()));
    }
  }
}

bool RadarServer::is_shipmate(std::uint32_t radar, std::uint32_t of) const {
  return radar < radars_.size() &&
         radars_[radar]->unit.config().own_ship == radars_[of]->unit.config().own_ship;
}

std::shared_ptr<echo::SweepEchoes> RadarServer::echoes_of(std::uint32_t radar, std::uint32_t of) {
  if (!is_shipmate(radar, of)) return nullptr;
  return std::make_shared<TurnEchoes>(radars_[radar]->unit, timeline_, *coast_, airwaves_);
}

void RadarServer::name_shared_rings(std::uint16_t tcp_port, std::size_t bytes) {
  for (std::size_t radar = 0; radar < boards_.size(); ++radar) {
    boards_[radar]->set_shared_ring(fmt::format("/skerry-board-{}-{}", tcp_port, radar), bytes);
  }
}

BoardPortPtr RadarServer::find_board(std::uint32_t radar) {
  return radar < boards_.size() ? boards_[radar] : nullptr;
}

RadarServer::~RadarServer() { stop(); }

void RadarServer::start() {
  for (auto& radar : radars_) radar->unit.warm_up();
  const Epoch epoch{std::chrono::steady_clock::now(),
                    std::chrono::time_point_cast<Duration>(std::chrono::system_clock::now())};
  coast_->start();
  for (auto& radar : radars_) radar->unit.start(epoch);
  for (auto& board : boards_) board->start(epoch.steady, epoch.utc);
}

void RadarServer::stop() {
  for (auto& board : boards_) board->stop();
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
    info->set_rpm(config.set.rpm);
    info->set_beam_width_deg(config.set.beam_width_deg);
    info->set_set(config.set.name);
    info->set_band(config.set.band() == echo::Band::s ? "S" : "X");
    info->set_antenna_height_m(config.set.antenna_height_m);
    info->set_board(true);
  }
  for (double nm : RangeScale::kNauticalMiles) hello.add_range_scales_nm(nm);
  return hello;
}

VideoChannelPtr RadarServer::find_channel(std::uint32_t radar, std::uint32_t view) {
  if (radar >= radars_.size()) return nullptr;
  const RadarViewPtr found = radars_[radar]->unit.views().find(view);
  return found ? VideoChannelPtr(found, &found->channel) : nullptr;
}

std::optional<std::uint32_t> RadarServer::open_view(
    std::uint32_t radar, std::uint32_t like, bool /*follows*/,
    const std::function<void(VideoChannel&)>& prepare) {
  const RadarViewPtr opened = radars_.at(radar)->unit.views().open(like, prepare);
  return opened ? std::optional(opened->number) : std::nullopt;
}

void RadarServer::close_view(std::uint32_t radar, std::uint32_t view) {
  radars_.at(radar)->unit.views().close(view);
}

std::optional<wire::Reply> RadarServer::refusal_by_state(const wire::Set& set) const {
  if (set.radar() >= radars_.size() || !radars_[set.radar()]->unit.views().find(set.view())) {
    return refusal(
        wire::Reply::UNKNOWN,
        fmt::format("no view {} of radar {}; there are radars 0 to {}, each with view 0 and those "
                    "that consoles have opened",
                    set.view(), set.radar(), radars_.size() - 1));
  }
  const RangeScale on_air = radars_[set.radar()]->unit.range_on_air();
  if (set.view() != 0 && set.has_range_nm() && set.range_nm() > on_air.in_nautical_miles()) {
    return refusal(wire::Reply::OUT_OF_RANGE,
                   fmt::format("range: {} NM is more than the radar's own range scale; allowed in "
                               "view {}: up to {} NM",
                               set.range_nm(), set.view(), on_air.in_nautical_miles()));
  }
  return std::nullopt;
}

wire::Reply RadarServer::apply(const wire::Set& set, const std::string& /*origin*/) {
  if (const auto wrong = refusal_of(set)) return *wrong;
  const std::lock_guard lock(apply_mutex_);
  if (const auto wrong = refusal_by_state(set)) return *wrong;
  if (set.has_world()) {
    Environment environment = *timeline_.environment();
    const ScenarioTime now = timeline_.latest()->time;
    if (const auto wrong = change_environment(set.world(), now, environment)) return *wrong;
    timeline_.set_environment(std::move(environment));
    world_version_.fetch_add(1);
  }
  RadarUnit& unit = radars_[set.radar()]->unit;
  if (set.has_course_deg() || set.has_speed_kn()) {
    timeline_.order(unit.config().own_ship,
                    set.has_course_deg() ? std::optional(set.course_deg()) : std::nullopt,
                    set.has_speed_kn() ? std::optional(set.speed_kn()) : std::nullopt);
  }
  apply_to_radar(set, unit);
  return {};
}

void RadarServer::apply_to_radar(const wire::Set& set, RadarUnit& unit) {
  const RadarViewPtr view = unit.views().find(set.view());
  if (!view) return;  // closed since it was looked for
  echo::ViewControls controls = *view->controls.get();
  const echo::ViewControls controls_before = controls;
  if (set.has_range_nm()) controls.range_scale = *RangeScale::find(set.range_nm());
  if (set.has_gain()) controls.gain = set.gain();
  if (set.has_sea()) controls.sea = set.sea();
  if (set.has_rain()) controls.rain = set.rain();
  if (set.has_sea_auto()) controls.sea_auto = set.sea_auto();
  if (set.has_interference_rejection())
    controls.interference_rejection = set.interference_rejection();
  if (set.has_echo_stretch()) controls.echo_stretch = set.echo_stretch();
  if (set.has_integration()) controls.integration = set.integration();
  if (set.has_stretch_bearing()) controls.stretch_bearing = set.stretch_bearing();
  if (set.has_decimation()) {
    controls.decimation =
        set.decimation() == wire::MEAN ? echo::Decimation::mean : echo::Decimation::peak;
  }
  echo::RadarControls radar = unit.radar_controls();
  const echo::RadarControls radar_before = radar;
  if (set.has_transmit()) radar.transmit = set.transmit();
  if (set.has_pulse()) radar.pulse = choice_of(set.pulse());
  if (set.has_tune_auto()) radar.tune_auto = set.tune_auto();
  if (set.has_tune()) radar.tune = set.tune();
  if (controls == controls_before && radar == radar_before) return;
  view->controls.set(controls);
  unit.set_radar_controls(radar);
  settings_version_.fetch_add(1);
}

wire::Settings RadarServer::settings(std::uint32_t radar, std::uint32_t view) const {
  const RadarUnit& unit = radars_.at(radar)->unit;
  RadarViewPtr found = unit.views().find(view);
  if (!found) found = unit.views().get()->front();
  const echo::ViewControls controls = *found->controls.get();
  const echo::RadarControls radar_controls = unit.radar_controls();
  const echo::Pulse& pulse = unit.pulse_on_air();
  const double on_air = unit.range_on_air().in_nautical_miles();
  wire::Settings settings;
  settings.set_radar(radar);
  settings.set_view(view);
  settings.set_range_nm(std::min(controls.range_scale.in_nautical_miles(), on_air));
  settings.set_gain(controls.gain);
  settings.set_sea(controls.sea);
  settings.set_rain(controls.rain);
  settings.set_sea_auto(controls.sea_auto);
  settings.set_interference_rejection(controls.interference_rejection);
  settings.set_echo_stretch(controls.echo_stretch);
  settings.set_integration(controls.integration);
  settings.set_standby(!radar_controls.transmit);
  settings.set_pulse(message_of(radar_controls.pulse));
  settings.set_tune_auto(radar_controls.tune_auto);
  settings.set_tune(radar_controls.tune);
  settings.set_pulse_length_us(pulse.length_s * 1e6);
  settings.set_prf_hz(pulse.prf_hz);
  settings.set_radar_range_nm(on_air);
  settings.set_stretch_bearing(controls.stretch_bearing);
  settings.set_decimation(controls.decimation == echo::Decimation::mean ? wire::MEAN : wire::PEAK);
  return settings;
}

wire::World RadarServer::world() const {
  return world_message(*timeline_.environment(), timeline_.latest()->time);
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
  out.set_speed_kn(ship.speed_mps / knots_in_mps(1.0));
  out.set_rate_of_turn_deg_min(ship.rate_of_turn_deg_s * 60.0);
  out.set_ordered_course_deg(ship.ordered_course_deg);
  out.set_ordered_speed_kn(ship.ordered_speed_mps / knots_in_mps(1.0));
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
  *status.mutable_world() = world();
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
    *radar->mutable_board() = boards_[index]->state();
    for (const RadarViewPtr& view : *mount->unit.views().get()) {
      for (const auto& [format, spokes] : view->channel.spokes_encoded()) {
        (*radar->mutable_encodes())[format] += spokes;
      }
      if (view->number != 0) *radar->add_views() = settings(index, view->number);
    }
  }
  return status;
}

}  // namespace skerry::server
