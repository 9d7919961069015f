#include "echo/returns/static_frame.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "echo/kernel/azimuth_sum.hpp"
#include "echo/kernel/pulse_stretch.hpp"
#include "echo/radar/beam.hpp"
#include "echo/radar/radar_equation.hpp"
#include "echo/returns/hidden_water.hpp"
#include "echo/scene/plane_geometry.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr double kSlopeStep = 1.0 / 32768.0;
constexpr std::int32_t kLineCells = 64 / sizeof(PackedPower);  // of a cache line
constexpr float kLowestSlope = -1.0f;                          // shadow slopes below count as none

std::uint32_t power_of_two_from(double least, std::uint32_t from, std::uint32_t to) {
  std::uint32_t n = from;
  while (n < to && static_cast<double>(n) < least) n *= 2;
  return n;
}

double nearest_structure(const Structures& structures, PlanePoint at) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : structures.walls)
    nearest = std::min(nearest, distance_to_segment(at, wall.from, wall.to));
  for (const PointObject& point : structures.points)
    nearest = std::min(nearest, length_of(point.place - at));
  return nearest;
}

// By the threads where it is worth their while.
void share_out(std::size_t count, const ParallelFor& parallel,
               const std::function<void(std::size_t)>& body) {
  constexpr std::size_t kWorthSharing = 8;
  if (count < kWorthSharing) {
    serial_for(count, body);
  } else {
    parallel(count, body);
  }
}

// The whole blocks of kPackBlock cells between which all that is not 0 lies.
std::pair<std::uint32_t, std::uint32_t> echoing(std::span<const float> power) {
  const auto blank = [&](std::size_t block) {
    const std::size_t end = std::min(power.size(), (block + 1) * kPackBlock);
    float most = 0.0f;
    for (std::size_t i = block * kPackBlock; i < end; ++i) most = std::max(most, power[i]);
    return most == 0.0f;
  };
  std::size_t first = 0, last = (power.size() + kPackBlock - 1) / kPackBlock;
  while (last > first && blank(last - 1)) --last;
  while (first < last && blank(first)) ++first;
  return {static_cast<std::uint32_t>(first * kPackBlock),
          static_cast<std::uint32_t>(std::min(power.size(), last * kPackBlock))};
}

}  // namespace

FrameDetail frame_detail(const RadarModel& model) {
  const double beams = 360.0 / model.set.beam_width_deg;
  FrameDetail detail;
  detail.rays = power_of_two_from(kRaysPerBeam * beams, 256, 32768);
  detail.rows = std::max(detail.rays, power_of_two_from(kRowsPerBeam * beams, 256, 65536));
  detail.cells = model.geometry.cells + kFrameMargin;
  return detail;
}

StaticFrame::StaticFrame(const RadarModel& model, const FrameDetail& detail)
    : detail_(detail),
      ray_model_{model.cell_m, model.set.antenna_height_m, model.unit_snr, detail.rays},
      pulse_cells_(model.pulse_cells),
      reach_(static_cast<std::uint32_t>(1.25 * model.set.beam_width_deg / 360.0 * detail.rays) + 1),
      ring_size_(power_of_two_from(kMostRows + 2.0 * reach_ + 2.0, 128, detail.rays)),
      // 16 floats aside of a whole page: rays exactly 4 KiB apart would share cache sets.
      pitch_((detail.cells + 15u) / 16u * 16u + 16u) {
  const std::uint32_t per_ray = detail.rows / detail.rays;
  for (std::uint32_t part = 0; part < per_ray; ++part)
    weights_.push_back(beam_weights(model.set.beam_width_deg, detail.rays,
                                    static_cast<double>(part) / per_ray, reach_));
}

