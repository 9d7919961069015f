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
  const Watched* reference = find_watched(reference_);
  frame_ = motion_frame(rules_.stabilisation(), own_,
                        {.number = reference_,
                         .relative_mps = reference != nullptr && has_motion(*reference)
                                             ? std::optional(reference->track.relative_velocity_mps)
                                             : std::nullopt});
  watch_inputs();
  plotter.tracker().set_areas(zones_.areas(own_.heading_deg));
  watch_ais(ais);
  pair_with_ais();
  watch_zones();
  watch_approaches();
  watch_capacity(plotter.tracker().counts().left_out);
  keep_past();
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
  passed_ = UtcTime{};
  pass_ = ScenarioTime{};
  if (test_targets_since_) test_targets_since_ = UtcTime{};
  for (auto& [number, watched] : targets_) {
    watched.past.clear();
    watched.guard.clear();
    watched.mmsi = 0;
  }
}

// --- what own ship's sensors tell

void TargetWatch::Desk::watch_input(const std::string& name, bool is_there,
                                    const std::string& text) {
  bool& was_there = inputs_[name];
  was_there = was_there || is_there;
  set_alert(!is_there && was_there, AlertKind::lost_input, {0, 0, name}, text);
}

void TargetWatch::Desk::watch_inputs() {
  watch_input("heading", own_.heading_deg.has_value(), "Heading is lost: targets are frozen");
  watch_input("position", own_.place.has_value(), "Position is lost: targets are frozen");
  const bool by_water = rules_.stabilisation() == wire::STABILISATION_WATER;
  watch_input("log", !by_water || own_.through_water_mps,
              "Speed through water is lost: no courses of targets");
  const Watched* reference = find_watched(reference_);
  const bool has_reference = reference != nullptr && !reference->is_dropped;
  watch_input("motion over ground", by_water || own_.over_ground_mps || has_reference,
              "Motion over ground is lost: no courses of targets");
  watch_input("reference", reference_ == 0 || has_reference,
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
  if (!tracks.empty() && (tracks.front().time != pass_ || passed_ == UtcTime{})) {
    pass_ = tracks.front().time;
    passed_ = now_;
  }
  freeze_or_thaw(tracks.empty() || now_ - passed_ <= kNoVideo);
  const auto resets = plotter.tracker().counts().resets;
  take_lost(lost, resets != resets_);
  resets_ = resets;

  for (const PlottedTrack& track : tracks) {
    Watched& watched = targets_[track.number];
    watched.track = track;
    watched.is_dropped = frozen_since_ && now_ - *frozen_since_ >= kFrozenFor;
    if (watched.is_dropped) {
      alerts_.remove(subject_of(watched));
      watched.guard.clear();
    }
  }
  // Those that the plotter has no more; `tracks` rises.
  std::erase_if(targets_, [&](const auto& target) {
    const auto at = std::lower_bound(
        tracks.begin(), tracks.end(), target.first,
        [](const PlottedTrack& track, std::uint32_t number) { return track.number < number; });
    if (at != tracks.end() && at->number == target.first) return false;
    alerts_.remove(subject_of(target.second));
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
    const UtcTime seen = now_ - (track.time - track.last_seen);
    const bool was_frozen = watched.is_dropped || frozen_since_ || (thawed_ && seen < *thawed_);
    any = any || !was_frozen;
    watched.track = track;
    if (!was_frozen && !all_anew) tell_lost(watched);
    targets_.erase(found);
    alerts_.remove({.target = track.number, .mmsi = 0, .what = {}});
    // What has just been put aside is told now.
    if (!lost_.empty() && lost_.back().track.number == track.number) {
      alerts_.raise(
          AlertKind::lost_target, {.target = track.number, .mmsi = 0, .what = {}},
          fmt::format("Target {} is lost, {:.1f} NM, {:03.0f} deg", track.number,
                      metres(track.range_m).in_nautical_miles(), track.bearing.in_degrees()));
    }
  }
  if (all_anew && any) {
    const AlertSubject subject{0, 0, "leap"};
    alerts_.raise(AlertKind::lost_input, subject,
                  "Position or time leapt: all targets are acquired anew");
    alerts_.end(AlertKind::lost_input, subject);
  }
}

// Only those that were something to a mariner: acquired by hand, or tracked for a minute, and
// within the range in which targets are wanted.
void TargetWatch::Desk::tell_lost(const Watched& watched) {
  const PlottedTrack& track = watched.track;
  if (watched.mmsi != 0) {
    alerts_.move(AlertKind::approach, subject_of(watched),
                 {.target = 0, .mmsi = watched.mmsi, .what = {}});
  }
  const double seen_s = in_seconds(track.last_seen - track.first_seen);
  if (!rules_.lost_warnings() || (!track.by_hand && seen_s < kTrend_s) ||
      track.range_m > nautical_miles(rules_.furthest_nm()).in_metres()) {
    return;
  }
  lost_.push_back({.track = track,
                   .seen = now_ - (track.time - track.last_seen),
                   .mmsi = watched.mmsi,
                   .name = name_of(watched)});
  if (lost_.size() <= kMostLost) return;
  alerts_.remove({.target = lost_.front().track.number, .mmsi = 0, .what = {}});
  lost_.pop_front();
}

void TargetWatch::Desk::keep_past() {
  std::erase_if(lost_, [&](const Lost& lost) {
    return !alerts_.has(AlertKind::lost_target,
                        {.target = lost.track.number, .mmsi = 0, .what = {}});
  });
  if (frozen_since_) return;
  for (auto& [number, watched] : targets_) {
    watched.past.add(now_, {watched.track.place, from_own_ship(watched.track)});
  }
}

// --- what is known of a target

PlanePoint TargetWatch::Desk::from_own_ship(const PlottedTrack& track) {
  return vector_of(track.bearing.in_degrees(), track.range_m);
}

double TargetWatch::Desk::tracked_s(const PlottedTrack& track) {
  return in_seconds(track.time - track.first_seen);
}

bool TargetWatch::Desk::has_motion(const Watched& watched) const {
  return !frozen_since_ && tracked_s(watched.track) >= kTrend_s;
}

const TargetWatch::Desk::Watched* TargetWatch::Desk::find_watched(std::uint32_t number) const {
  const auto found = targets_.find(number);
  return found == targets_.end() ? nullptr : &found->second;
}

std::string TargetWatch::Desk::name_of(const Watched& watched) {
  const AisRecord* record = ais_.find(watched.mmsi);
  return record == nullptr ? std::string{} : record->contact.name;
}

ApproachLimits TargetWatch::Desk::limits() const {
  return {.cpa_m = nautical_miles(rules_.cpa_nm()).in_metres(), .tcpa_s = 60.0 * rules_.tcpa_min()};
}

}  // namespace skerry::server
