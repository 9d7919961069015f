#include "server/tracking/view_plotter.hpp"

#include <utility>

#include "protocol/wire/frame.hpp"
#include "protocol/wire/spoke_message.hpp"
#include "server/tracking/watch/told_target.hpp"

namespace skerry::server {
namespace {

Plotter::Rule rule_of(const TargetWatch& watch, double beam_deg) {
  Plotter::Rule rule = watch.plotter_rule();
  if (beam_deg >= 0.1 && beam_deg <= 10.0) rule.plots.beam_deg = beam_deg;
  return rule;
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
  // A playback that stands still sends its last turn again to who has joined.
  const Duration back = newest_ - spoke->header.scenario_time;
  if (back >= Duration::zero() && back < kSentAgain) return;
  newest_ = spoke->header.scenario_time;
  plotter_.add(*spoke);
  note_plots();
}

void ViewPlotter::note_plots() {
  for (const Plot& plot : plotter_.new_plots()) {
    ++plots_so_far_;
    if (new_plots_.plots_size() >= TargetPort::kMostPlots) continue;
    put_plot(plot, *new_plots_.add_plots());
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
