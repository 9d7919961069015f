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
constexpr double kWait_deg = 60.0;  // behind the antenna: by then a plot is a target's or new
constexpr auto kLongestPause = std::chrono::seconds(60);
constexpr auto kLongestBack = std::chrono::seconds(1);  // a clock that is put right
// Beyond, a target is too little known to take a plot.  A plot may be some tenths of a second older
// than the step: at 75 kn 15 m, of which a gate has several times as much.
constexpr double kWidestGate_m = 800.0;
constexpr double kLongestUnseen_s = 120.0;
constexpr double kLongestStand_s = 2.0;  // of an antenna that stands still
constexpr std::size_t kMostPlotsOfOne = 16;
// Competing for plots at once; in clutter chains of rivals would have no end.
constexpr std::size_t kMostRivals = 48;
constexpr double kOnLand = 0.45;           // Plot::on_land; half is beside it
constexpr double kLongestLeap_m = 2000.0;  // of own ship, between two rows

bool is_on_earth(GeoPoint point) {
  return std::fabs(point.latitude_deg) <= 90.0 && std::fabs(point.longitude_deg) <= 180.0;
}

// Two such times have a difference.
bool is_in_time(ScenarioTime time) {
  constexpr auto kMost = std::chrono::hours(24 * 365 * 100);
  return time.time_since_epoch() < kMost && time.time_since_epoch() > -kMost;
}

// Of numbers that can be reckoned with; NaN is none.
bool is_sound(const Plot& plot) {
  const auto within = [](double value, double most) { return value >= 0.0 && value <= most; };
  return is_on_earth(plot.own_ship) && is_in_time(plot.time) && within(plot.range_m, 1e6) &&
         within(plot.range_sigma_m, 1e4) && within(plot.bearing_sigma_rad, 1.0) &&
         within(plot.length_m, 1e5) && within(plot.width_m, 1e5);
}

}  // namespace

// --- what comes

void Tracker::Book::add(const Plot& plot) {
  if (!plane_ || !is_sound(plot) || antenna_.time - plot.time > kLongestPause ||
      plot.time - antenna_.time > kLongestPause) {
    return;
  }
  // A wide echo is told long after its middle.
  const double late_deg = wrapped_deg((antenna_.bearing - plot.bearing).in_degrees());
  if (late_deg > 0.0 && late_deg < 20.0) late_deg_ = std::max(late_deg, 0.999 * late_deg_);
  suspects_.add(plot);
  if (plot.extended) {
    if (extended_.size() >= kMostExtended) extended_.pop_front();
    const PlacedPlot placed = place(plot);
    extended_.push_back({{placed.measured.place(0), placed.measured.place(1)}, plot.time});
  }
  if (plot.extended || plot.range_m > rule_.furthest_nm * 1852.0) return;
  ++counts_.plots;
  if (open_.size() >= kMostPlots) {
    ++counts_.left_out;
    return;
  }
  open_.push_back({place(plot), false});
}

void Tracker::Book::pass(const AntennaPass& antenna) {
  if (!is_on_earth(antenna.own_ship) || !is_in_time(antenna.time)) return;
  const bool first = !plane_;
  const auto pause = antenna.time - antenna_.time;
  const bool leapt =
      plane_ && (pause < -kLongestBack || pause > kLongestPause ||
                 length_of(plane_->to_plane(antenna.own_ship) - own_place_) > kLongestLeap_m);
  if (!plane_ || leapt) {
    if (leapt) ++counts_.resets;
    begin(antenna);
  } else {
    const double gone = wrapped_deg((antenna.bearing - antenna_.bearing).in_degrees());
    if (std::fabs(gone) > 2.0 * antenna.width_rad * kDegreesPerRadian + 0.01) gap_ = true;
  }
  const ScenarioTime reached =
      first || leapt || antenna.time > antenna_.time ? antenna.time : antenna_.time;
  antenna_ = antenna;
  antenna_.time = reached;
  own_place_ = plane_->to_plane(antenna.own_ship);
  if (plane_->is_far(own_place_)) {
    lay_plane_anew(antenna.own_ship);
    own_place_ = plane_->to_plane(antenna.own_ship);
  }
  north_deg_ = -plane_->true_less_plane_degrees(antenna.own_ship);
  own_motion_.take(own_place_, reached);
  const double bearing_deg = antenna.bearing.in_degrees();
  const double gone_deg = std::fabs(wrapped_deg(bearing_deg - stepped_deg_));
  const double gone_s = in_seconds(reached - stepped_);
  if (gone_deg < kStep_deg && gone_s < kLongestStand_s) return;
  if (gone_deg >= kStep_deg) {
    turn_s_ += 0.05 * (std::clamp(gone_s * 360.0 / gone_deg, 0.5, 120.0) - turn_s_);
  }
  stepped_deg_ = bearing_deg;
  stepped_ = reached;
  step();
  gap_ = false;
}