void StaticFrame::begin(const Scene& scene, PlanePoint at, double seconds) {
  picture_ = scene.coast;
  structures_ = nullptr;
  const double reach = ray_model_.cell_m * detail_.cells;
  nearest_m_ = std::numeric_limits<double>::infinity();
  built_ = nullptr;
  if (scene.structure_index) {
    built_ = {scene.structure_index, &scene.structure_index->structures()};
    structures_ = std::make_unique<const StructureIndex>(built_, at, 0.0);
    nearest_m_ = nearest_structure(*built_, at);
  }
  view_.coast = picture_.get();
  view_.structures = structures_.get();
  view_.at = at;
  view_.geo = scene.own_ship_geo;
  view_.sailed = at - scene.own_ship;
  view_.north_units = TrueBearing::from(degrees(scene.true_north_deg)).units();
  view_.ashore = scene.ashore;
  view_.water = {scene.water_level_m, scene.wave_height_m, seconds, land_seed(scene.seed)};
  empty_ = picture_->vertices.empty() && !structures_ && !scene.ashore;
  crossings_.begin(*picture_, at, detail_.rays, reach);
  made_ = 0;
  if (rows_.empty()) {
    rows_.resize(detail_.rows);
    dry_.resize(detail_.rays);
    shadows_.resize(std::size_t{detail_.rays} * (detail_.cells / kShadowStep + 1));
    ring_rays_.resize(ring_size_);
    ring_.resize(ring_size_ * pitch_);
  }
  for (Row& row : rows_) {
    row.made = false;
    row.count = 0;
  }
  for (DryRuns& dry : dry_) dry.count = 0;
  store_.clear();
  fresh_.resize(kMostRows);
  for (RingRay& ray : ring_rays_) ray.ray = ~0u;
}

void StaticFrame::work_crossings(double share) {
  if (crossings_.done()) return;
  const auto all = static_cast<double>(picture_->vertices.size());
  crossings_.work_to(
      *picture_, share >= 1.0 ? picture_->vertices.size() : static_cast<std::size_t>(share * all));
  if (!crossings_.done()) return;
  if (view_.ashore) nearest_m_ = 0.0;
  if (crossings_.nearest_m() < ray_model_.cell_m * detail_.cells)
    nearest_m_ = std::min(nearest_m_, crossings_.nearest_m());
}

bool StaticFrame::sandy() const {
  return crossings_.any_of_shore([&](std::size_t shore) {
    return shore < picture_->shores.size() && picture_->shores[shore].type == CoastType::sandy;
  });
}

std::uint32_t StaticFrame::ray_of(std::uint32_t row) const {
  const std::uint32_t per_ray = detail_.rows / detail_.rays;
  return (row + per_ray / 2) / per_ray & (detail_.rays - 1);
}

void StaticFrame::make_ray(std::uint32_t ray) {
  thread_local StaticScratch scratch;
  const auto units = static_cast<std::uint32_t>(0x100000000ull / detail_.rays);
  const std::span<float> power(ring_power(ray), detail_.cells);
  std::fill(power.begin(), power.end(), 0.0f);
  crossings_.of(ray, scratch.crossings);
  RingRay& entry = ring_rays_[ray & (ring_size_ - 1)];
  entry = {ray, 0, 0};
  const bool any = add_static_ray(view_, ray_model_, ray * units, true, scratch, power);
  record_ray(ray, scratch, power);
  if (!any) return;
  const auto [first, end] = echoing(power);
  const std::uint32_t last =
      std::min(detail_.cells, end + static_cast<std::uint32_t>(std::ceil(pulse_cells_)));
  entry.first = first;
  entry.last = last;
  if (first < last)
    stretch_pulse(power.subspan(first, last - first), pulse_cells_, scratch.stretch);
}

void StaticFrame::record_ray(std::uint32_t ray, const StaticScratch& scratch,
                             std::span<const float> power) {
  const std::size_t steps = detail_.cells / kShadowStep + 1;
  std::int16_t* shadows = shadows_.data() + ray * steps;
  DryRuns& kept_dry = dry_[ray];
  kept_dry.count = 0;
  if (scratch.land.empty()) {
    std::fill_n(shadows, steps, std::numeric_limits<std::int16_t>::min());
    return;
  }
  const std::vector<float>& slopes = scratch.ground.shadow;
  for (std::size_t k = 0; k < steps; ++k) {
    const float slope = slopes[std::min(k * kShadowStep, slopes.size() - 1)];
    const float kept = std::clamp(slope, kLowestSlope, 0.9999f);
    shadows[k] = static_cast<std::int16_t>(std::floor(kept * 32768.0f));
  }
  thread_local std::vector<CellRun> dry;
  find_dry(scratch.land, slopes, ray_model_.cell_m, ray_model_.antenna_height_m,
           static_cast<std::uint32_t>(power.size()), dry);
  kept_dry.count = static_cast<std::uint16_t>(std::min(dry.size(), DryRuns::kMost));
  std::copy_n(dry.begin(), kept_dry.count, kept_dry.runs.begin());
}

