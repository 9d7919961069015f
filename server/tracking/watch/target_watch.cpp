#include "server/tracking/watch/target_watch.hpp"

#include "server/tracking/watch/desk.hpp"
#include "server/tracking/watch/rules.hpp"

namespace skerry::server {

TargetWatch::TargetWatch(std::uint32_t radar, std::uint32_t view)
    : desk_(std::make_unique<Desk>(radar, view)) {}
TargetWatch::~TargetWatch() = default;
TargetWatch::TargetWatch(TargetWatch&&) noexcept = default;
TargetWatch& TargetWatch::operator=(TargetWatch&&) noexcept = default;

Plotter::Rule TargetWatch::plotter_rule() const {
  return {.plots = {}, .tracks = tracker_rule(desk_->rules())};
}

wire::Reply TargetWatch::order(const wire::TargetOrder& order, Plotter& plotter) {
  return desk_->order(order, plotter);
}

void TargetWatch::update(const OwnSensors& own, std::span<const AisContact> ais, Plotter& plotter) {
  desk_->update(own, ais, plotter);
}

const wire::TargetList& TargetWatch::list() const { return desk_->list(); }

}  // namespace skerry::server
