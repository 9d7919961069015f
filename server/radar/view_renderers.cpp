#include "server/radar/view_renderers.hpp"

#include <algorithm>
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
      row_cells_(geometry.cells),
      returns_(made_returns()) {}

echo::RadarModel ViewRenderers::model() const {
  echo::RadarSet set = set_;
  if (controls_.antenna_height_m > 0.0) set.antenna_height_m = controls_.antenna_height_m;
  return echo::radar_model(set, geometry_, range_, clock_, radar_, controls_.pulse);
}

echo::SpokeReturns ViewRenderers::made_returns() const {
  echo::SpokeReturns returns(echo::with_rows_of(model(), row_cells_), parallel_);
  returns.set_tune_loss(echo::tune_loss_db(controls_));
  returns.set_faults(faults_);
  return returns;
}

void ViewRenderers::fit_returns() {
  std::uint32_t cells = geometry_.cells;
  for (const auto& [number, view] : views_) {
    cells = std::max(cells, echo::row_cells_for(geometry_, range_, view.receiver.controls()));
  }
  cells = echo::row_cells_for_error(geometry_, range_, cells, faults_.range_error_m);
  if (cells != row_cells_ || !returns_fit_) {
    row_cells_ = cells;
    returns_ = made_returns();
    returns_fit_ = true;
  }
  for (auto& [number, view] : views_) view.receiver.set_row_cells(cells);
}

void ViewRenderers::set_radar(RangeScale range, const echo::RadarControls& controls,
                              const echo::SpokeClock& clock) {
  const bool same_cells = range == range_ && controls.pulse == controls_.pulse;
  returns_fit_ = returns_fit_ && same_cells && clock == clock_ &&
                 controls.antenna_height_m == controls_.antenna_height_m;
  range_ = range;
  controls_ = controls;
  clock_ = clock;
  if (!same_cells) {
    for (auto& [number, view] : views_) {
      const echo::ViewControls mine = view.receiver.controls();
      view.receiver = echo::ViewReceiver(model(), mine);
    }
  }
  returns_.set_tune_loss(echo::tune_loss_db(controls_));
}

void ViewRenderers::set_faults(const echo::RadarFaults& faults) {
  faults_ = faults;
  returns_.set_faults(faults);
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
  fit_returns();
  std::uint32_t ahead = 0;
  for (auto& [number, view] : views_) {
    view.receiver.fetch();
    view.receiver.set_noise(faults_.noise_db);
    ahead = std::max(ahead, view.receiver.rows_ahead());
  }
  ahead = std::min(ahead, echo::SpokeReturns::kMaxSector - count);
  const auto coloured = [](const View& view) {
    return view.receiver.controls().doppler != echo::DopplerMode::off;
  };
  returns_.set_doppler(std::any_of(views_.begin(), views_.end(),
                                   [&](const auto& entry) { return coloured(entry.second); }));
  const echo::PowerRows rows = returns_.make(scene, first, count + ahead);
  for (auto& [number, view] : views_) {
    view.video.resize(std::size_t{count} * geometry_.cells);
    view.receiver.receive(rows.cells, rows.pitch, first, count, scene.seed, parallel_, view.video,
                          ahead);
    view.doppler.resize(coloured(view) ? view.video.size() : 0);
    if (coloured(view)) {
      view.receiver.colour(rows.cells, rows.closing, rows.pitch, count, view.video, view.doppler);
    }
  }
  returns_.release(first + count);
}

RangeScale ViewRenderers::range_of(std::uint32_t view) const {
  return views_.at(view).receiver.controls().range_scale;
}

Length ViewRenderers::instrumented_range_of(std::uint32_t view) const {
  const echo::ViewControls& controls = views_.at(view).receiver.controls();
  return controls.instrumented_range_m > 0.0 ? echo::reach_of(controls) : Length{};
}

}  // namespace skerry::server