void StaticFrame::make_row(std::uint32_t index, std::vector<PackedPower>& cells) {
  Row& row = rows_[index];
  row.count = 0;
  cells.clear();
  const std::uint32_t per_ray = detail_.rows / detail_.rays, middle = index / per_ray;
  const std::vector<float>& weights = weights_[index % per_ray];
  thread_local std::vector<WeightedRay> rays;
  rays.clear();
  std::uint32_t first = detail_.cells, last = 0;
  for (std::uint32_t k = 0; k < weights.size(); ++k) {
    if (weights[k] == 0.0f) continue;
    const std::uint32_t ray = (middle + k + detail_.rays - reach_) & (detail_.rays - 1);
    const RingRay& entry = ring_rays_[ray & (ring_size_ - 1)];
    if (entry.first >= entry.last) continue;
    first = std::min(first, entry.first);
    last = std::max(last, entry.last);
    rays.push_back({ring_power(ray), weights[k]});
  }
  if (!rays.empty()) {
    first -= first % static_cast<std::uint32_t>(kPackBlock);
    for (WeightedRay& ray : rays) ray.power += first;
    thread_local std::vector<float> sum;
    sum.resize(detail_.cells);
    const std::span<float> power(sum.data(), last - first);
    sum_rays(rays, power);
    keep(row, first, power, cells);
  }
}

PackedPower* PackedStore::take(std::size_t count) {
  if (used_ + count > kBlock) {
    ++block_;
    used_ = 0;
  }
  if (block_ == blocks_.size())
    blocks_.push_back(std::make_unique_for_overwrite<PackedPower[]>(kBlock));
  PackedPower* taken = blocks_[block_].get() + used_;
  used_ += count;
  return taken;
}

// Rows made at the same time need room of their own: it is given out in make_rows().
void StaticFrame::keep(Row& row, std::uint32_t first, std::span<const float> power,
                       std::vector<PackedPower>& cells) {
  thread_local std::vector<PackedPower> packed;
  thread_local std::vector<float> peaks;
  packed.resize(power.size());
  peaks.resize((power.size() + kPackBlock - 1) / kPackBlock);
  pack_power(power, kLeast, packed, peaks);
  const auto block_at = [&](std::size_t block) {
    return static_cast<std::uint16_t>(first + std::min(power.size(), block * kPackBlock));
  };
  row.count = 0;
  for (std::size_t b = 0; b < peaks.size(); ++b) {
    if (peaks[b] < kLeast) continue;
    EchoRun* last = row.count > 0 ? &row.runs[row.count - 1u] : nullptr;
    if (last && (block_at(b) < last->last + kGap || row.count == Row::kMostRuns)) {
      last->last = block_at(b + 1);
    } else {
      row.runs[row.count++] = {block_at(b), block_at(b + 1), 0};
    }
  }
  cells.clear();
  for (std::size_t i = 0; i < row.count; ++i) {
    EchoRun& run = row.runs[i];
    run.at = static_cast<std::uint32_t>(cells.size());
    cells.push_back(0);
    cells.insert(cells.end(), packed.begin() + (run.first - first),
                 packed.begin() + (run.last - first));
    cells.push_back(0);
  }
  if (row.count > 0) cells.insert(cells.end(), kRowPadding, 0);
}

void StaticFrame::make_rays(std::uint32_t first, std::uint32_t last, const ParallelFor& parallel) {
  thread_local std::vector<std::uint32_t> missing;
  missing.clear();
  for (std::uint32_t r = first; r <= last; ++r) {
    const std::uint32_t ray = r & (detail_.rays - 1);
    if (ring_rays_[ray & (ring_size_ - 1)].ray != ray) missing.push_back(ray);
  }
  share_out(missing.size(), parallel,
            [this, rays = missing.data()](std::size_t i) { make_ray(rays[i]); });
}

