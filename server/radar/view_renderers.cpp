#include "server/radar/view_renderers.hpp"

#include <utility>

namespace skerry::server {

ViewRenderers::ViewRenderers(const echo::RadarSet& set, const ScanGeometry& geometry,
                             const echo::SpokeClock& clock, std::uint32_t radar, RangeScale range,
                             const echo::RadarControls& controls, echo::ParallelFor parallel)
    : set_(set),
      geometry_(geometry),
      clock_(clock),
      radar_(radar),
      parallel_(std::move(parallel)),
      range_(range),
      controls_(controls),
      returns_(model(), parallel_) {
  returns_.set_tune_loss(echo::tune_loss_db(controls_));
}

echo::RadarModel ViewRenderers::model() const {
  return echo::radar_model(set_, geometry_, range_, clock_, radar_, controls_.pulse);
}

void ViewRenderers::set_radar(RangeScale range, const echo::RadarControls& controls) {
  const bool same_model = range == range_ && controls.pulse == controls_.pulse;
  if (same_model && controls == controls_) return;
  range_ = range;
  controls_ = controls;
  if (!same_model) {
    returns_ = echo::SpokeReturns(model(), parallel_);
    for (auto& [number, view] : views_) {
      const echo::ViewControls mine = view.receiver.controls();
      view.receiver = echo::ViewReceiver(model(), mine);
    }
  }
  returns_.set_tune_loss(echo::tune_loss_db(controls_));
}

void ViewRenderers::set_view(std::uint32_t view, const echo::ViewControls& controls) {
  const auto known = views_.find(view);
  if (known == views_.end()) {
    views_.emplace(view, View{echo::ViewReceiver(model(), controls), {}});
  } else if (!(known->second.receiver.controls() == controls)) {
    known->second.receiver.set_controls(controls);
  }
}

void ViewRenderers::render(const echo::Scene& scene, std::uint64_t first, std::uint32_t count) {
  if (views_.empty()) return;
  const echo::PowerRows rows = returns_.make(scene, first, count);
  for (auto& [number, view] : views_) {
    view.video.resize(std::size_t{count} * geometry_.cells);
    view.receiver.receive(rows.cells, rows.pitch, first, count, scene.seed, parallel_, view.video);
  }
}

RangeScale ViewRenderers::range_of(std::uint32_t view) const {
  return views_.at(view).receiver.controls().range_scale;
}

}  // namespace skerry::server
