#include "echo/spoke_renderer.hpp"

#include <algorithm>

#include "echo/kernel/azimuth_sum.hpp"
#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kMaxSector = 64;

RayModel ray_model(const RadarSet& set, const ScanGeometry& geometry, const Beam& beam,
                   const ViewControls& controls) {
  return {set, set.pulse_for(controls.range_scale), geometry.spokes_per_turn * beam.per_spoke,
          geometry.cells, geometry.cell_size(controls.range_scale).in_metres()};
}

}  // namespace

SpokeRenderer::SpokeRenderer(const RadarSet& set, const ScanGeometry& geometry,
                             const SpokeClock& clock, std::uint32_t radar, ParallelFor parallel)
    : set_(set),
      geometry_(geometry),
      clock_(clock),
      ray_clock_(clock),
      radar_(radar),
      parallel_(std::move(parallel)),
      beam_(beam_over_rays(set.beam_width_deg, geometry.spokes_per_turn)),
      receiver_(geometry, controls_) {
  ray_clock_ = clock.with_spokes(geometry.spokes_per_turn * beam_.per_spoke);
  model_ = ray_model(set_, geometry_, beam_, controls_);
  // 16 floats aside of a whole page: rows exactly 4 KiB apart would share cache sets.
  pitch_ = ((geometry.cells + 15u) / 16u) * 16u + 16u;
  rows_.resize(kMaxSector * beam_.per_spoke + 2 * beam_.half + 1);
  powers_.assign(rows_.size() * pitch_, 0.0f);
}

void SpokeRenderer::set_controls(const ViewControls& controls) {
  if (controls == controls_) return;
  // Rays made for another range scale have other cells.
  if (!(controls.range_scale == controls_.range_scale)) {
    for (Row& row : rows_) row = {};
  }
  controls_ = controls;
  model_ = ray_model(set_, geometry_, beam_, controls_);
  receiver_ = Receiver(geometry_, controls_);
}

void SpokeRenderer::ray_power(const Scene& scene, std::uint64_t ray, std::span<float> power) {
  RayScratch scratch;
  const double dt = in_seconds(ray_clock_.time_of(ray) - scene.time);
  const auto in_turn = static_cast<std::uint32_t>(ray % model_.rays_per_turn);
  ray_returns(scene, hulls_in_sight(scene, dt, 0.0, model_), model_,
              RelativeBearing::of_spoke(in_turn, model_.rays_per_turn).units(), dt, scratch, power);
}

void SpokeRenderer::make_rays(const Scene& scene, std::uint64_t begin, std::uint64_t end) {
  const double middle = in_seconds(ray_clock_.time_of((begin + end) / 2) - scene.time);
  const double span = static_cast<double>(end - begin + 1) * ray_clock_.seconds_per_spoke();
  const HullsInSight hulls = hulls_in_sight(scene, middle, span, model_);
  parallel_(static_cast<std::size_t>(end - begin), [&](std::size_t k) {
    const std::uint64_t ray = begin + k;
    Row& row = rows_[ray % rows_.size()];
    if (row.ray == ray) return;
    thread_local RayScratch scratch;
    const auto in_turn = static_cast<std::uint32_t>(ray % model_.rays_per_turn);
    row.ray = ray;
    row.echoes = ray_returns(scene, hulls, model_,
                             RelativeBearing::of_spoke(in_turn, model_.rays_per_turn).units(),
                             in_seconds(ray_clock_.time_of(ray) - scene.time), scratch,
                             {powers_.data() + row_offset(ray), geometry_.cells});
  });
}

void SpokeRenderer::make_spoke(const Scene& scene, std::uint64_t spoke,
                               std::span<std::uint8_t> video) const {
  thread_local std::vector<WeightedRay> rays;
  thread_local std::vector<float> power;
  rays.clear();
  power.resize(geometry_.cells);
  const std::uint64_t middle = spoke * beam_.per_spoke;
  for (std::uint32_t k = 0; k < beam_.weights.size(); ++k) {
    if (middle + k < beam_.half) continue;  // before the antenna's start
    const std::uint64_t ray = middle + k - beam_.half;
    if (rows_[ray % rows_.size()].echoes)
      rays.push_back({powers_.data() + row_offset(ray), beam_.weights[k]});
  }
  sum_rays(rays, power);
  const auto scan = static_cast<std::uint32_t>(spoke / geometry_.spokes_per_turn);
  const auto index = static_cast<std::uint32_t>(spoke % geometry_.spokes_per_turn);
  receiver_.receive(power, noise_key(scene.seed, radar_, scan, index), video);
}

void SpokeRenderer::render(const Scene& scene, std::uint64_t first, std::uint32_t count,
                           std::span<std::uint8_t> video) {
  for (std::uint32_t done = 0; done < count;) {
    const std::uint32_t step = std::min(count - done, kMaxSector);
    const std::uint64_t begin = (first + done) * beam_.per_spoke;
    make_rays(scene, begin > beam_.half ? begin - beam_.half : 0,
              begin + std::uint64_t{step - 1} * beam_.per_spoke + beam_.half + 1);
    parallel_(step, [&](std::size_t k) {
      make_spoke(scene, first + done + k,
                 video.subspan((done + k) * geometry_.cells, geometry_.cells));
    });
    done += step;
  }
}

}  // namespace skerry::echo
