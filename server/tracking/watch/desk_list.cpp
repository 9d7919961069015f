// The list as it is told.
#include <algorithm>
#include <cmath>

#include "protocol/quantity/speed.hpp"
#include "server/tracking/watch/desk.hpp"
#include "server/tracking/watch/test_targets.hpp"
#include "server/tracking/watch/trial_path.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {

void TargetWatch::Desk::tell(Plotter& plotter) {
  list_.set_utc_ns(static_cast<std::uint64_t>(now_.time_since_epoch().count()));
  if (!targets_.empty()) {
    const ScenarioTime scenario = pass_ + (now_ - *passed_);
    list_.set_scenario_ns(static_cast<std::uint64_t>(scenario.time_since_epoch().count()));
  }
  list_.clear_targets();
  for (const auto& [number, watched] : targets_) {
    if (!watched.is_dropped) tell_target(watched);
  }
  tell_lost_targets();
  std::sort(list_.mutable_targets()->begin(), list_.mutable_targets()->end(),
            [](const wire::Target& a, const wire::Target& b) { return a.number() < b.number(); });
  list_.set_tracked(static_cast<std::uint32_t>(targets_.size()));
  tell_test_targets();
  tell_ais();
  list_.clear_alerts();
  for (wire::Alert& alert : alerts_.told()) *list_.add_alerts() = std::move(alert);
  list_.set_stabilisation(rules_.stabilisation());
  list_.set_stabilised_by(frame_.by);
  list_.set_problem(problem());
  *list_.mutable_rules() = rules_;
  list_.clear_zones();
  for (const wire::TargetZone& zone : zones_.all()) *list_.add_zones() = zone;
  tell_trial();
  tell_own_ship();
  list_.set_plots(plotter.plot_counts().plots);
}

void TargetWatch::Desk::tell_target(const Watched& watched) {
  const PlottedTrack& track = watched.track;
  wire::Target& target = *list_.add_targets();
  put_track(track, target);
  target.set_state(frozen_since_ ? wire::TARGET_FROZEN : target_state(tracked_s(track)));
  tell_motion(watched, target);
  target.set_is_dangerous(watched.is_dangerous);
  target.set_is_new(alerts_.is_unacknowledged(AlertKind::new_target, subject_of(watched)));
  target.set_is_reference(track.number == reference_);
  target.set_age_s(in_seconds(now_ - *passed_ + (track.time - track.last_seen)));
  target.set_mmsi(watched.mmsi);
  target.set_name(name_of(watched));
  for (const WasAt& was : watched.past.told(now_, seconds_as_duration(rules_.past_interval_s()))) {
    wire::PastPlace& past = *target.add_past();
    past.set_latitude_deg(was.place.latitude_deg);
    past.set_longitude_deg(was.place.longitude_deg);
    past.set_range_m(length_of(was.from_own_ship));
    past.set_bearing_deg(direction_of(was.from_own_ship));
  }
}

void TargetWatch::Desk::tell_motion(const Watched& watched, wire::Target& target) const {
  if (!has_motion(watched)) return;
  put_motion(watched.track.relative_velocity_mps, frame_.own_mps, target);
  if (watched.approach) put_approach(*watched.approach, target);
}

void TargetWatch::Desk::tell_lost_targets() {
  for (const Lost& lost : lost_) {
    wire::Target& target = *list_.add_targets();
    target.set_number(lost.track.number);
    target.set_state(wire::TARGET_LOST);
    target.set_by_hand(lost.track.by_hand);
    put_place(lost.track.place, from_own_ship(lost.track), target);
    target.set_age_s(in_seconds(now_ - lost.seen));
    target.set_tracked_s(tracked_s(lost.track));
    target.set_mmsi(lost.mmsi);
    target.set_name(lost.name);
  }
}

void TargetWatch::Desk::tell_test_targets() {
  list_.set_test_targets(test_targets_);
  if (!test_targets_ || !plane_) return;
  if (!test_targets_since_) test_targets_since_ = now_;
  const Duration since = now_ - *test_targets_since_;
  for (std::size_t k = 0; k < kTestTargets.size(); ++k) {
    const TestTargetNow now = test_target_at(kTestTargets[k], since);
    wire::Target& target = *list_.add_targets();
    target.set_number(kFirstTestTarget + static_cast<std::uint32_t>(k));
    target.set_is_test(true);
    target.set_state(target_state(in_seconds(since)));
    target.set_tracked_s(in_seconds(since));
    put_place(plane_->to_geo(now.place), now.place, target);
    if (target.state() == wire::TARGET_ACQUIRING) continue;
    put_motion(now.relative_mps, frame_.own_mps, target);
    const PlottedApproach approach = closest_approach(now.place, now.relative_mps);
    put_approach(approach, target);
    target.set_is_dangerous(server::is_dangerous(approach, limits()));
  }
}

