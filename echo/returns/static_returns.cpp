#include "echo/returns/static_returns.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "echo/radar/radar_equation.hpp"
#include "echo/returns/moved_rows.hpp"
#include "echo/returns/shore_stretch.hpp"
#include "echo/returns/static_frame.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

// Shares of a frame's making that are its crossings, and the rays before its first row.
constexpr double kCrossingsShare = 0.15, kLeadInShare = 0.03;
// Rows are made so many at a time, radars at different times: each needs the rays of a beam to
// either side, which lie in no near cache where radars take turns.
constexpr std::uint32_t kBatch = 16;
// How far off its bearing a spoke may look as the antenna sways: a little, and with roll and pitch
// of phi and psi at most (phi + psi)^2, four times what either alone would make it.
double sway_radians(const AntennaMotion& motion) {
  constexpr double kLeast = 0.03;
  const double tilt = (motion.roll_deg + motion.pitch_deg) * kRadiansPerDegree;
  return std::min(3.0, kLeast + tilt * tilt);
}
constexpr double kLevelStep = 0.05;  // metres of water that make a frame old

constexpr auto kServeUnits = static_cast<std::uint32_t>(kPartsServe * kUnitsPerRadian);

// The number of spokes that may share their parts, a power of two.
std::uint32_t spokes_together(std::uint32_t spokes_per_turn) {
  std::uint32_t n = 1;
  while (n < 16 && 0x80000000u / spokes_per_turn * 2 * n <= kServeUnits) n *= 2;
  return n;
}

bool same_plane(const LocalPlane& a, const LocalPlane& b) {
  return a.anchor().latitude_deg == b.anchor().latitude_deg &&
         a.anchor().longitude_deg == b.anchor().longitude_deg;
}

// How long the edge of sand is left where a wave had it.
double wave_seconds(double wave_height_m, double cell_m) {
  const double way_cells = 2.0 * swash_m(wave_height_m) / cell_m;
  if (way_cells < StaticReturns::kLeastSwash) return std::numeric_limits<double>::infinity();
  return StaticReturns::kWaveSeconds * std::max(1.0, StaticReturns::kFullSwash / way_cells);
}

}  // namespace

class StaticReturns::Frames {
 public:
  Frames(const RadarModel& model, ParallelFor parallel)
      : model_(model),
        parallel_(std::move(parallel)),
        detail_(frame_detail(model)),
        together_(spokes_together(model.geometry.spokes_per_turn)),
        now_(std::make_unique<StaticFrame>(model, detail_)),
        next_(std::make_unique<StaticFrame>(model, detail_)) {}

  void prepare(const Scene& scene, std::uint64_t first, std::uint32_t count) {
    if (!scene.coast ||
        (scene.coast->vertices.empty() && !scene.structure_index && !scene.ashore)) {
      in_use_ = building_ = false;
      return;
    }
    const SpokeAim aim = aim_of(scene, model_.clock, first + count / 2);
    if (in_use_) place_now(scene);
    if (in_use_ && (scene.seed != seed_ || length_of(aim.own_ship - at_) > farthest_))
      in_use_ = false;
    if (!in_use_) start(scene, aim);
    build(scene, aim, count);
    own_ship_ = aim.own_ship;
    lay_groups(scene, first, count);
    if (!now_->complete()) make_needed(scene, first, count);
  }

  bool empty() const { return !in_use_ || now_->empty(); }

  // Finds the echoes of a spoke, and the cells that show no sea.
  void find(const SpokeAim& aim, std::vector<MovedRun>& runs, std::vector<CellRun>& dry) const {
    for_each(aim, [&](const RowPart& part) {
      now_->find(part, runs);
      add_dry(part, dry);
    });
  }

  float hidden_height(std::uint32_t plane_units, double range_m) const {
    // The place as the frame saw it: by so much farther, and so much to the right.
    const SinCos u = sin_cos_units(plane_units);
    const PlanePoint way = own_ship_ - at_;
    const double along = range_m + way.east_m * u.sin + way.north_m * u.cos;
    const double across = right_of(u, way);
    const double range = std::sqrt(along * along + across * across);
    // Off by 2e-6 rad at most where the tangent is small, as it nearly always is.
    const double t = across / along;
    const double right = along > 0.0 && std::fabs(t) < 0.1 ? t - t * t * t * (1.0 / 3.0)
                                                           : exact_atan2(across, along);
    const double row_units = kUnitsPerTurn / detail_.rows;
    const double row =
        (static_cast<double>(plane_units - turn_units_) + right * kUnitsPerRadian) / row_units;
    const auto index =
        static_cast<std::uint32_t>(static_cast<std::int64_t>(std::floor(row + 0.5))) &
        (detail_.rows - 1);
    if (!now_->made(index)) return 0.0f;
    const double slope =
        now_->shadow_slope(index, static_cast<std::uint32_t>(range / model_.cell_m));
    if (slope <= HiddenGround::kNothingHidden) return 0.0f;
    const double height =
        model_.set.antenna_height_m + slope * range + range * range / (2.0 * kEffectiveEarth);
    return static_cast<float>(std::max(0.0, height));
  }

