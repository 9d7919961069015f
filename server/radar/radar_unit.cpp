#include "server/radar/radar_unit.hpp"

#include <fmt/format.h>
#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <mutex>

#include "server/world/dead_reckoning.hpp"

namespace skerry::server {
namespace {

// An antenna does not wait for a web page: its thread goes before others where the system lets it
// (as root or with CAP_SYS_NICE), and is an ordinary one where not.
constexpr int kNiceness = -10;
void go_before_others() { setpriority(PRIO_PROCESS, static_cast<id_t>(gettid()), kNiceness); }

constexpr Length kFarthestCoast = nautical_miles(RangeScale::kNauticalMiles.back());

// What a view shows of a radar on `range`: view 0 is the radar's own, others show at most as far.
echo::ViewControls shown_by(const RadarView& view, RangeScale range) {
  echo::ViewControls controls = view.controls_in_force();
  if (view.number == 0 || range.index() < controls.range_scale.index())
    controls.range_scale = range;
  return controls;
}

double rpm_of(const echo::RadarSet& set, const echo::RadarControls& controls) {
  return controls.rotation_rpm > 0.0 ? controls.rotation_rpm : set.rpm;
}

// Half a second of sectors.
std::size_t ring_sectors(const RadarConfig& config) {
  const double sectors = config.geometry.spokes_per_turn *
                         rpm_of(config.set, config.radar_controls) / 60.0 /
                         RadarUnit::kSectorSpokes;
  return static_cast<std::size_t>(std::max(8.0, std::ceil(0.5 * sectors)));
}

// Sleeps until `deadline` or a stop, whichever comes first.
class Sleeper {
 public:
  bool until(std::chrono::steady_clock::time_point deadline, const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    condition_.wait_until(lock, stop, deadline, [] { return false; });
    return !stop.stop_requested();
  }

