#include "server/app/radar_server.hpp"

#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <stdexcept>

#include "protocol/picture/label_text.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/app/options/coast_rules.hpp"
#include "server/app/options/radar_config.hpp"
#include "server/app/radar_mount.hpp"
#include "server/app/told_ship.hpp"
#include "server/app/traffic_list.hpp"
#include "server/app/version.hpp"
#include "server/core/process_memory.hpp"
#include "server/radar/turn_echoes.hpp"
#include "server/world/board_registers.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/ship_reading.hpp"
#include "server/world/world.hpp"
#include "server/world/world_change.hpp"

namespace skerry::server {
namespace {

std::size_t count_radars(const scenario::Scenario& scenario) {
  std::size_t count = 0;
  for (const auto& ship : scenario.own_ships())
    count += static_cast<std::size_t>(ship.radars_size());
  return count;
}

void log_lines(const std::vector<LoadWatch::Line>& lines) {
  for (const LoadWatch::Line& line : lines) {
    spdlog::log(line.is_warning ? spdlog::level::warn : spdlog::level::info, line.text);
  }
}

}  // namespace

RadarServer::RadarServer(const scenario::Scenario& scenario,
                         std::unique_ptr<const echo::ChartSource> chart, std::size_t workers,
                         std::vector<ExerciseDocument> documents)
    : scenario_name_(scenario.name()),
      timeline_(World(scenario)),
      coast_(std::make_unique<CoastService>(std::move(chart), count_radars(scenario),
                                            coast_rules(scenario))),
      chart_desk_(*coast_),
      airwaves_(count_radars(scenario)),
      inputs_(count_radars(scenario), std::move(documents)),
      shore_(timeline_, *coast_, inputs_, [this] { return instant().time; }),
      rain_(timeline_, scenario.seed(), [this] { return instant().time; }) {
  const WorldStatePtr state = timeline_.latest();
  std::uint32_t index = 0;
  for (int i = 0; i < scenario.own_ships_size(); ++i) {
    const scenario::OwnShip& ship = scenario.own_ships(i);
    for (const scenario::Radar& radar : ship.radars()) {
      const RadarConfig config =
          radar_config(radar, index, static_cast<std::size_t>(i), scenario.seed());
      radars_.push_back(std::make_unique<Mount>(ship.name(), config, timeline_, *coast_, airwaves_,
                                                workers, inputs_));
      coast_->prepare_now(index,
                          radars_.back()->unit.wish(state->own_ships[static_cast<std::size_t>(i)],
                                                    config.controls.range_scale));
      ++index;
    }
  }
  std::vector<RadarUnit*> units;
  for (const auto& radar : radars_) units.push_back(&radar->unit);
  desk_ = std::make_unique<ControlDesk>(timeline_, std::move(units), initial_locks(scenario),
                                        ChangeLog{}, &inputs_);
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

void RadarServer::start(Duration ago) {
  for (auto& radar : radars_) radar->unit.warm_up();
  timeline_.make(static_cast<std::uint64_t>(ago / World::kTick));
  const ClockReading now = clocks_();
  const ClockReading zero{now.steady - ago, now.utc - ago};
  const Epoch epoch{zero.steady, zero.utc, ScenarioTime(ago)};
  system_utc_.set(UtcClock{{}, epoch.utc});
  utc_.set(UtcClock{{}, epoch.utc});
  epoch_.set(epoch);
  inputs_.began(epoch.utc, kServerName);
  coast_->start();
  shore_.start();
  rain_.start();
  for (auto& radar : radars_) radar->unit.start(epoch);
  for (auto& board : boards_) board->start(epoch.steady, epoch.utc);
  clock_.start("clock", ClockFollower::kLook,
               [this, follower = ClockFollower(zero)](const std::stop_token&) mutable {
                 look_at_clock(follower);
               });
  load_.start("load", LoadWatch::kLook, [this](const std::stop_token&) {
    log_lines(load_watch_.look(pace(), std::chrono::steady_clock::now()));
  });
}

std::vector<RadarPace> RadarServer::pace() const {
  std::vector<RadarPace> pace;
  for (const auto& mount : radars_) {
    const RadarCounters counters = mount->unit.counters();
    pace.push_back({mount->unit.config().radar, counters.sectors, counters.sectors_skipped});
  }
  return pace;
}

void RadarServer::look_at_clock(ClockFollower& follower) {
  const UtcClock before = follower.clock();
  const auto step = follower.look(clocks_());
  const UtcClock& clock = follower.clock();
  if (clock == before) return;
  if (step) {
    spdlog::warn("the system's clock was set by {:+.3f} s, from {} to {}; all UTC follows",
                 in_seconds(step->by()), utc_text(step->before), utc_text(step->after));
  }
  system_utc_.set(clock);
  tell_clock(clock);
}

// Scenario time is so much behind what the clock of the system says of it.
void RadarServer::tell_clock(const UtcClock& clock) {
  const std::lock_guard lock(utc_mutex_);
  UtcClock told = clock;
  told.utc += Duration(shift_.load());
  inputs_.follows(told);
  utc_.set(told);
  for (auto& board : boards_) board->set_utc(told);
  for (auto& radar : radars_) radar->unit.set_utc(told);
}

void RadarServer::stop() {
  clock_.stop();
  load_.stop();
  log_lines(load_watch_.end());
  rain_.stop();
  shore_.stop();
  for (auto& board : boards_) board->stop();
  for (auto& radar : radars_) radar->unit.stop();
  coast_->stop();  // it answers clients, so before those who serve them are gone
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
    std::uint32_t radar, std::uint32_t like, bool follows,
    const std::function<void(VideoChannel&)>& prepare) {
  const RadarViewPtr opened = radars_.at(radar)->unit.views().open(like, follows, prepare);
  views_version_.fetch_add(1);
  return opened ? std::optional(opened->number) : std::nullopt;
}

void RadarServer::close_view(std::uint32_t radar, std::uint32_t view) {
  radars_.at(radar)->unit.views().close(view);
  views_version_.fetch_add(1);
}

std::vector<RadarHost::View> RadarServer::views(std::uint32_t radar) {
  std::vector<View> out;
  const std::shared_ptr<const RadarViews> views = radars_.at(radar)->unit.views().get();
  for (const RadarViewPtr& view : *views) {
    out.push_back({view->number, VideoChannelPtr(view, &view->channel)});
  }
  return out;
}

wire::Settings RadarServer::settings(std::uint32_t radar, std::uint32_t view) const {
  return desk_->settings(radar, view);
}

std::uint64_t RadarServer::settings_version() const {
  desk_->flush_log();
  return desk_->settings_version();
}

wire::World RadarServer::world() const {
  const WorldStatePtr state = timeline_.latest();
  wire::World world = world_message(*timeline_.environment(), state->exercise);
  world.set_scenario_s(in_seconds(state->time.time_since_epoch()));
  world.set_exercise_s(in_seconds(state->exercise));
  world.set_frozen(state->frozen);
  world.set_rate(state->rate);
  return world;
}

std::optional<wire::ExerciseState> RadarServer::exercise_state() const {
  wire::ExerciseState state;
  instant();  // so that the newest tick is that of now
  timeline_.tell(state);
  for (wire::ExerciseShip& ship : *state.mutable_ships()) {
    if (!ship.own()) continue;
    for (std::uint32_t radar = 0; radar < radars_.size(); ++radar) {
      if (radars_[radar]->unit.config().own_ship == ship.number()) ship.add_radars(radar);
    }
    if (!ship.radars().empty()) ship.set_con(con_shown(ship.radars(0)));
  }
  return state;
}

wire::OwnShip RadarServer::own_ship(std::uint32_t radar) const {
  const Mount& mount = *radars_.at(radar);
  const Instant now = instant();
  const ShipState& ship = now.state->own_ships[mount.unit.config().own_ship];
  const Duration into = now.time - now.state->time;
  const ShipPlace place = position_at(ship, into);
  wire::OwnShip out = told_ship(ship, place, reading_at(*now.state, ship, into));
  out.set_radar(radar);
  out.set_name(mount.own_ship);
  out.set_utc_ns(static_cast<std::uint64_t>(now.utc.time_since_epoch().count()));
  const ExerciseLog::Text& text = now.state->log->texts[mount.unit.config().own_ship];
  out.set_text(text.text);
  out.set_texts(text.count);
  if (ship.con) out.mutable_con()->set_con(con_shown(radar));
  return out;
}

RadarServer::Instant RadarServer::instant() const {
  Instant now;
  const std::shared_ptr<const Epoch> epoch = epoch_.get();
  if (!epoch) {
    now.state = timeline_.latest();
    now.time = now.state->time;
    now.utc = clocks_().utc;
    return now;
  }
  now.time =
      ScenarioTime(std::chrono::steady_clock::now() - epoch->steady) - Duration(shift_.load());
  now.utc = utc_.get()->at(now.time);
  now.state = timeline_.at(now.time);
  return now;
}

std::vector<TrafficItem> RadarServer::traffic() const {
  const Instant now = instant();
  std::vector<TrafficItem> items = traffic_of(*now.state, now.time);
  for (const auto& mount : radars_) {
    const RadarConfig& config = mount->unit.config();
    items[config.own_ship].radars.push_back(config.radar);
  }
  return items;
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
    const std::shared_ptr<const RadarViews> views = mount->unit.views().get();
    for (const RadarViewPtr& view : *views) {
      for (const auto& [format, spokes] : view->channel.spokes_encoded()) {
        (*radar->mutable_encodes())[format] += spokes;
      }
      if (view->number != 0) *radar->add_views() = settings(index, view->number);
    }
  }
  return status;
}

}  // namespace skerry::server
