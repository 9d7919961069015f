#include "server/plotter/tracks/book.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "server/plotter/assignment/assignment.hpp"
#include "server/plotter/tracks/pairing.hpp"

namespace skerry::server {
namespace {

constexpr double kStep_deg = 5.0;   // of the antenna, between looks around
constexpr double kGap_deg = 4.0;    // no row of spokes is as wide
constexpr double kWait_deg = 60.0;  // behind the antenna: by then a plot is a target's or new
constexpr auto kLongestPause = std::chrono::seconds(60);
constexpr double kLongestLeap_m = 2000.0;  // of own ship, between two rows
constexpr double kMps = 1852.0 / 3600.0;   // of a knot

double wrapped_deg(double degrees) {
  while (degrees >= 180.0) degrees -= 360.0;
  while (degrees < -180.0) degrees += 360.0;
  return degrees;
}

}  // namespace

// --- where things are

void Tracker::Book::begin(const AntennaPass& antenna) {
  for (const Followed& followed : followed_) {
    if (followed.number != 0) lost_.push_back(track_of(followed, TrackStatus::lost));
  }
  followed_.clear();
  open_.clear();
  false_plots_ = {};
  shown_ = 0;
  plane_.emplace(antenna.own_ship);
  own_motion_.start(plane_->to_plane(antenna.own_ship), antenna.time);
  stepped_deg_ = antenna.bearing.in_degrees();
  gap_ = true;
}

void Tracker::Book::lay_plane_anew(GeoPoint anchor) {
  const GroundPlane before = *plane_;
  plane_.emplace(anchor);
  const auto moved = [&](PlanePoint place) { return plane_->to_plane(before.to_geo(place)); };
  // The new plane's north is turned against the old one's by as much as the meridians converge.
  const double turn_deg = before.true_less_plane_degrees(anchor);
  const echo::SinCos turn = echo::sin_cos_degrees(turn_deg);
  MotionMatrix turning = MotionMatrix::Identity();
  for (const int at : {0, 2}) {
    turning(at, at) = turning(at + 1, at + 1) = turn.cos;
    turning(at, at + 1) = turn.sin;
    turning(at + 1, at) = -turn.sin;
  }
  const auto change = [&](MotionState& state) {
    const PlanePoint place = moved(state.place());
    state.mean = turning * state.mean;
    state.mean(0) = place.east_m;
    state.mean(1) = place.north_m;
    state.covariance = turning * state.covariance * turning.transpose();
  };
  for (Followed& followed : followed_) {
    followed.target.change(change);
    followed.target.move_first_place(moved(followed.target.first_place()));
  }
  own_motion_.change(change);
  for (Open& open : open_) open.placed = place(open.placed.plot);
}

PlacedPlot Tracker::Book::place(const Plot& plot) const {
  const PlanePoint own = plane_->to_plane(plot.own_ship);
  const double plane_deg =
      plot.bearing.in_degrees() - plane_->true_less_plane_degrees(plot.own_ship);
  const echo::SinCos along = echo::sin_cos_degrees(plane_deg);
  PlacedPlot placed{plot, {}};
  placed.measured.place = {own.east_m + plot.range_m * along.sin,
                           own.north_m + plot.range_m * along.cos};
  const double floor_rad = rule_.bearing_sigma_deg / kDegreesPerRadian;
  // A hull glints along itself: a twelfth of what is seen of it is the variance of anywhere on it.
  const double range2 = plot.range_sigma_m * plot.range_sigma_m +
                        rule_.range_sigma_m * rule_.range_sigma_m +
                        plot.length_m * plot.length_m / 48.0;
  const double across2 = (plot.bearing_sigma_rad * plot.bearing_sigma_rad + floor_rad * floor_rad) *
                             plot.range_m * plot.range_m +
                         rule_.range_sigma_m * rule_.range_sigma_m / 4.0 +
                         plot.width_m * plot.width_m / 48.0;
  PlaceMatrix& r = placed.measured.covariance;
  r(0, 0) = range2 * along.sin * along.sin + across2 * along.cos * along.cos;
  r(1, 1) = range2 * along.cos * along.cos + across2 * along.sin * along.sin;
  r(0, 1) = r(1, 0) = (range2 - across2) * along.sin * along.cos;
  return placed;
}

// Degrees in the plane.
double Tracker::Book::bearing_of(PlanePoint from_own) const {
  const double degrees = echo::exact_atan2(from_own.east_m, from_own.north_m) * kDegreesPerRadian;
  return degrees < 0.0 ? degrees + 360.0 : degrees;
}

double Tracker::Book::off_deg(PlanePoint place) const {
  return wrapped_deg(antenna_.bearing.in_degrees() + north_deg_ - bearing_of(place - own_place_));
}

// --- what comes

void Tracker::Book::add(const Plot& plot) {
  if (!plane_ || plot.extended || !(plot.range_m <= rule_.furthest_nm * 1852.0)) return;
  ++counts_.plots;
  if (open_.size() >= kMostPlots) {
    ++counts_.left_out;
    return;
  }
  open_.push_back({place(plot), false});
}

void Tracker::Book::pass(const AntennaPass& antenna) {
  const auto pause = antenna.time - antenna_.time;
  const bool leapt =
      plane_ && (pause < Duration::zero() || pause > kLongestPause ||
                 length_of(plane_->to_plane(antenna.own_ship) - own_place_) > kLongestLeap_m);
  if (!plane_ || leapt) {
    if (leapt) ++counts_.resets;
    begin(antenna);
  } else {
    const double gone = wrapped_deg((antenna.bearing - antenna_.bearing).in_degrees());
    if (std::fabs(gone) > kGap_deg) gap_ = true;
  }
  antenna_ = antenna;
  own_place_ = plane_->to_plane(antenna.own_ship);
  if (plane_->is_far(own_place_)) {
    lay_plane_anew(antenna.own_ship);
    own_place_ = plane_->to_plane(antenna.own_ship);
  }
  north_deg_ = -plane_->true_less_plane_degrees(antenna.own_ship);
  own_motion_.take(own_place_, antenna.time);
  const double bearing_deg = antenna.bearing.in_degrees();
  if (std::fabs(wrapped_deg(bearing_deg - stepped_deg_)) < kStep_deg) return;
  stepped_deg_ = bearing_deg;
  step();
  gap_ = false;
}

// --- a step

void Tracker::Book::step() {
  false_plots_.pass(antenna_.bearing.in_degrees());
  for (Followed& followed : followed_) look_for(followed);
  resolve();
  begin_new_ones();
  drop_gone_ones();
}

void Tracker::Book::look_for(Followed& followed) {
  const PlanePoint place = followed.target.place_at(antenna_.time);
  const PlanePoint from_own = place - own_place_;
  const double range_m = length_of(from_own);
  const double off = off_deg(place);
  // Until the antenna has passed all of it, and the plot is complete.
  const double hull_m = 0.5 * std::max(followed.target.length_m(), followed.target.width_m());
  const double across_deg =
      (followed.target.gate_m() + hull_m) / std::max(range_m, 1.0) * kDegreesPerRadian + 3.0;
  const bool blind = gap_ || range_m > antenna_.reach_m || range_m < 20.0;
  if (!followed.look.pass(off, std::min(across_deg, Look::kMostHalf_deg), blind)) return;
  // When the antenna was there, or about: plots of it say the time themselves.
  followed.target.go_on(antenna_.time);
  const double true_deg = antenna_.bearing.in_degrees() - off;
  followed.false_per_m2 =
      false_plots_.density_per_m2(range_m, true_deg - 360.0 * std::floor(true_deg / 360.0));
}

// Those whose look is over, with all that compete with them for plots; a competitor that the
// antenna has not passed yet is waited for.
void Tracker::Book::resolve() {
  for (std::size_t i = 0; i < followed_.size(); ++i) {
    if (!followed_[i].look.is_over()) continue;
    std::vector<std::size_t> plots;
    const std::vector<std::size_t> who = competitors(i, plots);
    const bool waits =
        std::any_of(who.begin(), who.end(),
                    [&](std::size_t k) { return !followed_[k].look.is_over(); }) &&
        off_deg(followed_[i].target.place_at(antenna_.time)) < kWait_deg - 2.0 * kStep_deg;
    if (waits) continue;
    std::vector<std::size_t> ready;
    for (const std::size_t k : who) {
      if (followed_[k].look.is_over()) ready.push_back(k);
    }
    decide(ready, plots);
  }
}

// The targets that share plots with `first`, it included, and those plots, each in rising order.
std::vector<std::size_t> Tracker::Book::competitors(std::size_t first,
                                                    std::vector<std::size_t>& plots) const {
  std::vector<std::size_t> who{first};
  std::vector<bool> known(followed_.size()), used(open_.size());
  known[first] = true;
  const auto near = [&](const Followed& followed, const Open& open) {
    const PlanePoint place = followed.target.place_at(open.placed.plot.time);
    const double gate = followed.target.gate_m();
    const double east = open.placed.measured.place(0) - place.east_m;
    const double north = open.placed.measured.place(1) - place.north_m;
    return std::fabs(east) < gate && std::fabs(north) < gate;
  };
  for (std::size_t next = 0; next < who.size(); ++next) {
    for (std::size_t p = 0; p < open_.size(); ++p) {
      if (open_[p].taken || used[p] || !near(followed_[who[next]], open_[p])) continue;
      used[p] = true;
      plots.push_back(p);
      for (std::size_t k = 0; k < followed_.size(); ++k) {
        if (known[k] || !near(followed_[k], open_[p])) continue;
        // One that the antenna will only come to has its own plots ahead.
        const double off = off_deg(followed_[k].target.place_at(antenna_.time));
        if (!followed_[k].look.is_over() && std::fabs(off) > kWait_deg) continue;
        known[k] = true;
        who.push_back(k);
      }
    }
  }
  std::sort(who.begin(), who.end());
  std::sort(plots.begin(), plots.end());
  return who;
}

void Tracker::Book::decide(const std::vector<std::size_t>& who,
                           const std::vector<std::size_t>& plots) {
  std::vector<const Target*> targets;
  std::vector<const PlacedPlot*> placed;
  double density = 0.0;
  for (const std::size_t k : who) {
    targets.push_back(&followed_[k].target);
    density = std::max(density, followed_[k].false_per_m2);
  }
  for (const std::size_t p : plots) placed.push_back(&open_[p].placed);
  const auto pairs = pair_up(targets, placed, {.false_per_m2 = density});
  for (std::size_t i = 0; i < who.size(); ++i) {
    Followed& followed = followed_[who[i]];
    if (pairs[i] != kUnpaired) {
      Open& open = open_[plots[pairs[i]]];
      open.taken = true;
      ++counts_.paired;
      const Plot& plot = open.placed.plot;
      if (followed.target.hits_ever() < 4) {
        false_plots_.add(plot.range_m, plot.bearing.in_degrees());
      }
      followed.target.see(open.placed, density);
    } else if (followed.look.could_see()) {
      followed.target.miss();
    }
    followed.look.done();
    judge(followed);
  }
}

// --- what becomes of a target

void Tracker::Book::judge(Followed& followed) {
  const Target& target = followed.target;
  const bool old = target.hits_ever() >= 10 || followed.number != 0;
  // Held as long as it is seen in five turns of ten (MSC.192(79), 5.25.4.5), and somewhat longer.
  if (old ? target.looks() == 10 && target.hits() <= 2
          : target.misses_in_a_row() >= 3 || target.score_bits() < -6.0) {
    followed.gone = true;
    return;
  }
  if (followed.number == 0 && !followed.refused && deserves_a_track(followed)) show(followed);
}

bool Tracker::Book::deserves_a_track(const Followed& followed) const {
  const Target& target = followed.target;
  if (rule_.acquire == Acquire::none || target.hits_ever() < rule_.least_hits ||
      2 * target.hits() < target.looks() || target.score_bits() < rule_.sure_bits) {
    return false;
  }
  if (rule_.acquire == Acquire::all) return true;
  const MotionState& state = target.state();
  const double speed = length_of(state.velocity());
  const double sigma = std::sqrt(std::max(state.covariance(2, 2), state.covariance(3, 3)));
  const double way = length_of(state.place() - target.first_place());
  const double place_sigma = std::sqrt(std::max(state.covariance(0, 0), state.covariance(1, 1)));
  return speed > rule_.least_speed_kn * kMps && speed > 4.0 * sigma &&
         way > std::max(25.0, 5.0 * place_sigma);
}

void Tracker::Book::show(Followed& followed) {
  if (shown_ >= rule_.most_tracks) {
    ++counts_.left_out;
    return;
  }
  ++shown_;
  followed.number = ++numbers_;
}

// Plots that are no target's, and that no target can claim any more.
void Tracker::Book::begin_new_ones() {
  std::size_t kept = 0;
  for (std::size_t p = 0; p < open_.size(); ++p) {
    Open& open = open_[p];
    const PlanePoint place{open.placed.measured.place(0), open.placed.measured.place(1)};
    const double off = off_deg(place);
    // Behind by a sixth of a turn, or by so much more that it looks as if it were ahead.
    const bool old = antenna_.time - open.placed.plot.time > std::chrono::seconds(20);
    if (!old && !open.taken && off >= -kWait_deg && off < kWait_deg) {
      if (kept != p) open_[kept] = std::move(open);
      ++kept;
      continue;
    }
    if (open.taken || belongs_to_a_known_one(open.placed)) continue;
    false_plots_.add(open.placed.plot.range_m, open.placed.plot.bearing.in_degrees());
    if (followed_.size() >= kMostFollowed) {
      ++counts_.left_out;
      continue;
    }
    ++counts_.begun;
    followed_.push_back({.target = Target(open.placed, rule_.fastest_kn * kMps), .look = {}});
  }
  open_.resize(kept);
}

// A long ship shows as several echoes: what lies on its hull is no other ship.
bool Tracker::Book::belongs_to_a_known_one(const PlacedPlot& plot) const {
  const PlaceMatrix& r = plot.measured.covariance;
  const double sigma = std::sqrt(std::max(r(0, 0), r(1, 1)));
  for (const Followed& followed : followed_) {
    const Target& target = followed.target;
    if (target.hits_ever() < 5) continue;
    const PlanePoint place = target.place_at(plot.plot.time);
    const double reach = 20.0 + sigma + 0.5 * std::max(target.length_m(), target.width_m()) +
                         0.5 * std::max(plot.plot.length_m, plot.plot.width_m);
    const double east = plot.measured.place(0) - place.east_m;
    const double north = plot.measured.place(1) - place.north_m;
    if (east * east + north * north < reach * reach) return true;
  }
  return false;
}

void Tracker::Book::drop_gone_ones() {
  for (const Followed& followed : followed_) {
    if (!followed.gone || followed.number == 0) continue;
    lost_.push_back(track_of(followed, TrackStatus::lost));
    --shown_;
  }
  std::erase_if(followed_, [](const Followed& followed) { return followed.gone; });
}

// --- what is asked

std::uint32_t Tracker::Book::acquire(GeoPoint point, double within_m) {
  if (!plane_) return 0;
  const PlanePoint place = plane_->to_plane(point);
  Followed* nearest = nullptr;
  double least = within_m;
  for (Followed& followed : followed_) {
    const double off = length_of(followed.target.place_at(antenna_.time) - place);
    if (off > least || followed.target.hits_ever() < 2) continue;
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

std::vector<Track> Tracker::Book::tracks() const {
  std::vector<Track> tracks;
  for (const Followed& followed : followed_) {
    if (followed.number != 0) tracks.push_back(track_of(followed, TrackStatus::tracked));
  }
  std::sort(tracks.begin(), tracks.end(),
            [](const Track& a, const Track& b) { return a.number < b.number; });
  return tracks;
}

std::vector<Track> Tracker::Book::take_lost() { return std::exchange(lost_, {}); }

Tracker::Counts Tracker::Book::counts() const {
  Counts counts = counts_;
  counts.followed = followed_.size();
  return counts;
}

Track Tracker::Book::track_of(const Followed& followed, TrackStatus status) const {
  const Target& target = followed.target;
  const MotionState& state = target.state();
  const PlanePoint place = target.place_at(antenna_.time);
  const echo::SinCos north = echo::sin_cos_degrees(-north_deg_);
  const auto truly = [&](PlanePoint v) { return echo::turned(v, north); };
  Track track;
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
