#include "echo/spoke_returns.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "echo/artefacts/antenna_motion.hpp"
#include "echo/artefacts/false_echoes.hpp"
#include "echo/artefacts/minimum_range.hpp"
#include "echo/artefacts/saturation.hpp"
#include "echo/artefacts/shadow_sectors.hpp"
#include "echo/beacons/beacon_returns.hpp"
#include "echo/beacons/far_echoes.hpp"
#include "echo/clutter/sea_returns.hpp"
#include "echo/kernel/aligned_floats.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/power_stages.hpp"
#include "echo/kernel/shelf.hpp"
#include "echo/propagation/propagation.hpp"
#include "echo/returns/static_returns.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/spoke_land.hpp"
#include "echo/spoke_rain.hpp"
#include "echo/targets/echo_splat.hpp"
#include "echo/targets/radial_speeds.hpp"
#include "echo/targets/target_returns.hpp"

namespace skerry::echo {
// What is needed while a sector is made and seen, and by no other radar then.
struct SpokeReturns::Sector {
  struct Look {
    SpokeAim aim;  // as the antenna, swayed with the ship, sees it
    Motion motion;
  };

  AlignedFloats rows, closing_rows;
  std::vector<Look> looks;
  std::vector<LandShare> land;      // the first `shares` of them
  std::vector<std::uint8_t> wet;    // for SeaReturns::prepare
  std::vector<SpokeAim> rain_aims;  // for SpokeRain::prepare
  std::vector<PointEcho> points, false_points;

  static Shelf<Sector>& shelf() {
    static Shelf<Sector> all;
    return all;
  }
};

struct SpokeReturns::Contributors : SpokeReturns::Sector {
  Contributors(const RadarModel& radar, ParallelFor in_parallel)
      : model(radar),
        parallel(std::move(in_parallel)),
        statics(radar, parallel),
        sea(radar),
        rain(radar),
        targets(radar),
        splat(radar),
        far_echoes(radar),
        false_echoes(radar),
        false_splat(radar),
        beacons(radar),
        rig(radar),
        motion(radar),
        minimum_range(radar),
        saturation(radar),
        spoke_land(radar),
        pitch((radar.geometry.cells + 15u) / 16u * 16u + 16u) {}

  ~Contributors() {
    if (has_sector) Sector::shelf().put_back(std::move(sector()));
  }
  Contributors(const Contributors&) = delete;
  Contributors& operator=(const Contributors&) = delete;

  Sector& sector() { return *this; }
  void take_sector();
  std::uint32_t keep_from(std::uint64_t first, std::uint32_t count);
  void make_rows(const Scene& scene, std::uint64_t first, std::uint32_t count, std::uint32_t into);
  void look_at_weather(const Scene& scene);
  void prepare(const Scene& scene, std::uint64_t first, std::uint32_t count);
  void share_land(std::uint32_t count);
  void look_for_water();
  void look_for_rain(const Scene& scene, std::uint32_t count);
  void add_sea(const SpokeAim& aim, std::span<const CellRun> no_water, std::span<float> row) const;
  void add_beacons(const SpokeAim& aim, std::span<float> row) const;
  // What comes to the land.  `closing`: empty where speeds are not wanted.
  void make_row(const Scene& scene, const Look& look, std::span<const CellRun> no_water,
                std::span<float> row, std::span<float> closing) const;

  RadarModel model;
  ParallelFor parallel;
  float tune_factor = 1.0f;
  FaultyReceiver faulty;
  float echo_factor = 1.0f, racon_factor = 1.0f;  // of tune and faults
  void lay_factors();

  // Made of the last weather.
  std::optional<Propagation> propagation;
  Atmosphere atmosphere;
  double wave_height_m = -1.0;

  StaticReturns statics;
  SeaReturns sea;
  SpokeRain rain;
  TargetReturns targets;
  EchoSplat splat;
  FarEchoes far_echoes;
  FalseEchoes false_echoes;
  EchoSplat false_splat;
  BeaconReturns beacons;
  OwnShipGain rig;
  AntennaMotionModel motion;
  MinimumRange minimum_range;
  Saturation saturation;
  SpokeLand spoke_land;