void TargetWatch::Desk::tell_ais() {
  list_.clear_ais();
  list_.set_ais_left_out(ais_.left_out());
  if (!plane_) return;
  for (const auto& [mmsi, record] : ais_.records()) {
    if (!record.is_listed) continue;
    const AisContact& contact = record.contact;
    wire::AisTarget& target = *list_.add_ais();
    target.set_mmsi(mmsi);
    target.set_name(contact.name);
    const GeoPoint place = plane_->to_geo(record.from_own_ship);
    target.set_latitude_deg(place.latitude_deg);
    target.set_longitude_deg(place.longitude_deg);
    target.set_range_m(length_of(record.from_own_ship));
    target.set_bearing_deg(direction_of(record.from_own_ship));
    if (contact.course_deg) target.set_course_deg(*contact.course_deg);
    if (contact.speed_mps) target.set_speed_kn(*contact.speed_mps / kKnot);
    if (contact.heading_deg) target.set_heading_deg(*contact.heading_deg);
    if (record.approach && !record.is_lost) put_approach(*record.approach, target);
    const Watched* pair = find_watched(record.target);
    target.set_is_dangerous(record.guard.is_on() || (pair != nullptr && pair->is_dangerous));
    target.set_is_activated(record.is_activated);
    target.set_is_lost(record.is_lost);
    target.set_target(record.target);
    target.set_age_s(record.age_s);
  }
}

void TargetWatch::Desk::tell_trial() {
  list_.clear_trial();
  if (!trial_) return;
  wire::Trial& trial = *list_.mutable_trial();
  *trial.mutable_order() = trial_->order;
  const double begins_s = std::max(0.0, in_seconds(trial_->begins - now_));
  trial.set_begins_s(begins_s);
  // She is steered through the water; over ground, if there is no log.
  const auto own = own_.through_water_mps ? own_.through_water_mps : own_.over_ground_mps;
  if (!own) return;
  constexpr double kHasCourse_mps = 0.25;
  const double speed_mps = length_of(*own);
  const double course_deg =
      speed_mps < kHasCourse_mps && own_.heading_deg ? *own_.heading_deg : direction_of(*own);
  const TrialPath path(trial_->order, course_deg, speed_mps, begins_s);
  const auto tell = [&](std::uint32_t number, std::uint32_t mmsi, PlanePoint from_own_ship,
                        PlanePoint relative_mps) {
    const TrialPath::Closest closest = path.closest_to(from_own_ship, relative_mps + *own);
    wire::Trial::Outcome& outcome = *trial.add_outcomes();
    outcome.set_target(number);
    outcome.set_mmsi(mmsi);
    outcome.set_cpa_nm(metres(closest.range_m).in_nautical_miles());
    outcome.set_tcpa_min(closest.time_s / 60.0);
    // One that only goes away is not.
    outcome.set_is_dangerous(
        server::is_dangerous({closest.range_m, closest.time_s, closest.time_s > 0.0}, limits()));
  };
  for (const auto& [number, watched] : targets_) {
    if (!has_motion(watched)) continue;
    tell(number, 0, from_own_ship(watched.track), watched.track.relative_velocity_mps);
  }
  if (!plane_ || !own_.over_ground_mps) return;
  for (const auto& [mmsi, record] : ais_.records()) {
    // A pair has one outcome: the radar's, once that has a motion.
    const Watched* partner = record.target == 0 ? nullptr : find_watched(record.target);
    const bool told = partner != nullptr && has_motion(*partner);
    if (!record.is_listed || record.is_lost || told || !record.motion_mps) continue;
    tell(0, mmsi, record.from_own_ship, *record.motion_mps - *own_.over_ground_mps);
  }
}

void TargetWatch::Desk::tell_own_ship() {
  list_.clear_own_course_deg();
  list_.clear_own_speed_kn();
  list_.clear_own_heading_deg();
  if (frame_.own_mps) {
    list_.set_own_course_deg(direction_of(*frame_.own_mps));
    list_.set_own_speed_kn(length_of(*frame_.own_mps) / kKnot);
  }
  // The last one that was known.
  if (own_.place) {
    list_.set_own_latitude_deg(own_.place->latitude_deg);
    list_.set_own_longitude_deg(own_.place->longitude_deg);
  }
  if (own_.heading_deg) list_.set_own_heading_deg(*own_.heading_deg);
}

std::string TargetWatch::Desk::problem() const {
  std::string problem;
  const auto add = [&](const std::string& what) {
    if (!problem.empty() && !what.empty()) problem += "; ";
    problem += what;
  };
  if (!has_time_) return problem;
  constexpr const char* kFrozen = "targets are frozen, and dropped after a minute";
  if (!own_.heading_deg) add(std::string("heading is lost: ") + kFrozen);
  if (!own_.place) add(std::string("position is lost: no AIS targets, and ") + kFrozen);
  if (!is_video_) add(std::string("no video comes: ") + kFrozen);
  add(frame_.problem);
  if (own_.place && !own_.over_ground_mps)
    add("AIS targets have no CPA without motion over ground");
  return problem;
}

}  // namespace skerry::server