// What lies on land, or may be another echo's doing, begins no track by itself.
void Tracker::Book::look_into(PlacedPlot& placed) const {
  placed.causes = suspects_.causes_of(placed.plot);
  const bool echoed = suspects_.is_echo_of_a_cause(placed.plot);
  placed.lobe = echoed || placed.causes.count > 0;
  placed.suspect = echoed || suspects_.is_of_a_ring(placed.plot) || placed.plot.on_land > kOnLand;
}

// --- a step

void Tracker::Book::step() {
  false_plots_.pass(antenna_.bearing.in_degrees());
  sights_.clear();
  for (Followed& followed : followed_) sights_.push_back(look_for(followed));
  sort_by_east();
  resolve();
  begin_new_ones();
  drop_gone_ones();
}

Tracker::Book::Sight Tracker::Book::look_for(Followed& followed) {
  Target& target = followed.target;
  const PlanePoint place = target.expected_at(antenna_.time);
  const double range_m = length_of(place - own_place_);
  const double unseen_s = in_seconds(antenna_.time - target.last_seen());
  const double widest_m = std::max(kWidestGate_m, 1.5 * rule_.fastest_kn * kKnot * turn_s_);
  const Sight sight{place, std::min(target.gate_m(antenna_.time), widest_m), off_deg(place)};
  // What is not seen for long is lost, also where it could not be seen.
  if (unseen_s > std::max(kLongestUnseen_s, 12.0 * turn_s_)) followed.gone = true;
  // Until the antenna has passed all of it, and the plot is complete.
  const double hull_m = 0.5 * std::max(target.length_m(), target.width_m());
  const double across_deg =
      (sight.gate_m + hull_m) / std::max(range_m, 1.0) * kDegreesPerRadian + late_deg_ + 2.0;
  const bool blind = gap_ || range_m > antenna_.reach_m || range_m < 20.0;
  if (!followed.look.pass(sight.off_deg, std::min(across_deg, Look::kMostHalf_deg), blind)) {
    return sight;
  }
  // When the antenna was there, or about: plots of it say the time themselves.
  target.go_on(antenna_.time);
  const double true_deg = antenna_.bearing.in_degrees() - sight.off_deg;
  followed.false_per_m2 =
      false_plots_.density_per_m2(range_m, true_deg - 360.0 * std::floor(true_deg / 360.0));
  return sight;
}

void Tracker::Book::sort_by_east() {
  targets_by_east_.clear();
  plots_by_east_.clear();
  widest_gate_m_ = 0.0;
  for (std::size_t k = 0; k < sights_.size(); ++k) {
    const Sight& sight = sights_[k];
    // One that the antenna will only come to has its own plots ahead.
    if (!followed_[k].look.is_over() && std::fabs(sight.off_deg) > kWait_deg) continue;
    targets_by_east_.push_back({sight.place.east_m, sight.place.north_m, sight.gate_m, k});
    widest_gate_m_ = std::max(widest_gate_m_, sight.gate_m);
  }
  for (std::size_t p = 0; p < open_.size(); ++p) {
    const PlaceVector& place = open_[p].placed.measured.place;
    plots_by_east_.push_back({place(0), place(1), 0.0, p});
  }
  const auto by_east = [](const Placed& a, const Placed& b) {
    return a.east_m < b.east_m || (a.east_m == b.east_m && a.index < b.index);
  };
  std::sort(targets_by_east_.begin(), targets_by_east_.end(), by_east);
  std::sort(plots_by_east_.begin(), plots_by_east_.end(), by_east);
}

Tracker::Book::ByEast::const_iterator Tracker::Book::first_from(const ByEast& list, double east_m) {
  return std::lower_bound(list.begin(), list.end(), east_m,
                          [](const Placed& one, double east) { return one.east_m < east; });
}

void Tracker::Book::Marks::clear(std::size_t size) {
  if (marks_.size() < size) marks_.resize(size);
  if (++now_ != 0) return;
  std::fill(marks_.begin(), marks_.end(), 0);
  now_ = 1;
}

bool Tracker::Book::Marks::put(std::size_t one) {
  if (marks_[one] == now_) return false;
  marks_[one] = now_;
  return true;
}