  std::uint32_t spokes_to_a_row() const {
    return detail_.rows <= model_.geometry.spokes_per_turn ? 2 : 1;
  }

  Effort effort() const {
    return {rows_made_, frames_used_, in_use_ ? length_of(own_ship_ - at_) : 0.0};
  }
  std::size_t bytes() const { return now_->bytes() + next_->bytes(); }

 private:
  MovedView view_from(PlanePoint own_ship) const {
    return {own_ship - at_, detail_.rows, model_.cell_m};
  }

  template <typename Visit>
  void lay(const SpokeAim& aim, Visit&& visit) const {
    const MovedView view = view_from(aim.own_ship);
    const double nearest = now_->nearest_m() - now_->lead_m() - length_of(view.moved);
    if (nearest >= model_.cell_m * model_.geometry.cells) return;
    lay_parts(view, aim.plane_units - turn_units_, nearest, model_.geometry.cells, visit);
  }

  // Places the parts of each group of spokes once.
  void lay_groups(const Scene& scene, std::uint64_t first, std::uint32_t count) {
    first_group_ = first / together_;
    const auto half_spoke =
        static_cast<std::uint32_t>(0x80000000u / model_.geometry.spokes_per_turn);
    group_starts_.clear();
    group_bearings_.clear();
    parts_.clear();
    for (std::uint64_t g = first_group_; g <= (first + count - 1) / together_; ++g) {
      const SpokeAim aim = aim_of(scene, model_.clock, g * together_ + together_ / 2);
      group_starts_.push_back(parts_.size());
      group_bearings_.push_back(aim.plane_units);
      // A turn's rows are larger than the near caches, and these are wanted in a while.
      const std::uint32_t middle = aim.plane_units - turn_units_ - half_spoke;
      lay(aim, [&](const PlacedPart& part) {
        parts_.push_back(part);
        now_->fetch(part.at(middle, detail_.rows).row);
      });
    }
    group_starts_.push_back(parts_.size());
  }

  // An antenna that sways may look where no group's parts serve.
  template <typename Visit>
  void for_each(const SpokeAim& aim, Visit&& visit) const {
    const std::uint32_t bearing = aim.plane_units - turn_units_;
    const auto place = [&](const PlacedPart& part) { visit(part.at(bearing, detail_.rows)); };
    const std::uint64_t group = aim.spoke / together_ - first_group_;
    if (group < group_bearings_.size()) {
      const std::uint32_t off = aim.plane_units - group_bearings_[group];
      if (off + kServeUnits <= 2 * kServeUnits) {
        for (std::size_t i = group_starts_[group]; i < group_starts_[group + 1]; ++i)
          place(parts_[i]);
        return;
      }
    }
    lay(aim, place);
  }

  void add_dry(const RowPart& part, std::vector<CellRun>& runs) const {
    const std::span<const CellRun> kept = now_->dry(part.row);
    if (kept.empty()) return;
    const std::int32_t shift = whole_cells(part.shift + 0.5);
    // The part in the row's own cells.
    const std::int32_t from = static_cast<std::int32_t>(part.first) + shift;
    const std::int32_t to = static_cast<std::int32_t>(part.last) + shift;
    std::size_t r = 0;
    while (r < kept.size() && kept[r].last <= from) ++r;
    for (; r < kept.size() && kept[r].first < to; ++r) {
      const std::int32_t begin = std::max<std::int32_t>(kept[r].first, from) - shift;
      const std::int32_t end = std::min<std::int32_t>(kept[r].last, to) - shift;
      const CellRun moved{static_cast<std::uint16_t>(begin), static_cast<std::uint16_t>(end)};
      if (!runs.empty() && runs.back().last >= moved.first) {
        runs.back().last = std::max(runs.back().last, moved.last);
      } else {
        runs.push_back(moved);
      }
    }
  }

