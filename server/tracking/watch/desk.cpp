#include "server/tracking/watch/desk.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "server/tracking/watch/rules.hpp"
#include "server/tracking/watch/vectors.hpp"

namespace skerry::server {
namespace {

constexpr double kFastestOwn_mps = 100.0;  // of own ship

// What a sensor tells that cannot be is not there.
OwnSensors sound(OwnSensors own) {
  const auto check = [](std::optional<PlanePoint>& mps) {
    if (mps && !(is_finite(*mps) && length_of(*mps) <= kFastestOwn_mps)) mps.reset();
  };
  check(own.over_ground_mps);
  check(own.through_water_mps);
  if (own.place && !is_on_the_earth(*own.place)) own.place.reset();
  if (own.heading_deg) {
    if (!(std::fabs(*own.heading_deg) <= 720.0)) {
      own.heading_deg.reset();
    } else {
      own.heading_deg = wrapped_degrees(*own.heading_deg);
    }
  }
  return own;
}

}  // namespace

TargetWatch::Desk::Desk(std::uint32_t radar, std::uint32_t view) : rules_(default_target_rules()) {
  list_.set_radar(radar);
  list_.set_view(view);
  *list_.mutable_rules() = rules_;
}

void TargetWatch::Desk::update(const OwnSensors& own, std::span<const AisContact> ais,
                               Plotter& plotter) {
  if (has_time_ && (own.utc < now_ || own.utc - now_ > kLongestStep)) end_what_hangs_on_time();
  has_time_ = true;
  now_ = own.utc;
  own_ = sound(own);
  plane_.reset();
  if (own_.place) plane_.emplace(*own_.place);
  alerts_.go_on(now_);
  take_tracks(plotter);
  frame_ = frame_now();
  watch_inputs();
  plotter.tracker().set_areas(zones_.areas(own_.heading_deg));
  watch_ais(ais);
  pair_with_ais();
  watch_zones();
  watch_approaches();
  watch_capacity(plotter.tracker().counts().left_out);
  keep_past();
  forget_acknowledged_ones();
  tell(plotter);
}

void TargetWatch::Desk::end_what_hangs_on_time() {
  alerts_.clear();
  lost_.clear();
  ais_.clear();
  trial_.reset();
  frozen_since_.reset();
  thawed_.reset();
  left_one_out_.reset();
  inputs_.clear();
  passed_.reset();
  test_targets_since_.reset();
  for (auto& [number, watched] : targets_) {
    watched.past.clear();
    watched.guard.clear();
    watched.is_dangerous = false;
    watched.mmsi = 0;
  }
}

MotionFrame TargetWatch::Desk::frame_now() const {
  ReferenceTarget reference;
  reference.number = reference_;
  if (const Watched* watched = find_watched(reference_); watched && !watched->is_dropped) {
    reference.is_tracked = true;
    if (has_motion(*watched)) reference.relative_mps = watched->track.relative_velocity_mps;
  }
  return motion_frame(rules_.stabilisation(), own_, reference);
}

// --- what own ship's sensors tell

// What was never there is not lost.
void TargetWatch::Desk::watch_input(const std::string& name, bool is_there, bool is_needed,
                                    const std::string& text) {
  bool& was_there = inputs_[name];
  was_there = was_there || is_there;
  set_alert(is_needed && !is_there && was_there, AlertKind::lost_input, {0, 0, name}, text);
}

void TargetWatch::Desk::watch_inputs() {
  watch_input("heading", own_.heading_deg.has_value(), true, "Heading is lost: targets are frozen");
  watch_input("position", own_.place.has_value(), true, "Position is lost: targets are frozen");
  const bool by_water = rules_.stabilisation() == wire::STABILISATION_WATER;
  watch_input("log", own_.through_water_mps.has_value(), by_water,
              "Speed through water is lost: no courses of targets");
  const Watched* reference = find_watched(reference_);
  const bool has_reference = reference != nullptr && !reference->is_dropped;
  watch_input("motion over ground", own_.over_ground_mps.has_value(), !by_water && !has_reference,
              "Motion over ground is lost: no courses of targets");
  watch_input(kReference, has_reference, !by_water && reference_ != 0,
              fmt::format("Reference target {} is lost", reference_));
}

// --- what the plotter has

void TargetWatch::Desk::freeze_or_thaw(bool is_video) {
  is_video_ = is_video;
  const bool is_frozen = !can_plot(own_) || !is_video;
  if (is_frozen && !frozen_since_) frozen_since_ = now_;
  if (!is_frozen && frozen_since_) {
    frozen_since_.reset();
    thawed_ = now_;
  }
}

void TargetWatch::Desk::take_tracks(Plotter& plotter) {
  const std::vector<PlottedTrack> tracks = plotter.tracks();
  const std::vector<PlottedTrack> lost = plotter.take_lost();
  if (!tracks.empty() && (!passed_ || tracks.front().time != pass_)) {
    pass_ = tracks.front().time;
    passed_ = now_;
  }
  freeze_or_thaw(tracks.empty() || now_ - *passed_ <= kNoVideo);
  const auto resets = plotter.tracker().counts().resets;
  take_lost(lost, resets != resets_);
  resets_ = resets;

  const bool is_over = frozen_since_ && now_ - *frozen_since_ >= kFrozenFor;
  for (const PlottedTrack& track : tracks) {
    // It has come out of hiding with the number it had.
    if (!targets_.contains(track.number) &&
        std::erase_if(lost_, [&](const Lost& one) { return one.track.number == track.number; })) {
      alerts_.remove(subject_of_target(track.number));
    }
    Watched& watched = targets_[track.number];
    watched.track = track;
    if (is_over && !watched.is_dropped) {
      set_partner(watched, 0);
      alerts_.remove(subject_of(watched));
      watched.guard.clear();
      watched.is_dangerous = false;
    }
    watched.is_dropped = is_over;
  }
  // Those that the plotter has no more; `tracks` rises.
  std::erase_if(targets_, [&](const auto& target) {
    const auto at = std::lower_bound(
        tracks.begin(), tracks.end(), target.first,
        [](const PlottedTrack& track, std::uint32_t number) { return track.number < number; });
    if (at != tracks.end() && at->number == target.first) return false;
    alerts_.remove(subject_of_target(target.first));
    return true;
  });
}

// `all_anew`: the antenna's time or own ship leapt, and the plotter has forgotten everything.
void TargetWatch::Desk::take_lost(const std::vector<PlottedTrack>& lost, bool all_anew) {
  bool any = false;
  for (const PlottedTrack& track : lost) {
    const auto found = targets_.find(track.number);
    if (found == targets_.end()) continue;
    Watched& watched = found->second;
    watched.track = track;
    // Nobody looked for it any more, or it was never seen again.
    const bool was_frozen = watched.is_dropped || frozen_since_ ||
                            (thawed_ && now_ - (track.time - track.last_seen) < *thawed_);
    any = any || !was_frozen;
    const AlertSubject subject = subject_of(watched);
    if (watched.mmsi != 0) alerts_.move(AlertKind::approach, subject, {0, watched.mmsi, {}});
    alerts_.remove(subject);
    if (!was_frozen && !all_anew && is_worth_a_warning(watched)) put_aside(watched);
    targets_.erase(found);
  }
  if (!all_anew || !any) return;
  const AlertSubject subject{0, 0, "leap"};
  alerts_.raise(AlertKind::lost_input, subject,
                "Position or time leapt: all targets are acquired anew");
  alerts_.end(AlertKind::lost_input, subject);
}

// What was something to a mariner: acquired by hand, or tracked for a minute; and where targets are
// wanted.
bool TargetWatch::Desk::is_worth_a_warning(const Watched& watched) const {
  const PlottedTrack& track = watched.track;
  return rules_.lost_warnings() &&
         (track.by_hand || in_seconds(track.last_seen - track.first_seen) >= kTrendAfter_s) &&
         track.range_m <= nautical_miles(rules_.furthest_nm()).in_metres();
}

void TargetWatch::Desk::put_aside(const Watched& watched) {
  const PlottedTrack& track = watched.track;
  lost_.push_back({.track = track,
                   .seen = now_ - (track.time - track.last_seen),
                   .mmsi = watched.mmsi,
                   .name = name_of(watched)});
  alerts_.raise(AlertKind::lost_target, subject_of(watched),
                fmt::format("Target {} is lost, {:.1f} NM, {:03.0f} deg", track.number,
                            metres(track.range_m).in_nautical_miles(), track.bearing.in_degrees()));
  if (lost_.size() <= kMostLost) return;
  alerts_.remove(subject_of_target(lost_.front().track.number));
  lost_.pop_front();
}

void TargetWatch::Desk::forget_acknowledged_ones() {
  std::erase_if(lost_, [&](const Lost& lost) {
    return !alerts_.has(AlertKind::lost_target, subject_of_target(lost.track.number));
  });
}

void TargetWatch::Desk::keep_past() {
  if (frozen_since_) return;
  for (auto& [number, watched] : targets_) {
    watched.past.add(now_, {watched.track.place, from_own_ship(watched.track)});
  }
}

// --- what is known of a target

bool TargetWatch::Desk::has_motion(const Watched& watched) const {
  return !frozen_since_ && tracked_s(watched.track) >= kTrendAfter_s;
}

const TargetWatch::Desk::Watched* TargetWatch::Desk::find_watched(std::uint32_t number) const {
  const auto found = targets_.find(number);
  return found == targets_.end() ? nullptr : &found->second;
}

std::string TargetWatch::Desk::name_of(const Watched& watched) const {
  const AisRecord* record = ais_.find(watched.mmsi);
  return record == nullptr ? std::string{} : record->contact.name;
}

ApproachLimits TargetWatch::Desk::limits() const {
  return {.cpa_m = nautical_miles(rules_.cpa_nm()).in_metres(), .tcpa_s = 60.0 * rules_.tcpa_min()};
}

}  // namespace skerry::server
