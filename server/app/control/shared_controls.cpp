// What of the desk's work hosts of a fleet share.
#include <set>
#include <utility>

#include "server/app/control/control_desk.hpp"
#include "server/app/control/controls_message.hpp"

namespace skerry::server {
namespace {

// Unlike the controls of a fresh radar in all of them.
const echo::RadarControls kOther{.transmit = false,
                                 .pulse = echo::PulseChoice::short_pulse,
                                 .tune_auto = false,
                                 .tune = 1.0,
                                 .rotation_rpm = 1.0,
                                 .bearing_alignment_deg = 1.0,
                                 .antenna_height_m = 1.0,
                                 .blanked = {{}}};

bool is_more_than_a_view(const wire::Set& set) {
  // What it says of a radar is other than the one or the other.
  const auto changes = [&](const echo::RadarControls& before) {
    echo::RadarControls after = before;
    change_radar(set, after);
    return after != before;
  };
  return set.has_course_deg() || set.has_speed_kn() || set.has_con() || set.has_world() ||
         set.has_exercise() || !set.lock().empty() || !set.unlock().empty() || changes({}) ||
         changes(kOther);
}

}  // namespace

bool ControlDesk::has_a_con(const std::string& origin) const {
  const std::lock_guard lock(mutex_);
  for (std::size_t ship = 0; ship < cons_.size(); ++ship) {
    if (cons_.holder(ship) == origin) return true;
  }
  return false;
}

void ControlDesk::leave_all(const std::string& ending) {
  std::set<std::string> origins;
  {
    const std::lock_guard lock(mutex_);
    for (std::size_t ship = 0; ship < cons_.size(); ++ship) {
      if (cons_.holder(ship).ends_with(ending)) origins.insert(cons_.holder(ship));
    }
  }
  for (const std::string& origin : origins) leave(origin);
}

std::optional<wire::Set> ControlDesk::shared_part(const wire::Set& set) const {
  wire::Set shared = set;
  shared.clear_token();
  if (set.view() == 0) return shared;
  const RadarViewPtr view =
      set.radar() < units_.size() ? units_[set.radar()]->views().find(set.view()) : RadarViewPtr();
  if (!view) return shared;  // refused in the same words everywhere
  const bool follows_shared = view->follows() && view->followed->number == 0;
  if (!follows_shared && !is_more_than_a_view(set)) return std::nullopt;
  if (!follows_shared) return shared;
  shared.clear_view();
  shared.clear_instrumented_range_m();
  // Its own instrumented range is not the shared view's.
  return set.has_instrumented_range_m() && !is_more_than_a_view(shared) ? std::nullopt
                                                                        : std::optional(shared);
}

ControlDesk::Kept ControlDesk::kept() const {
  const std::lock_guard lock(mutex_);
  Kept kept{cons_, locks_.all(), {}, {}};
  for (const RadarUnit* unit : units_) {
    kept.views.push_back(*unit->views().get()->front()->controls.get());
    kept.radars.push_back(unit->radar_controls());
  }
  return kept;
}

void ControlDesk::restore(const Kept& kept) {
  const std::lock_guard lock(mutex_);
  cons_ = kept.cons;
  locks_.set_all(kept.locks);
  for (std::size_t radar = 0; radar < units_.size(); ++radar) {
    put_view(*units_[radar], *units_[radar]->views().get()->front(), kept.views[radar]);
    units_[radar]->set_radar_controls(kept.radars[radar]);
  }
  settings_version_.fetch_add(1);
  world_version_.fetch_add(1);
}

}  // namespace skerry::server
