// What becomes of a target, and what is told of it.
#include "server/plotter/tracks/book.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {

namespace {

constexpr unsigned kHitsOfALostOne = 8;
constexpr double kMostMisfitOfALostOne = 2.5;

}  // namespace

void Tracker::Book::judge(Followed& followed) {
  const Target& target = followed.target;
  const bool old = target.hits_ever() >= 10 || followed.number != 0;
  // A young one, which may have been chance, has less time.  A target that is seen in five turns of
  // ten is held (MSC.192(79), 5.25.4.5): by chance it is not seen in ten running once in a thousand
  // turns.
  if (target.score_bits() < (old ? 0.0 : -6.0) ||
      (target.hits_ever() < 20 && target.looks() == 10 && target.hits() <= 1) ||
      (old ? target.looks() == 10 && target.hits() == 0 : target.misses_in_a_row() >= 3)) {
    followed.gone = true;
    return;
  }
  if (followed.number != 0 || followed.refused) return;
  if (deserves_a_track(followed)) {
    show(followed);
  } else if (may_be_a_lost_one(followed) && shown_ < rule_.most_tracks) {
    if (const auto lost = lost_targets_.take(target)) {
      ++shown_;
      followed.number = lost->number;
      followed.by_hand = lost->by_hand;
    }
  }
}

bool Tracker::Book::deserves_a_track(const Followed& followed) const {
  const Target& target = followed.target;
  const Acquire acquire = acquired_at(target.place_at(antenna_.time));
  if (acquire == Acquire::none || target.hits_ever() < rule_.least_hits ||
      2 * target.hits() < target.looks() || target.score_bits() < rule_.sure_bits) {
    return false;
  }
  return acquire == Acquire::all ? target.suspicion() <= kMostSuspicion : is_under_way(target);
}

// Less is asked of it than of a new one: that it is seen steadily, and goes on straight.
bool Tracker::Book::may_be_a_lost_one(const Followed& followed) const {
  const Target& target = followed.target;
  return target.hits_ever() >= kHitsOfALostOne && 2 * target.hits() >= target.looks() &&
         target.signs().misfit() <= kMostMisfitOfALostOne && target.suspicion() <= kMostSuspicion &&
         length_of(target.state().velocity()) > rule_.least_speed_kn * kKnot &&
         acquired_at(target.place_at(antenna_.time)) != Acquire::none;
}

Tracker::Acquire Tracker::Book::acquired_at(PlanePoint place) const {
  if (areas_.empty()) return rule_.acquire;
  const PlanePoint from_own = place - own_place_;
  const double range_m = length_of(from_own);
  const double bearing = TrueBearing::from(degrees(bearing_of(from_own) - north_deg_)).in_degrees();
  const auto is_in = [&](const Area& area) {
    if (range_m < area.inner_m || range_m > area.outer_m) return false;
    const double width = area.to_deg - area.from_deg;
    const double past = bearing - area.from_deg;
    return width == 0.0 ||
           (past < 0.0 ? past + 360.0 : past) <= (width < 0.0 ? width + 360.0 : width);
  };
  const auto area = std::find_if(areas_.begin(), areas_.end(), is_in);
  return area == areas_.end() ? rule_.acquire : area->acquire;
}

void Tracker::Book::show(Followed& followed) {
  if (shown_ >= rule_.most_tracks) {
    ++counts_.left_out;
    return;
  }
  ++shown_;
  const auto lost = lost_targets_.take(followed.target);
  followed.number = lost ? lost->number : ++numbers_;
  if (lost) followed.by_hand = lost->by_hand;
}

void Tracker::Book::drop_gone_ones() {
  const auto is_gone = [](const Followed& followed) { return followed.gone; };
  const auto first = std::find_if(followed_.begin(), followed_.end(), is_gone);
  for (auto at = first; at != followed_.end(); ++at) {
    if (!at->gone || at->number == 0) continue;
    tell_lost(*at);
    lost_targets_.keep(at->target, at->number, at->by_hand);
    --shown_;
  }
  followed_.erase(std::remove_if(first, followed_.end(), is_gone), followed_.end());
}

// As many as anybody asks for.
void Tracker::Book::tell_lost(const Followed& followed) {
  if (lost_.size() < kMostLost) lost_.push_back(track_of(followed, TrackStatus::lost));
}

std::uint32_t Tracker::Book::acquire(GeoPoint point, double within_m) {
  if (!plane_ || !(std::fabs(point.latitude_deg) <= 90.0) ||
      !(std::fabs(point.longitude_deg) <= 180.0)) {
    return 0;
  }
  const PlanePoint place = plane_->to_plane(point);
  Followed* nearest = nullptr;
  double least = within_m;
  for (Followed& followed : followed_) {
    const double off = length_of(followed.target.place_at(antenna_.time) - place);
    if (!(off <= least) || followed.target.hits_ever() < 2) continue;
    least = off;
    nearest = &followed;
  }
  if (nearest == nullptr) return 0;
  if (nearest->number == 0) show(*nearest);
  nearest->by_hand = nearest->number != 0;
  return nearest->number;
}

bool Tracker::Book::cancel(std::uint32_t number) {
  for (Followed& followed : followed_) {
    if (number == 0 || followed.number != number) continue;
    // It is followed on, so that it is not acquired anew at once.
    followed.number = 0;
    followed.by_hand = false;
    followed.refused = true;
    --shown_;
    return true;
  }
  return false;
}

std::vector<PlottedTrack> Tracker::Book::tracks() const {
  std::vector<PlottedTrack> tracks;
  for (const Followed& followed : followed_) {
    if (followed.number != 0) tracks.push_back(track_of(followed, TrackStatus::tracked));
  }
  std::sort(tracks.begin(), tracks.end(),
            [](const PlottedTrack& a, const PlottedTrack& b) { return a.number < b.number; });
  return tracks;
}

std::vector<PlottedTrack> Tracker::Book::take_lost() { return std::exchange(lost_, {}); }

Tracker::Counts Tracker::Book::counts() const {
  Counts counts = counts_;
  counts.followed = followed_.size();
  return counts;
}

PlottedTrack Tracker::Book::track_of(const Followed& followed, TrackStatus status) const {
  const Target& target = followed.target;
  const MotionState& state = target.state();
  const PlanePoint place = target.place_at(antenna_.time);
  const echo::SinCos north = echo::sin_cos_degrees(-north_deg_);
  const auto truly = [&](PlanePoint v) { return echo::turned(v, north); };
  PlottedTrack track;
  track.number = followed.number;
  track.status = status;
  track.time = antenna_.time;
  track.utc = antenna_.utc;
  track.place = plane_->to_geo(place);
  track.velocity_mps = truly(state.velocity());
  track.own_ship = antenna_.own_ship;
  const PlanePoint from_own = place - own_place_;
  track.range_m = length_of(from_own);
  track.bearing = TrueBearing::from(degrees(bearing_of(from_own) - north_deg_));
  track.relative_velocity_mps = truly(state.velocity() - own_motion_.velocity_mps());
  const MotionMatrix& p = state.covariance;
  track.place_sigma_m = std::sqrt(std::max(p(0, 0), p(1, 1)));
  track.velocity_sigma_mps = std::sqrt(std::max(p(2, 2), p(3, 3)));
  track.length_m = target.length_m();
  track.width_m = target.width_m();
  track.first_seen = target.first_seen();
  track.last_seen = target.last_seen();
  track.looks = static_cast<std::uint8_t>(target.looks());
  track.hits = static_cast<std::uint8_t>(target.hits());
  track.by_hand = followed.by_hand;
  return track;
}

}  // namespace skerry::server