  // Computes the place of the frame in use in the scene's plane.
  void place_now(const Scene& scene) {
    if (scene.coast == placed_in_) return;
    placed_in_ = scene.coast;
    const StaticView& view = now_->view();
    if (same_plane(scene.coast->plane, now_->picture()->plane)) {
      at_ = view.at;
      turn_units_ = 0;
      return;
    }
    const std::uint32_t north =
        TrueBearing::from(degrees(scene.coast->plane.true_north_degrees(view.geo))).units();
    turn_units_ = north - view.north_units;
    const SinCos turn = sin_cos_units(turn_units_);
    at_ = scene.coast->plane.to_plane(view.geo) + turned(view.sailed, turn);
  }

  void take_into_use(const Scene& scene) {
    in_use_ = true;
    ++frames_used_;
    placed_in_ = nullptr;
    place_now(scene);
  }

  double seconds_of(const Scene& scene, const SpokeAim& aim) const {
    return in_seconds(scene.time.time_since_epoch()) + aim.dt;
  }
  double turn_seconds() const {
    return model_.clock.seconds_per_spoke() * model_.geometry.spokes_per_turn;
  }
  double farthest_way() const { return 4.0 * kFrameCells * model_.cell_m + 50.0; }

  void start(const Scene& scene, const SpokeAim& aim) {
    seed_ = scene.seed;
    building_ = false;
    now_->begin(scene, aim.own_ship, seconds_of(scene, aim));
    now_->work_crossings(1.0);
    farthest_ = farthest_way();
    take_into_use(scene);
  }

  // How many frames a second the scene asks for.
  double rate(const Scene& scene, double way_m) const {
    const double turn = turn_seconds();
    double rate = std::min(length_of(scene.own_velocity) / way_m, 1.0 / turn);
    const StaticView& view = now_->view();
    const double renew = 1.0 / (kRenewTurns * turn);
    if (scene.coast != now_->picture()) rate = std::max(rate, 1.0 / (kPictureTurns * turn));
    const Structures* built =
        scene.structure_index ? &scene.structure_index->structures() : nullptr;
    const bool rebuilt = scene.coast == now_->picture()
                             ? built != now_->structures()
                             : (built == nullptr) != (now_->structures() == nullptr);
    if (rebuilt || std::fabs(scene.water_level_m - view.water.level_m) > kLevelStep ||
        scene.wave_height_m != view.water.wave_height_m)
      rate = std::max(rate, renew);
    if (scene.wave_height_m > 0.0 && now_->sandy()) {
      const double seconds = wave_seconds(scene.wave_height_m, model_.cell_m);
      rate = std::max(rate, 1.0 / std::max(seconds, turn));
    }
    return rate;
  }

  // The way one frame is in use for, metres.
  double way_of(const Scene& scene, double nearest_m) const {
    const double cell = model_.cell_m;
    const double way =
        std::clamp(kFrameShare * nearest_m, kLeastFrameCells * cell, kFrameCells * cell);
    return std::max(way, length_of(scene.own_velocity) * turn_seconds());
  }

  void begin_next(const Scene& scene, const SpokeAim& aim) {
    const double nearest = std::max(0.0, now_->nearest_m() - length_of(aim.own_ship - at_));
    way_m_ = way_of(scene, nearest);
    const double asked = rate(scene, way_m_);
    if (asked <= 0.0) return;
    // From where she will be half-way through its use; never past land.
    const double speed = length_of(scene.own_velocity);
    const double ahead = std::min(1.5 * speed / asked, std::min(1.5 * way_m_, 0.5 * nearest));
    const PlanePoint at =
        speed > 0.0 ? aim.own_ship + scene.own_velocity * (ahead / speed) : aim.own_ship;
    next_->begin(scene, at, seconds_of(scene, aim));
    building_ = true;
    share_ = 0.0;
    next_row_ = 0;
  }

  void build(const Scene& scene, const SpokeAim& aim, std::uint32_t count) {
    if (!building_) begin_next(scene, aim);
    if (!building_) return;
    share_ += rate(scene, way_m_) * count * model_.clock.seconds_per_spoke();
    next_->work_crossings(share_ / kCrossingsShare);
    if (!next_->crossings_done()) return;
    if (next_row_ == 0) {
      const double lead = std::clamp((share_ - kCrossingsShare) / kLeadInShare, 0.0, 1.0);
      next_->make_lead_in(0, static_cast<std::uint32_t>(lead * next_->lead_in()));
    }
    const double before = kCrossingsShare + kLeadInShare;
    const double done = std::clamp((share_ - before) / (1.0 - before), 0.0, 1.0);
    auto rows = static_cast<std::uint32_t>(done * detail_.rows);
    if (rows < detail_.rows) rows -= std::min(rows, (rows + 5 * model_.radar) % kBatch);
    while (next_row_ < rows) {
      const std::uint32_t step = std::min(rows - next_row_, StaticFrame::kMostRows);
      next_->make_rows(next_row_, step, parallel_);
      next_row_ += step;
      rows_made_ += step;
    }
    if (next_row_ < detail_.rows) return;
    building_ = false;
    const PlanePoint there = next_->view().at;
    const bool same = same_plane(scene.coast->plane, next_->picture()->plane);
    const double away = length_of(aim.own_ship - there);
    // She has turned away: the frame is of no use.
    if (!same || away > std::max(length_of(aim.own_ship - at_), way_m_)) return;
    std::swap(now_, next_);
    take_into_use(scene);
  }

