#include "server/radar/turn_echoes.hpp"

#include <algorithm>
#include <utility>

#include "echo/radar/radar_model.hpp"
#include "echo/receiver/controls.hpp"
#include "server/radar/set_faults.hpp"

namespace skerry::server {
namespace {

// Between neighbouring rows the echo is taken as linear: a beam has ten of them or more.
constexpr double kNarrowBeam = 0.7;  // degrees
std::uint32_t rows_for(const echo::RadarSet& set) {
  return set.beam_width_deg < kNarrowBeam ? 8192 : 4096;
}

RangeScale scale_for(double reach_m) {
  std::size_t index = 0;
  while (index + 1 < RangeScale::kCount &&
         RangeScale::from_index(index)->length().in_metres() < reach_m) {
    ++index;
  }
  return *RangeScale::from_index(index);
}

SceneRole role_of(const RadarConfig& config) {
  return {config.own_ship, config.radar, config.set.band(), config.seed, config.obstructions};
}

}  // namespace

TurnEchoes::TurnEchoes(const RadarUnit& radar, Timeline& timeline, CoastService& coast,
                       const Airwaves& airwaves)
    : radar_(radar),
      timeline_(timeline),
      coast_(coast),
      keeper_(coast, coast.add_slot()),
      airwaves_(airwaves),
      scenes_(role_of(radar.config())),
      empty_(kCells) {
  wish_.rpm = radar.config().set.rpm;
  lay_grid();
}

void TurnEchoes::set(const Wish& wish) {
  if (wish == wish_) return;
  wish_ = wish;
  lay_grid();
}

echo::Pulse TurnEchoes::pulse() const {
  const std::vector<echo::Pulse>& pulses = radar_.config().set.pulses;
  const bool own = wish_.pulse_code >= 1 && wish_.pulse_code <= pulses.size();
  return own ? pulses[wish_.pulse_code - 1] : radar_.pulse_on_air();
}

void TurnEchoes::lay_grid() {
  const RadarConfig& config = radar_.config();
  scale_ = scale_for(wish_.reach_m);
  grid_.rows_per_turn = rows_for(config.set);
  grid_.cells = kCells;
  Wish within = wish_;
  within.reach_m = std::min(wish_.reach_m, scale_.length().in_metres());
  grid_.cell_m = echo::sweep_cell_m(within, kCells);
  grid_.pulse = pulse();
  grid_.video_range_db = config.set.video_range_db;
  grid_.seed = config.seed;
  grid_.radar = config.radar;
  clock_ = echo::SpokeClock(wish_.rpm, grid_.rows_per_turn);
  returns_.reset();
  for (Block& block : blocks_) block.number.reset();

  // Made as radar_model() makes it, for the pulse in use.
  echo::RadarSet set = config.set;
  set.pulses = {grid_.pulse};
  const echo::RadarModel model = echo::with_cells_of(
      echo::radar_model(set, {grid_.rows_per_turn, kCells, 8}, scale_, clock_, config.radar),
      grid_.cell_m);
  grid_.blind_m = model.blind_cells * model.cell_m;
}

std::span<const float> TurnEchoes::row(std::uint64_t n, ScenarioTime when) {
  if (!radiates()) return empty_;
  const std::uint64_t number = n / kBlockRows;
  const Duration behind = clock_.time_of(n) - when;
  const auto serves = [&](const Block& block) {
    const Duration off = block.behind - behind;
    return block.number == number && off <= kStale && off >= -kStale;
  };
  if (!serves(blocks_[used_last_])) {
    used_last_ = 1 - used_last_;
    if (!serves(blocks_[used_last_])) make(blocks_[used_last_], n, when);
  }
  return std::span(blocks_[used_last_].rows).subspan((n % kBlockRows) * kCells, kCells);
}

void TurnEchoes::make(Block& block, std::uint64_t n, ScenarioTime when) {
  if (!(pulse() == grid_.pulse)) lay_grid();
  if (returns_ && returns_->model().set.antenna_height_m != radar_.set_on_air().antenna_height_m)
    returns_.reset();
  if (!returns_) {
    echo::RadarSet set = radar_.set_on_air();
    set.rpm = wish_.rpm;
    set.pulses = {grid_.pulse};
    returns_.emplace(echo::with_cells_of(echo::radar_model(set, {grid_.rows_per_turn, kCells, 8},
                                                           scale_, clock_, radar_.config().radar),
                                         grid_.cell_m),
                     echo::serial_for);
  }
  returns_->set_tune_loss(echo::tune_loss_db(radar_.radar_controls()));
  block.number = n / kBlockRows;
  block.behind = clock_.time_of(n) - when;
  echo::ScenePtr scene = scene_at(when);
  returns_->set_faults(faults_);
  if (block.behind > kSameTime || block.behind < -kSameTime) {
    auto told = std::make_shared<echo::Scene>(*scene);
    told->time += block.behind;
    scene = std::move(told);
  }
  const echo::PowerRows made = returns_->make(*scene, *block.number * kBlockRows, kBlockRows);
  block.rows.resize(std::size_t{kBlockRows} * kCells);
  for (std::size_t k = 0; k < kBlockRows; ++k) {
    const auto row = made.cells.subspan(k * made.pitch, kCells);
    std::copy(row.begin(), row.end(), block.rows.begin() + static_cast<std::ptrdiff_t>(k * kCells));
  }
}

echo::ScenePtr TurnEchoes::scene_at(ScenarioTime when) {
  // A board counts azimuths itself: the picture's alignment is none of its affair.
  scenes_.set_rig(radar_.radar_controls().blanked, 0.0);
  const WorldStatePtr state = timeline_.at(when);
  const ShipState& own_ship = state->own_ships[radar_.config().own_ship];
  faults_ = radar_faults(own_ship);
  keeper_.look_after({own_ship.position,
                      own_ship.pace * own_ship.speed_mps,
                      {scale_.length().in_metres(), grid_.cell_m, 360.0 / grid_.rows_per_turn}},
                     state->time);
  const CoastInSightPtr own = keeper_.latest();
  return scenes_.build(state, own ? own : coast_.latest(radar_.config().radar), airwaves_.get());
}

}  // namespace skerry::server