 private:
  std::mutex mutex_;
  std::condition_variable_any condition_;
};

}  // namespace

RadarUnit::RadarUnit(const RadarConfig& config, Timeline& timeline, CoastService& coast,
                     Airwaves& airwaves, std::size_t workers)
    : config_(config),
      timeline_(timeline),
      coast_keeper_(coast, config.radar),
      airwaves_(airwaves),
      workers_(workers, go_before_others),
      clock_(rpm_of(config.set, config.radar_controls), config.geometry.spokes_per_turn),
      renderer_(config.set, config.geometry, clock_, config.radar, config.controls.range_scale,
                config.radar_controls,
                [this](std::size_t count, const std::function<void(std::size_t)>& body) {
                  workers_.run(count, body);
                }),
      scenes_({config.own_ship, config.radar, config.set.band(), config.seed, config.obstructions},
              airwaves),
      views_(config.controls, ring_sectors(config)),
      radar_controls_(config.radar_controls) {
  tell_airwaves(config.radar_controls, config.controls.range_scale);
}

// Tables of weather, set and range scale take tens of milliseconds: once on the air, that would be
// sectors late.
void RadarUnit::warm_up() {
  shown_scale_ = views_.get()->front()->controls.get()->range_scale;
  renderer_.set_radar(shown_scale_, *radar_controls_.get(), clock_);
  look_after_views();
  // The radar's own builder stays fresh: not all radars are on the air yet.
  SceneBuilder scenes = scenes_;
  scenes.set_rig(radar_controls().blanked, radar_controls().bearing_alignment_deg);
  renderer_.render(*scenes.build(timeline_.at(ScenarioTime{}), coast_keeper_.latest()), 0,
                   kSectorSpokes);
}

echo::RadarSet RadarUnit::set_on_air() const {
  echo::RadarSet set = config_.set;
  const echo::RadarControls controls = radar_controls();
  set.rpm = rpm_of(set, controls);
  if (controls.antenna_height_m > 0.0) set.antenna_height_m = controls.antenna_height_m;
  return set;
}

void RadarUnit::start(const Epoch& epoch) {
  thread_ = std::jthread([this, epoch](const std::stop_token& stop) {
    pthread_setname_np(pthread_self(), fmt::format("radar-{}", config_.radar).c_str());
    go_before_others();
    run(stop, epoch);
  });
}

void RadarUnit::stop() {
  thread_.request_stop();
  if (thread_.joinable()) thread_.join();
}

echo::RadarResolution RadarUnit::resolution(RangeScale range) const {
  std::uint32_t cells = config_.geometry.cells;
  for (const RadarViewPtr& view : *views_.get()) {
    cells = std::max(cells, echo::row_cells_for(config_.geometry, range, shown_by(*view, range)));
  }
  const Length reach = range.length() * (double{1} * cells / config_.geometry.cells);
  return {std::min(reach.in_metres(), kFarthestCoast.in_metres()),
          config_.geometry.cell_size(range).in_metres(), 360.0 / config_.geometry.spokes_per_turn};
}

CoastWish RadarUnit::wish(const ShipState& own_ship, const echo::ViewControls& controls) const {
  return {own_ship.position, own_ship.speed_mps, resolution(controls.range_scale)};
}

void RadarUnit::tell_airwaves(const echo::RadarControls& controls, RangeScale range) {
  Emission emission;
  emission.own_ship = config_.own_ship;
  emission.transmits = controls.transmit;
  echo::EmitterState state;
  state.identity = identity_of(config_.seed, Fixture::emitter, config_.radar);
  // When the beam stood over the bow, at the rate it turns with.
  state.antenna_start = bow_passed_;
  const echo::RadarSet set = set_on_air();
  emission.emitter =
      echo::emitter_of(set, set.pulse_for(range, controls.pulse), state, kTransmitterSpread);
  airwaves_.set(config_.radar, emission);
}

void RadarUnit::look_after_views() {
  auto views = views_.get();
  if (views != rendered_) {
    renderer_.keep_views([&](std::uint32_t number) {
      return std::any_of(views->begin(), views->end(),
                         [&](const RadarViewPtr& view) { return view->number == number; });
    });
    rendered_ = std::move(views);
  }
  for (const RadarViewPtr& view : *rendered_) {
    renderer_.set_view(view->number, shown_by(*view, shown_scale_));
  }
}

bool RadarUnit::make_sector(std::uint64_t first, const Epoch& epoch, std::vector<ViewSector>& out) {
  out.clear();
  const echo::RadarControls radar_controls = *radar_controls_.get();
  echo::ViewControls controls = *views_.get()->front()->controls.get();
  const WorldStatePtr state = timeline_.at(clock_.time_of(first));
  if (clock_.time_of(first) - state->time > 3 * World::kTick) return false;
  coast_keeper_.look_after(wish(state->own_ships[config_.own_ship], controls), state->time);
  const CoastInSightPtr coast = coast_keeper_.latest();
  // A longer range is shown when its coast is there, a moment after it was asked for.
  if (coast->picture->range_m < controls.range_scale.length().in_metres() &&
      coast_keeper_.is_waiting(state->time)) {
    controls.range_scale = shown_scale_;
  }
  shown_scale_ = controls.range_scale;
  coast_edges_.store(coast->picture->edge_count(), std::memory_order_relaxed);
  scan_.store(static_cast<std::uint32_t>(first / config_.geometry.spokes_per_turn),
              std::memory_order_relaxed);
  tell_airwaves(radar_controls, shown_scale_);
  if (!radar_controls.transmit) return true;

  renderer_.set_radar(shown_scale_, radar_controls, clock_);
  look_after_views();
  scenes_.set_rig(radar_controls.blanked, radar_controls.bearing_alignment_deg);
  renderer_.render(*scenes_.build(state, coast), first, kSectorSpokes);
  cut_spokes(first, epoch, *state, out);
  return true;
}

namespace {

// Where the own ship is between two places that are a sector's sailing apart: straight in latitude
// and longitude, 1e-7 m off at 30 m/s.  A share of 0 is `from`, of 1 `to`.
GeoPoint between(GeoPoint from, GeoPoint to, double share) {
  const double east = to.longitude_deg - from.longitude_deg;
  // Across the antimeridian, or at a pole: the nearer of the two.
  if (east > 1.0 || east < -1.0) return share < 0.5 ? from : to;
  return {from.latitude_deg + share * (to.latitude_deg - from.latitude_deg),
          from.longitude_deg + share * east};
}

}  // namespace

void RadarUnit::cut_spokes(std::uint64_t first, const Epoch& epoch, const WorldState& state,
                           std::vector<ViewSector>& out) {
  const std::uint32_t cells = config_.geometry.cells;
  const ShipState& own = state.own_ships[config_.own_ship];
  for (const RadarViewPtr& view : *rendered_) {
    out.push_back({view, {}});
    out.back().sector.spokes.reserve(kSectorSpokes);
  }
  const auto place_at = [&](std::uint64_t spoke) {
    return position_at(own, clock_.time_of(spoke) - state.time).position;
  };
  const GeoPoint from = place_at(first), to = place_at(first + kSectorSpokes);
  for (std::uint32_t k = 0; k < kSectorSpokes; ++k) {
    const std::uint64_t n = first + k;
    SpokeHeader header;
    header.radar = config_.radar;
    header.scan = static_cast<std::uint32_t>(n / config_.geometry.spokes_per_turn);
    header.index = static_cast<std::uint32_t>(n % config_.geometry.spokes_per_turn);
    header.geometry = config_.geometry;
    header.scenario_time = clock_.time_of(n);
    header.utc = epoch.utc + header.scenario_time.time_since_epoch();
    const Duration dt = header.scenario_time - state.time;
    header.heading =
        TrueBearing::from(degrees(own.heading_deg + own.rate_of_turn_deg_s * in_seconds(dt)));
    header.own_ship = between(from, to, double{1} * k / kSectorSpokes);
    for (ViewSector& part : out) {
      header.view = part.view->number;
      header.sequence = part.view->sequence++;
      header.range_scale = renderer_.range_of(header.view);
      header.instrumented_range = renderer_.instrumented_range_of(header.view);
      const auto video = renderer_.video(header.view).subspan(std::size_t{k} * cells, cells);
      auto spoke = std::make_shared<Spoke>(Spoke{header, {video.begin(), video.end()}});
      if (const auto doppler = renderer_.doppler(header.view); !doppler.empty()) {
        const auto own_cells = doppler.subspan(std::size_t{k} * cells, cells);
        spoke->doppler.assign(own_cells.begin(), own_cells.end());
      }
      part.sector.spokes.push_back(std::move(spoke));
    }
  }
}

void RadarUnit::turn_as_asked(std::uint64_t first) {
  const echo::SpokeClock before = clock_;
  clock_.change_rate(first, rpm_of(config_.set, radar_controls()));
  if (clock_ == before) return;
  const std::uint32_t turn = config_.geometry.spokes_per_turn;
  bow_passed_ = clock_.time_of(first - first % turn);
}

void RadarUnit::run(const std::stop_token& stop, const Epoch& epoch) {
  shown_scale_ = config_.controls.range_scale;
  coast_keeper_.begin(resolution(shown_scale_));
  std::vector<ViewSector> sectors;
  Sleeper sleeper;
  double mean_ns = 0.0;
  const auto end_of = [&](std::uint64_t first) {
    return epoch.steady + clock_.time_of(first + kSectorSpokes).time_since_epoch();
  };
  for (std::uint64_t first = 0;; first += kSectorSpokes) {
    turn_as_asked(first);
    if (!sleeper.until(end_of(first), stop)) return;
    const auto begun = std::chrono::steady_clock::now();
    if (begun > end_of(first) + kGiveUp) {
      sectors_skipped_.fetch_add(1, std::memory_order_relaxed);
      continue;
    }
    if (!make_sector(first, epoch, sectors)) {
      sectors_skipped_.fetch_add(1, std::memory_order_relaxed);
      continue;
    }
    if (sectors.empty()) continue;
    const auto made = std::chrono::steady_clock::now();
    for (const ViewSector& part : sectors) part.view->channel.publish(part.sector);

    const Duration late = std::chrono::steady_clock::now() - end_of(first);
    if (late.count() > lateness_max_ns_.load(std::memory_order_relaxed)) {
      lateness_max_ns_.store(late.count(), std::memory_order_relaxed);
    }
    if (late > clock_.time_of(first + kSectorSpokes) - clock_.time_of(first)) {
      spokes_late_.fetch_add(kSectorSpokes, std::memory_order_relaxed);
    }
    spokes_.fetch_add(kSectorSpokes, std::memory_order_relaxed);
    const double ns = static_cast<double>(Duration(made - begun).count()) /
                      (double{kSectorSpokes} * config_.geometry.cells);
    mean_ns += (ns - mean_ns) / 64.0;
    render_ns_per_cell_.store(mean_ns, std::memory_order_relaxed);
  }
}

RadarCounters RadarUnit::counters() const {
  return {spokes_.load(),
          spokes_late_.load(),
          sectors_skipped_.load(),
          static_cast<double>(lateness_max_ns_.load()) * 1e-6,
          render_ns_per_cell_.load(),
          scan_.load(),
          coast_edges_.load()};
}

}  // namespace skerry::server