  // Rows of the frame in use that the sector needs and are not made, and sway_radians() to either
  // side, for an antenna that rolls and pitches (antenna_motion.hpp).
  void make_needed(const Scene& scene, std::uint64_t first, std::uint32_t count) {
    needed_.clear();
    const auto sway =
        static_cast<std::uint32_t>(sway_radians(scene.motion) / 6.283185307 * detail_.rows) + 1;
    const auto need = [&](const RowPart& part) {
      for (std::uint32_t row = part.row - sway; row != part.row + sway + 1; ++row) {
        if (!now_->made(row & (detail_.rows - 1))) needed_.push_back(row & (detail_.rows - 1));
      }
    };
    for (std::uint32_t k = 0; k < count; ++k)
      for_each(aim_of(scene, model_.clock, first + k), need);
    std::sort(needed_.begin(), needed_.end());
    needed_.erase(std::unique(needed_.begin(), needed_.end()), needed_.end());
    for (std::size_t i = 0; i < needed_.size();) {
      std::size_t end = i + 1;
      while (end < needed_.size() && needed_[end] - needed_[i] < StaticFrame::kMostRows) ++end;
      const std::uint32_t rows = needed_[end - 1] - needed_[i] + 1;
      now_->make_rows(needed_[i], rows, parallel_);
      rows_made_ += rows;
      i = end;
    }
  }

  RadarModel model_;
  ParallelFor parallel_;
  FrameDetail detail_;
  std::uint32_t together_;  // spokes of a group
  std::unique_ptr<StaticFrame> now_, next_;
  bool in_use_ = false, building_ = false;
  std::uint64_t seed_ = 0;
  PlanePoint at_;                 // of now_, in the scene's plane
  std::uint32_t turn_units_ = 0;  // of the scene's plane against now_'s
  CoastPicturePtr placed_in_;     // the picture at_ is for
  PlanePoint own_ship_;           // in the middle of the sector
  double farthest_ = 0.0;
  double way_m_ = 0.0, share_ = 0.0;  // of next_
  std::uint32_t next_row_ = 0;
  std::uint64_t rows_made_ = 0, frames_used_ = 0;
  std::vector<std::uint32_t> needed_;

  // Parts of the sector's spokes, together_ of them sharing theirs.
  std::uint64_t first_group_ = 0;
  std::vector<std::uint32_t> group_bearings_;
  std::vector<std::size_t> group_starts_;
  std::vector<PlacedPart> parts_;
};

StaticReturns::StaticReturns(const RadarModel& model, ParallelFor parallel)
    : frames_(std::make_unique<Frames>(model, std::move(parallel))) {}
StaticReturns::~StaticReturns() = default;
StaticReturns::StaticReturns(StaticReturns&&) noexcept = default;
StaticReturns& StaticReturns::operator=(StaticReturns&&) noexcept = default;

void StaticReturns::prepare(const Scene& scene, std::uint64_t first, std::uint32_t count) {
  frames_->prepare(scene, first, count);
}
bool StaticReturns::empty() const { return frames_->empty(); }
std::uint32_t StaticReturns::spokes_to_a_row() const { return frames_->spokes_to_a_row(); }
void StaticReturns::find(const SpokeAim& aim, std::vector<MovedRun>& runs,
                         std::vector<CellRun>& dry) const {
  runs.clear();
  dry.clear();
  if (!frames_->empty()) frames_->find(aim, runs, dry);
}
bool StaticReturns::add(const SpokeAim& aim, std::span<float> power,
                        std::vector<CellRun>& dry) const {
  thread_local std::vector<MovedRun> runs;
  find(aim, runs, dry);
  add_moved(runs, power);
  return !runs.empty();
}
float StaticReturns::hidden_height(std::uint32_t plane_units, double range_m) const {
  return frames_->empty() ? 0.0f : frames_->hidden_height(plane_units, range_m);
}
StaticReturns::Effort StaticReturns::effort() const { return frames_->effort(); }
std::size_t StaticReturns::bytes() const { return frames_->bytes(); }

}  // namespace skerry::echo