// Those whose look is over, with all that compete with them for plots; a rival that the antenna has
// not passed yet is waited for.
void Tracker::Book::resolve() {
  for (std::size_t k = 0; k < followed_.size(); ++k) {
    if (!followed_[k].look.is_over()) continue;
    const bool may_wait = sights_[k].off_deg < kWait_deg - 2.0 * kStep_deg;
    if (!find_rivals_of(k, may_wait)) continue;
    std::erase_if(rivals_.targets, [&](std::size_t i) { return !followed_[i].look.is_over(); });
    decide(rivals_.targets, rivals_.plots);
  }
}

// Plots within the gate, the nearest of them if there are many; rising.
void Tracker::Book::find_plots_near(const Sight& sight) {
  by_distance_.clear();
  const double end_m = sight.place.east_m + sight.gate_m;
  for (auto at = first_from(plots_by_east_, sight.place.east_m - sight.gate_m);
       at != plots_by_east_.end() && at->east_m < end_m; ++at) {
    const PlanePoint off = PlanePoint{at->east_m, at->north_m} - sight.place;
    if (std::fabs(off.north_m) >= sight.gate_m || open_[at->index].taken) continue;
    by_distance_.emplace_back(dot(off, off), at->index);
  }
  if (by_distance_.size() > kMostPlotsOfOne) {
    std::nth_element(by_distance_.begin(), by_distance_.begin() + kMostPlotsOfOne,
                     by_distance_.end());
    by_distance_.resize(kMostPlotsOfOne);
  }
  near_.clear();
  for (const auto& [distance2, plot] : by_distance_) near_.push_back(plot);
  std::sort(near_.begin(), near_.end());
}

// The targets that share plots with `first`, it included, and those plots.  With more than
// kMostRivals plots it stops: those that are left decide among themselves, over what is left.
// False if it may wait, and one of them is to be waited for.
bool Tracker::Book::find_rivals_of(std::size_t first, bool may_wait) {
  rivals_.targets.clear();
  rivals_.plots.clear();
  choices_.resize(followed_.size());
  known_targets_.clear(followed_.size());
  known_plots_.clear(open_.size());
  waiting_.assign(1, first);
  known_targets_.put(first);
  for (std::size_t next = 0; next < waiting_.size() && rivals_.plots.size() < kMostRivals; ++next) {
    const std::size_t who = waiting_[next];
    if (may_wait && !followed_[who].look.is_over()) return false;
    find_plots_near(sights_[who]);
    choices_[who] = near_.size();
    rivals_.targets.push_back(who);
    for (const std::size_t p : near_) {
      if (!known_plots_.put(p)) continue;
      rivals_.plots.push_back(p);
      const PlaceVector& place = open_[p].placed.measured.place;
      for (auto other = first_from(targets_by_east_, place(0) - widest_gate_m_);
           other != targets_by_east_.end() && other->east_m < place(0) + widest_gate_m_ &&
           waiting_.size() < kMostRivals;
           ++other) {
        if (std::fabs(other->east_m - place(0)) < other->gate_m &&
            std::fabs(other->north_m - place(1)) < other->gate_m &&
            known_targets_.put(other->index)) {
          waiting_.push_back(other->index);
        }
      }
    }
  }
  std::sort(rivals_.targets.begin(), rivals_.targets.end());
  std::sort(rivals_.plots.begin(), rivals_.plots.end());
  return true;
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
  const std::vector<std::size_t> shared = shared_plots(who, plots, pairs);
  for (std::size_t i = 0; i < who.size(); ++i) {
    Followed& followed = followed_[who[i]];
    if (shared[i] != kUnpaired) {
      Open& open = open_[plots[shared[i]]];
      open.taken = true;
      followed.target.share(open.placed);
    } else if (pairs[i] != kUnpaired) {
      Open& open = open_[plots[pairs[i]]];
      open.taken = true;
      take(followed, open.placed, density, choices_[who[i]]);
    } else if (followed.look.could_see()) {
      followed.target.miss();
    }
    followed.look.done();
    judge(followed);
    join_duplicates_of(who[i]);
    leave_out_if_echoed(who[i]);
  }
}

void Tracker::Book::take(Followed& followed, PlacedPlot& placed, double density,
                         std::size_t choice) {
  look_into(placed);
  placed.choice = static_cast<double>(choice);
  ++counts_.paired;
  // Whether it is a target is not known yet: it counts as there by chance, so that what comes again
  // and again out of the sea does not speak for itself.
  if (followed.number == 0) false_plots_.add(placed.plot.range_m, placed.plot.bearing.in_degrees());
  placed.on_old_ground = followed.target.is_on_old_ground(placed, turn_s_);
  followed.target.see(placed, density);
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
    look_into(open.placed);
    followed_.push_back({.target = Target(open.placed, rule_.fastest_kn * kKnot), .look = {}});
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

}  // namespace skerry::server
