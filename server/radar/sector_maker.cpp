#include "server/radar/sector_maker.hpp"

#include <algorithm>
#include <memory>
#include <utility>

#include "server/radar/set_faults.hpp"
#include "server/radar/thread_priority.hpp"
#include "server/world/dead_reckoning.hpp"
#include "server/world/ship_reading.hpp"

namespace skerry::server {
namespace {

constexpr Length kFarthestCoast = nautical_miles(RangeScale::kNauticalMiles.back());

// The controls of a view while the radar is on `range`: view 0 is the radar's own, others reach at
// most as far.
echo::ViewControls shown_by(const ViewInForce& view, RangeScale range) {
  echo::ViewControls controls = view.controls;
  if (view.number == 0 || range.index() < controls.range_scale.index())
    controls.range_scale = range;
  return controls;
}

// The own ship's place between two places that are a sector's sailing apart: linear in latitude and
// longitude. Error: 1e-7 m at 30 m/s.  A share of 0 is `from`, of 1 `to`.
GeoPoint between(GeoPoint from, GeoPoint to, double share) {
  const double east = to.longitude_deg - from.longitude_deg;
  // Across the antimeridian, or at a pole: the nearer of the two.
  if (east > 1.0 || east < -1.0) return share < 0.5 ? from : to;
  return {from.latitude_deg + share * (to.latitude_deg - from.latitude_deg),
          from.longitude_deg + share * east};
}

}  // namespace

double rpm_of(const echo::RadarSet& set, const echo::RadarControls& controls) {
  return controls.rotation_rpm > 0.0 ? controls.rotation_rpm : set.rpm;
}

SectorMaker::SectorMaker(const RadarConfig& config, std::size_t workers)
    : config_(config),
      workers_(workers, go_before_others),
      clock_(rpm_of(config.set, config.radar_controls), config.geometry.spokes_per_turn),
      renderer_(config.set, config.geometry, clock_, config.radar, config.controls.range_scale,
                config.radar_controls,
                [this](std::size_t count, const std::function<void(std::size_t)>& body) {
                  workers_.run(count, body);
                }),
      scenes_(
          {config.own_ship, config.radar, config.set.band(), config.seed, config.obstructions}) {}

void SectorMaker::turn(std::uint64_t first, const echo::RadarControls& controls) {
  const echo::SpokeClock before = clock_;
  clock_.change_rate(first, rpm_of(config_.set, controls));
  if (clock_ == before) return;
  const std::uint32_t turn = config_.geometry.spokes_per_turn;
  bow_passed_ = clock_.time_of(first - first % turn);
}

Emission SectorMaker::emission(const echo::RadarControls& controls, RangeScale range) const {
  Emission emission;
  emission.own_ship = config_.own_ship;
  emission.transmits = controls.transmit;
  echo::EmitterState state;
  state.identity = identity_of(config_.seed, Fixture::emitter, config_.radar);
  // When the beam stood over the bow, at the rate it turns with.
  state.antenna_start = bow_passed_;
  echo::RadarSet set = config_.set;
  set.rpm = rpm_of(set, controls);
  if (controls.antenna_height_m > 0.0) set.antenna_height_m = controls.antenna_height_m;
  emission.emitter =
      echo::emitter_of(set, set.pulse_for(range, controls.pulse), state, kTransmitterSpread);
  return emission;
}

CoastWish SectorMaker::wish(const ShipState& own_ship, const std::vector<ViewInForce>& views,
                            std::uint64_t tag) const {
  const RangeScale range = views.front().controls.range_scale;
  const ScanGeometry& geometry = config_.geometry;
  std::uint32_t cells = geometry.cells;
  for (const ViewInForce& view : views) {
    cells = std::max(cells, echo::row_cells_for(geometry, range, shown_by(view, range)));
  }
  cells = echo::row_cells_for_error(geometry, range, cells, radar_faults(own_ship).range_error_m);
  const Length reach = range.length() * (double{1} * cells / geometry.cells);
  return {own_ship.position,
          own_ship.pace * own_ship.speed_mps,
          {std::min(reach.in_metres(), kFarthestCoast.in_metres()),
           geometry.cell_size(range).in_metres(), 360.0 / geometry.spokes_per_turn},
          tag};
}

void SectorMaker::take_views(const SectorInputs& inputs) {
  const auto is_there = [&](std::uint32_t number) {
    return std::any_of(inputs.views.begin(), inputs.views.end(),
                       [&](const ViewInForce& view) { return view.number == number; });
  };
  renderer_.keep_views(is_there);
  std::erase_if(sequences_, [&](const auto& entry) { return !is_there(entry.first); });
  for (const ViewInForce& view : inputs.views) {
    renderer_.set_view(view.number, shown_by(view, inputs.on_air));
  }
}

// Tables of weather, set and range scale take tens of milliseconds: once on the air, that would be
// sectors late.
void SectorMaker::warm_up(const SectorInputs& inputs) {
  renderer_.set_radar(inputs.on_air, inputs.radar, clock_);
  renderer_.set_faults(faults_of(inputs));
  take_views(inputs);
  // The radar's own builder stays fresh: not all radars are on the air yet.
  SceneBuilder scenes = scenes_;
  scenes.set_rig(inputs.radar.blanked, inputs.radar.bearing_alignment_deg);
  renderer_.render(*scenes.build(inputs.state, inputs.coast, inputs.emissions), 0, kSectorSpokes);
}

// A radar like this one makes a sector in the present scene.
std::function<std::shared_ptr<const void>()> SectorMaker::ahead(const SectorInputs& inputs) const {
  return [config = config_, clock = clock_, scenes = scenes_, faults = faults_of(inputs),
          inputs]() mutable {
    auto renderer =
        std::make_shared<ViewRenderers>(config.set, config.geometry, clock, config.radar,
                                        inputs.on_air, inputs.radar, echo::serial_for);
    renderer->set_faults(faults);
    for (const ViewInForce& view : inputs.views)
      renderer->set_view(view.number, shown_by(view, inputs.on_air));
    scenes.set_rig(inputs.radar.blanked, inputs.radar.bearing_alignment_deg);
    renderer->render(*scenes.build(inputs.state, inputs.coast, inputs.emissions), 0, kSectorSpokes);
    return renderer;
  };
}

void SectorMaker::make(std::uint64_t first, const SectorInputs& inputs,
                       std::vector<ViewSector>& out) {
  out.clear();
  if (!inputs.radar.transmit) return;
  renderer_.set_radar(inputs.on_air, inputs.radar, clock_);
  renderer_.set_faults(faults_of(inputs));
  take_views(inputs);
  if (std::exchange(numbered_from_, inputs.numbered_from) != inputs.numbered_from) {
    sequences_[0] = inputs.numbered_from;
  }
  scenes_.set_rig(inputs.radar.blanked, inputs.radar.bearing_alignment_deg);
  renderer_.render(*scenes_.build(inputs.state, inputs.coast, inputs.emissions), first,
                   kSectorSpokes);
  cut_spokes(first, inputs, out);
}

echo::RadarFaults SectorMaker::faults_of(const SectorInputs& inputs) const {
  return radar_faults(inputs.state->own_ships[config_.own_ship]);
}

void SectorMaker::cut_spokes(std::uint64_t first, const SectorInputs& inputs,
                             std::vector<ViewSector>& out) {
  const std::uint32_t cells = config_.geometry.cells;
  const WorldState& state = *inputs.state;
  const ShipState& own = state.own_ships[config_.own_ship];
  for (const ViewInForce& view : inputs.views) {
    out.push_back({view.number, {}});
    out.back().sector.spokes.reserve(kSectorSpokes);
  }
  const auto place_at = [&](std::uint64_t spoke) {
    return position_at(own, clock_.time_of(spoke) - state.time).position;
  };
  // One reading for all spokes of a sector, some 10 ms.
  const SensorReading reading = reading_at(state, own, clock_.time_of(first) - state.time);
  const GeoPoint from = stamped_position(own, reading, place_at(first));
  const GeoPoint to = stamped_position(own, reading, place_at(first + kSectorSpokes));
  for (std::uint32_t k = 0; k < kSectorSpokes; ++k) {
    const std::uint64_t n = first + k;
    SpokeHeader header;
    header.radar = config_.radar;
    header.scan = static_cast<std::uint32_t>(n / config_.geometry.spokes_per_turn);
    header.index = static_cast<std::uint32_t>(n % config_.geometry.spokes_per_turn);
    header.geometry = config_.geometry;
    header.scenario_time = clock_.time_of(n);
    header.utc = inputs.utc.at(header.scenario_time);
    const Duration dt = header.scenario_time - state.time;
    const double turned_deg = own.pace * own.rate_of_turn_deg_s * in_seconds(dt);
    header.heading =
        TrueBearing::from(degrees(stamped_heading(own, reading, own.heading_deg + turned_deg)));
    const bool empty = loses_spoke(own, config_.seed, config_.radar, n);
    header.own_ship = between(from, to, double{1} * k / kSectorSpokes);
    for (ViewSector& part : out) {
      header.view = part.view;
      header.sequence = sequences_[part.view]++;
      header.range_scale = renderer_.range_of(header.view);
      header.instrumented_range = renderer_.instrumented_range_of(header.view);
      const auto video = renderer_.video(header.view).subspan(std::size_t{k} * cells, cells);
      auto spoke = std::make_shared<Spoke>(Spoke{header, {video.begin(), video.end()}});
      if (empty) std::fill(spoke->cells.begin(), spoke->cells.end(), std::uint8_t{0});
      if (const auto doppler = renderer_.doppler(header.view); !doppler.empty()) {
        const auto own_cells = doppler.subspan(std::size_t{k} * cells, cells);
        spoke->doppler.assign(own_cells.begin(), own_cells.end());
        if (empty) std::fill(spoke->doppler.begin(), spoke->doppler.end(), DopplerClass{});
      }
      part.sector.spokes.push_back(std::move(spoke));
    }
  }
}

}  // namespace skerry::server
