#include "server/tracking/view_plotter.hpp"

#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/spoke_message.hpp"

namespace skerry::server {
namespace {

Plotter::Rule rule_of(const TargetWatch& watch, double beam_deg) {
  Plotter::Rule rule = watch.plotter_rule();
  if (beam_deg >= 0.1 && beam_deg <= 10.0) rule.plots.beam_deg = beam_deg;
  return rule;
}

std::uint64_t nanoseconds(UtcTime time) {
  return static_cast<std::uint64_t>(time.time_since_epoch().count());
}

// Where the echo is: own ship's place then, and from there.
GeoPoint place_of(const Plot& plot) {
  const echo::LocalPlane plane(plot.own_ship);
  const echo::SinCos way = echo::sin_cos_degrees(plot.bearing.in_degrees());
  return plane.to_geo({plot.range_m * way.sin, plot.range_m * way.cos});
}

}  // namespace

ViewPlotter::ViewPlotter(std::uint32_t radar, std::uint32_t view, VideoChannelPtr channel,
                         const std::string& format, double beam_deg, std::function<void()> wake)
    : reader_(radar, view, std::move(channel), format, std::move(wake)),
      watch_(radar, view),
      plotter_(rule_of(watch_, beam_deg)) {
  new_plots_.set_radar(radar);
  new_plots_.set_view(view);
}

bool ViewPlotter::take(const OwnSensors& own) {
  for (int taken = 0; taken < kSectorsAtOnce; ++taken) {
    const EncodedSectorPtr sector = reader_.take();
    if (sector == nullptr) return false;
    spokes_lost_ += reader_.newly_lost();
    const std::lock_guard lock(mutex_);
    std::size_t begin = sector->begin;
    for (const std::uint32_t end : sector->spoke_ends) {
      if (TargetWatch::can_plot(own)) {
        give(std::span(sector->bytes).subspan(begin, end - begin));
      }
      begin = end;
    }
  }
  return true;
}

void ViewPlotter::give(std::span<const std::uint8_t> frame) {
  const std::span<const std::uint8_t> body = frame_body(frame);
  if (!message_.ParseFromArray(body.data(), static_cast<int>(body.size()))) return;
  const auto spoke = from_message(message_.spoke());
  if (!spoke) return;
  newest_ = spoke->header.scenario_time;
  plotter_.add(*spoke);
  note_plots();
}

void ViewPlotter::note_plots() {
  for (const Plot& plot : plotter_.new_plots()) {
    ++plots_so_far_;
    if (new_plots_.plots_size() >= TargetPort::kMostPlots) continue;
    const GeoPoint place = place_of(plot);
    wire::TargetPlot& told = *new_plots_.add_plots();
    told.set_range_m(plot.range_m);
    told.set_bearing_deg(plot.bearing.in_degrees());
    told.set_latitude_deg(place.latitude_deg);
    told.set_longitude_deg(place.longitude_deg);
    told.set_length_m(plot.length_m);
    told.set_width_m(plot.width_m);
    told.set_level(plot.greatest);
    told.set_utc_ns(nanoseconds(plot.utc));
  }
}

void ViewPlotter::tell(const OwnSensors& own, std::span<const AisContact> ais) {
  const std::lock_guard lock(mutex_);
  watch_.update(own, ais, plotter_);
  auto list = std::make_shared<wire::TargetList>(watch_.list());
  list->set_scenario_ns(static_cast<std::uint64_t>(newest_.time_since_epoch().count()));
  list->set_plots(plots_so_far_);
  list->set_spokes_lost(spokes_lost_);
  auto plots = std::make_shared<wire::TargetPlots>();
  plots->set_radar(new_plots_.radar());
  plots->set_view(new_plots_.view());
  plots->Swap(&new_plots_);
  new_plots_.set_radar(plots->radar());
  new_plots_.set_view(plots->view());
  new_plots_.set_first(plots_so_far_);
  plots_.set(std::move(plots));
  list_.set(std::move(list));
}

wire::Reply ViewPlotter::order(const wire::TargetOrder& order) {
  const std::lock_guard lock(mutex_);
  return watch_.order(order, plotter_);
}

}  // namespace skerry::server