  std::optional<RadialSpeeds> speeds;  // nothing: nobody wants them

  std::size_t pitch;
  std::size_t shares = 0;                      // of `land`, that are in use
  std::uint64_t made_first = 0, made_end = 0;  // spokes of `rows`
  // Between sectors those rows may lie here instead, and the sector's memory on the shelf.
  bool has_sector = false;
  AlignedFloats kept_rows, kept_closing;
};

void SpokeReturns::Contributors::take_sector() {
  sector() = Sector::shelf().take();
  has_sector = true;
  if (looks.size() < kMaxSector) looks.resize(kMaxSector);
  if (land.size() < kMaxSector) land.resize(kMaxSector);
  if (rows.size() < kept_rows.size()) rows.resize(kept_rows.size());
  if (closing_rows.size() < kept_closing.size()) closing_rows.resize(kept_closing.size());
  std::copy(kept_rows.begin(), kept_rows.end(), rows.begin());
  std::copy(kept_closing.begin(), kept_closing.end(), closing_rows.begin());
}

void SpokeReturns::Contributors::look_at_weather(const Scene& scene) {
  if (propagation && scene.atmosphere == atmosphere && scene.wave_height_m == wave_height_m) return;
  atmosphere = scene.atmosphere;
  wave_height_m = scene.wave_height_m;
  propagation.emplace(model.set, atmosphere, wave_height_m,
                      std::max(model.scale.length().in_metres(), FarEchoes::kFarthest));
  targets.set_propagation(&*propagation);
}

void SpokeReturns::Contributors::prepare(const Scene& scene, std::uint64_t first,
                                         std::uint32_t count) {
  look_at_weather(scene);
  rig.prepare(scene);
  for (std::uint32_t k = 0; k < count; ++k) {
    const SpokeAim aim = aim_of(scene, model.clock, first + k);
    const Motion moved = motion.at(scene, aim);
    looks[k] = {moved.moves ? AntennaMotionModel::moved(aim, moved) : aim, moved};
  }
  const SpokeAim& from = looks[0].aim;
  const SpokeAim& to = looks[count - 1].aim;
  statics.prepare(scene, first, count);
  const HiddenHeight hidden = [this](std::uint32_t units, double range_m) {
    return statics.hidden_height(units, range_m);
  };
  points.clear();
  targets.prepare(scene, from, to, hidden, points);
  const StrongEchoes& strong = targets.strong();
  if (speeds) speeds->prepare(scene, points, strong, from, to);
  false_points.clear();
  if (!points.empty() || !strong.points.empty())
    false_echoes.add(scene, from, to, points, strong.points, false_points);
  far_echoes.append(scene, *propagation, from, to, hidden, points);
  if (scene.artefacts.side_lobes) {
    splat.prepare(points, from, to, strong);
  } else {
    splat.prepare(points, from, to);
  }
  false_splat.prepare(false_points, from, to);
  beacons.prepare(scene, *propagation, from, to, hidden);
}

// Joins spokes to those that share their land.  An antenna that sways looks where it will.
void SpokeReturns::Contributors::share_land(std::uint32_t count) {
  const std::uint32_t most = statics.spokes_to_a_row();
  const auto half_spoke = static_cast<std::uint32_t>(0x80000000u / model.geometry.spokes_per_turn);
  shares = 0;
  for (std::uint32_t k = 0; k < count; ++shares) {
    LandShare& share = land[shares];
    share.first = k;
    share.aim = looks[k].aim;
    share.count = 1;
    const bool shared = most > 1 && !looks[k].motion.moves;
    if (shared && share.aim.spoke % 2 == 0 && k + 1 < count && !looks[k + 1].motion.moves)
      share.count = 2;
    if (shared) share.aim.plane_units += share.aim.spoke % 2 == 0 ? half_spoke : 0 - half_spoke;
    k += share.count;
  }
}

// Looks for all spokes together.
void SpokeReturns::Contributors::look_for_water() {
  wet.assign((model.geometry.cells + SeaReturns::kWetCells - 1) / SeaReturns::kWetCells, 0);
  for (const LandShare& share : std::span(land).first(shares)) {
    std::size_t from = 0;
    const auto mark = [&](std::size_t end) {
      if (from >= end) return;
      for (std::size_t b = from / SeaReturns::kWetCells; b * SeaReturns::kWetCells < end; ++b)
        wet[b] = 1;
    };
    for (const CellRun& run : share.dry) {
      mark(run.first);
      from = std::max<std::size_t>(from, run.last);
    }
    mark(model.geometry.cells);
  }
}

void SpokeReturns::Contributors::look_for_rain(const Scene& scene, std::uint32_t count) {
  rain_aims.clear();
  bool sways = false;
  for (const Look& look : std::span(looks).first(count)) {
    rain_aims.push_back(look.aim);
    sways = sways || look.motion.moves;
  }
  rain.prepare(scene, rain_aims, sways, parallel);
}

void SpokeReturns::Contributors::add_sea(const SpokeAim& aim, std::span<const CellRun> no_water,
                                         std::span<float> row) const {
  std::uint32_t from = 0;
  for (const CellRun& run : no_water) {
    sea.add(aim, row, from, run.first);
    from = std::max<std::uint32_t>(from, run.last);
  }
  sea.add(aim, row, from, sea.reach_cells());
}

// Signals of other senders pass the own masts once.
void SpokeReturns::Contributors::add_beacons(const SpokeAim& aim, std::span<float> row) const {
  if (!rig.any()) {
    beacons.add(aim, row, racon_factor);
    return;
  }
  thread_local std::vector<float> heard;
  heard.assign(row.size(), 0.0f);
  beacons.add(aim, heard, racon_factor, rig.transmits(aim.relative_units));
  const float gain = rig.one_way(aim.relative_units);
  for (std::size_t i = 0; i < row.size(); ++i) row[i] += gain * heard[i];
}

void SpokeReturns::Contributors::make_row(const Scene& scene, const Look& look,
                                          std::span<const CellRun> no_water, std::span<float> row,
                                          std::span<float> closing) const {
  const SpokeAim& aim = look.aim;
  if (sea.any()) add_sea(aim, no_water, row);
  if (targets.shadows().any()) targets.shadows().apply(aim, row);
  splat.add(aim, row);
  if (!closing.empty()) speeds->find(aim, row, closing);
  rain.pass(scene.seed, aim, row);
  if (look.motion.moves) motion.apply(look.motion, row);
  if (rig.any()) scale_row(row, rig.two_way(aim.relative_units));
  if (!false_points.empty() && rig.transmits(aim.relative_units)) false_splat.add(aim, row);
  if (echo_factor != 1.0f) scale_row(row, echo_factor);
  if (beacons.any()) add_beacons(aim, row);
  minimum_range.apply(scene.artefacts, row);
  saturation.apply(scene.artefacts, row);
  if (faulty.acts()) faulty.apply(aim.relative_units, row, closing);
}

SpokeReturns::SpokeReturns(const RadarModel& model, ParallelFor parallel)
    : all_(std::make_unique<Contributors>(model, std::move(parallel))) {}
SpokeReturns::~SpokeReturns() = default;
SpokeReturns::SpokeReturns(SpokeReturns&&) noexcept = default;
SpokeReturns& SpokeReturns::operator=(SpokeReturns&&) noexcept = default;

const RadarModel& SpokeReturns::model() const { return all_->model; }

void SpokeReturns::set_tune_loss(double db) {
  const auto factor = static_cast<float>(ratio_from_decibels(-db));
  if (factor != all_->tune_factor) all_->made_end = all_->made_first;
  all_->tune_factor = factor;
  all_->lay_factors();
}

void SpokeReturns::Contributors::lay_factors() {
  racon_factor = tune_factor * faulty.tune_factor();
  echo_factor = racon_factor * faulty.power_factor();
}

void SpokeReturns::set_faults(const RadarFaults& faults) {
  if (faults == all_->faulty.faults()) return;
  all_->made_end = all_->made_first;
  all_->faulty.set(faults, all_->model.cell_m);
  all_->lay_factors();
}

void SpokeReturns::set_doppler(bool wanted) {
  if (wanted == all_->speeds.has_value()) return;
  all_->made_end = all_->made_first;
  all_->speeds.reset();
  if (wanted) all_->speeds.emplace(all_->model);
}

// Moves the rows of spokes from `first` on, which the last call made ahead, to the front; how many.
std::uint32_t SpokeReturns::Contributors::keep_from(std::uint64_t first, std::uint32_t count) {
  const bool ahead = first > made_first || !has_sector;
  if (!has_sector) take_sector();
  std::uint32_t kept = 0;
  if (ahead && first >= made_first && first < made_end && made_end <= first + count) {
    kept = static_cast<std::uint32_t>(made_end - first);
    const auto move = [&](AlignedFloats& store) {
      if (first == made_first) return;
      const float* from = store.data() + (first - made_first) * pitch;
      std::copy(from, from + kept * pitch, store.data());
    };
    move(rows);
    if (speeds) move(closing_rows);
  }
  made_first = first;
  made_end = first + count;
  return kept;
}

PowerRows SpokeReturns::make(const Scene& scene, std::uint64_t first, std::uint32_t count) {
  Contributors& all = *all_;
  const std::uint32_t kept = all.keep_from(first, count);
  if (kept < count) all.make_rows(scene, first + kept, count - kept, kept);
  PowerRows made{first, count, all.pitch, all.rows};
  if (all.speeds) made.closing = all.closing_rows;
  return made;
}

void SpokeReturns::release(std::uint64_t from) {
  Contributors& all = *all_;
  if (!all.has_sector || from <= all.made_first) return;
  const std::uint64_t kept = all.made_end > from ? all.made_end - from : 0;
  // To copy most of them would cost more than it saves.
  if (2 * kept > all.made_end - all.made_first) return;
  const auto keep = [&](const AlignedFloats& store, AlignedFloats& keeper) {
    const float* begin = store.data() + (from - all.made_first) * all.pitch;
    keeper.assign(begin, begin + kept * all.pitch);
  };
  all.kept_rows.clear();
  all.kept_closing.clear();
  if (kept > 0) keep(all.rows, all.kept_rows);
  if (kept > 0 && all.speeds) keep(all.closing_rows, all.kept_closing);
  all.made_first = from;
  all.made_end = from + kept;
  Sector::shelf().put_back(std::move(all.sector()));
  all.has_sector = false;
}

// Into the rows from `into` on.
void SpokeReturns::Contributors::make_rows(const Scene& scene, std::uint64_t first,
                                           std::uint32_t count, std::uint32_t into) {
  const std::size_t size = (into + count) * pitch;
  if (rows.size() < size) rows.resize(size);
  if (speeds && closing_rows.size() < size) closing_rows.resize(size);
  prepare(scene, first, count);
  const auto row = [&](std::size_t k) {
    return std::span(rows).subspan((into + k) * pitch, model.geometry.cells);
  };
  const auto closing = [&](std::size_t k) {
    return speeds ? std::span(closing_rows).subspan((into + k) * pitch, model.geometry.cells)
                  : std::span<float>{};
  };
  // The sea's waves are made only where some spoke sees water.  Then each row is made in one go, in
  // the nearest cache.
  share_land(count);
  parallel(shares, [&](std::size_t s) { statics.find(land[s].aim, land[s].runs, land[s].dry); });
  look_for_water();
  sea.prepare(scene, looks[0].aim, looks[count - 1].aim, wet);
  look_for_rain(scene, count);
  parallel(shares, [&](std::size_t s) {
    const LandShare& share = land[s];
    const std::uint32_t last = share.first + share.count - 1;
    const std::array<std::span<float>, 2> own = {row(share.first), row(last)};
    const std::array<SpokeAim, 2> aims = {looks[share.first].aim, looks[last].aim};
    spoke_land.lay(scene.seed, share.runs, std::span(aims).first(share.count),
                   std::span(own).first(share.count));
    for (std::uint32_t j = 0; j < share.count; ++j) {
      const std::size_t k = share.first + j;
      make_row(scene, looks[k], share.dry, own[j], closing(k));
    }
  });
  sea.release();
  rain.release();
  splat.release();
  false_splat.release();
}

}  // namespace skerry::echo
