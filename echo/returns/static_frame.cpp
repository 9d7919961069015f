#include "echo/returns/static_frame.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "echo/kernel/azimuth_sum.hpp"
#include "echo/kernel/pulse_stretch.hpp"
#include "echo/kernel/range_filter.hpp"
#include "echo/kernel/row_losses.hpp"
#include "echo/radar/beam.hpp"
#include "echo/radar/radar_equation.hpp"
#include "echo/returns/hidden_water.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

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

// A few bodies are not worth the threads' start.
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
    const std::size_t begin = block * kPackBlock;
    return peak_of(power.subspan(begin, std::min(kPackBlock, power.size() - begin))) == 0.0f;
  };
  thread_local std::vector<float> peaks;
  peaks.resize((power.size() + kPeakCells - 1) / kPeakCells);
  if (peaks_of(power, peaks) == 0.0f) return {0, 0};
  std::size_t ends[2] = {0, peaks.size()};
  while (peaks[ends[0]] == 0.0f) ++ends[0];
  while (peaks[ends[1] - 1] == 0.0f) --ends[1];
  static_assert(kPeakCells % kPackBlock == 0);
  constexpr std::size_t kBlocks = kPeakCells / kPackBlock;
  std::size_t first = ends[0] * kBlocks;
  std::size_t last = std::min(ends[1] * kBlocks, (power.size() + kPackBlock - 1) / kPackBlock);
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

RayRing::RayRing(std::uint32_t rays, std::uint32_t cells)
    : mask_(rays - 1),
      cells_(cells),
      // 16 floats aside of a whole page: rays exactly 4 KiB apart would share cache sets.
      pitch_((cells + 15u) / 16u * 16u + 16u) {}

void RayRing::reset() {
  slots_.assign(mask_ + 1u, {});
  power_.resize((mask_ + 1u) * pitch_);
}

std::span<float> RayRing::begin(std::uint32_t ray) {
  slots_[ray & mask_] = {ray, {}};
  const std::span<float> power(power_.data() + (ray & mask_) * pitch_, cells_);
  std::fill(power.begin(), power.end(), 0.0f);
  return power;
}

StaticFrame::StaticFrame(const RadarModel& model, const FrameDetail& detail)
    : detail_(detail),
      ray_model_{model.cell_m, model.set.antenna_height_m, model.unit_snr, detail.rays},
      response_(range_response_for(model)),
      per_ray_shift_(static_cast<std::uint32_t>(std::countr_zero(detail.rows / detail.rays))),
      reach_(static_cast<std::uint32_t>(1.25 * model.set.beam_width_deg / 360.0 * detail.rays) + 1),
      ring_(power_of_two_from(kMostRows + 2.0 * reach_ + 2.0, 128, detail.rays), detail.cells) {
  const std::uint32_t per_ray = detail.rows / detail.rays;
  for (std::uint32_t part = 0; part < per_ray; ++part)
    weights_.push_back(beam_weights(model.set.beam_width_deg, detail.rays,
                                    static_cast<double>(part) / per_ray, reach_));
}

void StaticFrame::begin(const Scene& scene, PlanePoint at, double seconds) {
  picture_ = scene.coast;
  structures_ = nullptr;
  sandy_ = false;
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
  ring_.reset();
  ground_.reset(detail_.rays, detail_.cells);
  rows_.reset(detail_.rows);
  fresh_.resize(kMostRows);
}

void StaticFrame::work_crossings(double share) {
  if (crossings_.done()) return;
  const auto all = static_cast<double>(picture_->vertices.size());
  crossings_.work_to(
      *picture_, share >= 1.0 ? picture_->vertices.size() : static_cast<std::size_t>(share * all));
  if (!crossings_.done()) return;
  sandy_ = crossings_.any_of_shore([&](std::size_t shore) {
    return shore < picture_->shores.size() && picture_->shores[shore].type == CoastType::sandy;
  });
  if (view_.ashore) nearest_m_ = 0.0;
  if (crossings_.nearest_m() < ray_model_.cell_m * detail_.cells)
    nearest_m_ = std::min(nearest_m_, crossings_.nearest_m());
}

std::uint32_t StaticFrame::ray_of(std::uint32_t row) const {
  return (row + (1u << per_ray_shift_ >> 1)) >> per_ray_shift_ & (detail_.rays - 1);
}

void StaticFrame::make_ray(std::uint32_t ray) {
  thread_local StaticScratch scratch;
  const auto units = static_cast<std::uint32_t>(0x100000000ull / detail_.rays);
  const std::span<float> power = ring_.begin(ray);
  crossings_.of(ray, scratch.crossings);
  const bool any = add_static_ray(view_, ray_model_, ray * units, true, scratch, power);
  ground_.record(ray, ray_model_, scratch);
  if (!any) return;
  const auto [begin, end] = echoing(power);
  const std::uint32_t first = begin - std::min(begin, response_->lead());
  const std::uint32_t last = std::min(detail_.cells, end + response_->cells() - response_->lead());
  ring_.set_extent(ray, {first, last});
  if (begin >= end) return;
  const std::span<float> echo = power.subspan(first, last - first);
  if (response_->is_box()) {
    stretch_pulse(echo, response_->pulse_cells(), scratch.stretch);
  } else {
    filter_range(echo, response_->taps(), response_->tap_cells(), response_->lead(),
                 scratch.stretch);
  }
}

void StaticFrame::make_row(std::uint32_t row, std::vector<PackedPower>& cells) {
  const std::uint32_t per_ray = detail_.rows / detail_.rays, middle = row / per_ray;
  const std::vector<float>& weights = weights_[row % per_ray];
  thread_local std::vector<WeightedRay> rays;
  rays.clear();
  std::uint32_t first = detail_.cells, last = 0;
  for (std::uint32_t k = 0; k < weights.size(); ++k) {
    if (weights[k] == 0.0f) continue;
    const std::uint32_t ray = (middle + k + detail_.rays - reach_) & (detail_.rays - 1);
    const RayRing::Extent extent = ring_.extent(ray);
    if (extent.first >= extent.last) continue;
    first = std::min(first, extent.first);
    last = std::max(last, extent.last);
    rays.push_back({ring_.power(ray), weights[k]});
  }
  if (rays.empty()) {
    rows_.pack(row, 0, {}, cells);
    return;
  }
  first -= first % static_cast<std::uint32_t>(kPackBlock);
  for (WeightedRay& ray : rays) ray.power += first;
  thread_local std::vector<float> sum;
  sum.resize(detail_.cells);
  const std::span<float> power(sum.data(), last - first);
  sum_rays(rays, power);
  rows_.pack(row, first, power, cells);
}

void StaticFrame::make_rays(std::uint32_t first, std::uint32_t last, const ParallelFor& parallel) {
  thread_local std::vector<std::uint32_t> missing;
  missing.clear();
  for (std::uint32_t r = first; r <= last; ++r) {
    const std::uint32_t ray = r & (detail_.rays - 1);
    if (!ring_.holds(ray)) missing.push_back(ray);
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
    if (!rows_.made(index_of(i))) make_row(index_of(i), fresh_[i]);
  });
  // Rows share the store they are kept in, so this is one thread's.
  for (std::uint32_t i = 0; i < count; ++i) {
    if (!rows_.made(index_of(i))) rows_.keep(index_of(i), fresh_[i]);
  }
}

std::size_t StaticFrame::bytes() const {
  return ring_.bytes() + ground_.bytes() + rows_.bytes() + crossings_.bytes();
}

}  // namespace skerry::echo