void StaticFrame::make_lead_in(std::uint32_t row, std::uint32_t rays) {
  const std::uint32_t first = row / (detail_.rows / detail_.rays) + detail_.rays - reach_;
  if (rays > 0) make_rays(first, first + std::min(rays, lead_in()) - 1, serial_for);
}

void StaticFrame::make_rows(std::uint32_t first, std::uint32_t count, const ParallelFor& parallel) {
  const std::uint32_t per_ray = detail_.rows / detail_.rays;
  make_rays(first / per_ray + detail_.rays - reach_,
            (first + count - 1) / per_ray + detail_.rays + reach_, parallel);
  const auto index_of = [&](std::size_t i) {
    return (first + static_cast<std::uint32_t>(i)) & (detail_.rows - 1);
  };
  share_out(count, parallel, [&](std::size_t i) {
    if (!rows_[index_of(i)].made) make_row(index_of(i), fresh_[i]);
  });
  for (std::uint32_t i = 0; i < count; ++i) {
    Row& row = rows_[index_of(i)];
    if (row.made) continue;
    row.made = true;
    ++made_;
    PackedPower* cells = store_.take(fresh_[i].size());
    std::copy(fresh_[i].begin(), fresh_[i].end(), cells);
    row.cells = cells;
  }
}

void StaticFrame::find(const RowPart& part, std::vector<MovedRun>& runs) const {
  const Row& row = rows_[part.row];
  if (row.count == 0) return;
  const double whole = std::floor(part.shift);
  const auto shift = static_cast<std::int32_t>(whole);
  // Cell i reads the row's cells i + shift and the next.
  const std::int32_t from = static_cast<std::int32_t>(part.first) + shift;
  const std::int32_t to = static_cast<std::int32_t>(part.last) + shift;
  const auto moved = static_cast<float>(part.shift);
  const auto fraction = static_cast<float>(part.shift - whole);
  std::size_t r = 0;
  while (r < row.count && row.runs[r].last <= from) ++r;
  for (; r < row.count && row.runs[r].first <= to; ++r) {
    const EchoRun& run = row.runs[r];
    const std::int32_t begin = std::max(from, run.first - 1) - shift;
    const std::int32_t end = std::min<std::int32_t>(to, run.last) - shift;
    if (begin >= end) continue;
    // Power falls with the cube of range; straight between the ends.
    const auto gain_at = [&](std::int32_t cell) {
      const float ratio = 1.0f + moved / (static_cast<float>(cell) + 0.5f);
      return ratio > 0.0f ? ratio * ratio * ratio : 0.0f;
    };
    const float gain = gain_at(begin);
    const float step = (gain_at(end) - gain) / static_cast<float>(end - begin);
    const PackedPower* cells =
        row.cells + run.at + static_cast<std::size_t>(begin + shift - run.first + 1);
    // A turn's rows are more than the caches near by hold: all runs are fetched at once.
    for (std::int32_t i = 0; i <= end - begin; i += kLineCells) __builtin_prefetch(cells + i);
    runs.push_back({cells,
                    {1.0f - fraction, fraction, gain, step},
                    static_cast<std::uint32_t>(begin),
                    static_cast<std::uint32_t>(end - begin)});
  }
}

double StaticFrame::shadow_slope(std::uint32_t row, std::uint32_t cell) const {
  const std::size_t steps = detail_.cells / kShadowStep + 1;
  const std::size_t step = std::min<std::size_t>(cell / kShadowStep, steps - 1);
  return shadows_[ray_of(row) * steps + step] * kSlopeStep;
}

std::size_t StaticFrame::bytes() const {
  return ring_.capacity() * sizeof(float) + shadows_.capacity() * sizeof(std::int16_t) +
         rows_.capacity() * sizeof(Row) + dry_.capacity() * sizeof(DryRuns) + store_.bytes() +
         crossings_.bytes();
}

}  // namespace skerry::echo
