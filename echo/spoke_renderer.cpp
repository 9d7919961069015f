#include "echo/spoke_renderer.hpp"

#include <algorithm>
#include <utility>

namespace skerry::echo {

SpokeRenderer::SpokeRenderer(const RadarSet& set, const ScanGeometry& geometry,
                             const SpokeClock& clock, std::uint32_t radar, ParallelFor parallel)
    : set_(set), geometry_(geometry), clock_(clock), radar_(radar), parallel_(std::move(parallel)) {
  const ViewControls controls;
  const RadarModel model = model_for(controls.range_scale);
  returns_.emplace(model, parallel_);
  receiver_.emplace(model, controls);
}

RadarModel SpokeRenderer::model_for(RangeScale scale) const {
  return radar_model(set_, geometry_, scale, clock_, radar_, radar_controls_.pulse);
}

void SpokeRenderer::rebuild(const ViewControls& controls) {
  const RadarModel model = model_for(controls.range_scale);
  const std::uint32_t cells = row_cells_for(geometry_, controls.range_scale, controls);
  returns_.emplace(with_rows_of(model, cells), parallel_);
  returns_->set_tune_loss(tune_loss_db(radar_controls_));
  receiver_.emplace(model, controls);
  receiver_->set_row_cells(cells);
  rows_ = {};
}

void SpokeRenderer::set_controls(const ViewControls& controls) {
  if (controls == receiver_->controls()) return;
  const ViewControls& now = receiver_->controls();
  if (controls.range_scale == now.range_scale &&
      row_cells_for(geometry_, now.range_scale, controls) ==
          row_cells_for(geometry_, now.range_scale, now)) {
    receiver_->set_controls(controls);
  } else {
    rebuild(controls);
  }
}

void SpokeRenderer::set_radar_controls(const RadarControls& controls) {
  if (controls == radar_controls_) return;
  const bool other_pulse = controls.pulse != radar_controls_.pulse;
  radar_controls_ = controls;
  if (other_pulse) {
    rebuild(ViewControls(receiver_->controls()));
  } else {
    returns_->set_tune_loss(tune_loss_db(radar_controls_));
  }
}

void SpokeRenderer::render(const Scene& scene, std::uint64_t first, std::uint32_t count,
                           std::span<std::uint8_t> video) {
  const std::uint64_t end = first + count;
  for (std::uint64_t spoke = first; spoke < end;) {
    const std::uint64_t block = spoke - spoke % kBlock;
    if (rows_.count == 0 || rows_.first != block) {
      receiver_->fetch();
      rows_ = returns_->make(scene, block, kBlock + receiver_->rows_ahead());
    }
    const auto step = static_cast<std::uint32_t>(std::min(end, block + kBlock) - spoke);
    receiver_->receive(
        rows_.cells.subspan((spoke - block) * rows_.pitch), rows_.pitch, spoke, step, scene.seed,
        parallel_,
        video.subspan((spoke - first) * geometry_.cells, std::size_t{step} * geometry_.cells),
        static_cast<std::uint32_t>(rows_.first + rows_.count - spoke - step));
    spoke += step;
    if (spoke == block + kBlock) {
      returns_->release(spoke);
      rows_ = {};
    }
  }
}

}  // namespace skerry::echo
