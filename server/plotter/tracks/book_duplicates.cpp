// Two targets of one ship, who shows as several echoes; two ships with one echo; and what turns out
// to be an echo's echo.
#include <algorithm>

#include "server/plotter/assignment/assignment.hpp"
#include "server/plotter/tracks/book.hpp"

namespace skerry::server {
namespace {

constexpr double kPiecesApart_m = 30.0;  // pieces of a hull
constexpr double kFurthest_m = 400.0;    // of the middles of hulls
constexpr double kSameMotion_mps = 0.5;
constexpr double kLeastMotion_mps = 1.5;  // of an echo's cause
constexpr double kSigmas = 2.0;           // of the velocity, beside that
constexpr unsigned kHitsToJoin = 8;       // before a motion is known
constexpr unsigned kLooksAsOne = 12;      // running, then they are one
constexpr unsigned kLooksEchoed = 12;     // running, then it is no target

// What a beam and a pulse join.
constexpr double kPulse_m = 60.0, kBeam_rad = 0.02;

}  // namespace

// Ships that come so near that they have one echo: if the one that is left without a plot may be in
// another's, both share it.  For each target the index of the plot that it shares, or kUnpaired.
std::vector<std::size_t> Tracker::Book::shared_plots(const std::vector<std::size_t>& who,
                                                     const std::vector<std::size_t>& plots,
                                                     const std::vector<std::size_t>& pairs) const {
  std::vector<std::size_t> shared(who.size(), kUnpaired);
  for (std::size_t i = 0; i < who.size(); ++i) {
    if (pairs[i] != kUnpaired) continue;
    double least = Target::kGate;
    std::size_t with = kUnpaired;
    for (std::size_t k = 0; k < who.size(); ++k) {
      if (pairs[k] == kUnpaired) continue;
      const PlacedPlot& plot = open_[plots[pairs[k]]].placed;
      if (!may_be_merged_into(followed_[who[i]], plot) ||
          !may_be_merged_into(followed_[who[k]], plot)) {
        continue;
      }
      const double distance2 = followed_[who[i]].target.off(plot).distance2;
      if (!(distance2 < least)) continue;
      least = distance2;
      with = k;
    }
    if (with != kUnpaired) shared[i] = shared[with] = pairs[with];
  }
  return shared;
}

bool Tracker::Book::may_be_merged_into(const Followed& followed, const PlacedPlot& plot) const {
  if (followed.number == 0 || !followed.target.may_share(plot.plot.time)) return false;
  const PlanePoint off = followed.target.place_at(plot.plot.time) -
                         PlanePoint{plot.measured.place(0), plot.measured.place(1)};
  return length_of(off) < kPulse_m + 0.5 * std::max(plot.plot.length_m, plot.plot.width_m) +
                              kBeam_rad * plot.plot.range_m;
}

bool Tracker::Book::are_one(const Target& a, const Target& b) const {
  const auto size = [](const Target& t) { return std::max(t.length_m(), t.width_m()); };
  const double reach_m = 0.5 * (size(a) + size(b)) + kPiecesApart_m;
  if (length_of(a.place_at(antenna_.time) - b.place_at(antenna_.time)) > reach_m) return false;
  return length_of(a.state().velocity() - b.state().velocity()) <
         kSameMotion_mps + kSigmas * std::max(a.speed_sigma_mps(), b.speed_sigma_mps());
}

// The one with the older number stays, or the one that has been seen more often.
void Tracker::Book::join_duplicates_of(std::size_t who) {
  Followed& followed = followed_[who];
  if (followed.gone || followed.target.hits_ever() < kHitsToJoin) return;
  const double east = sights_[who].place.east_m;
  const auto is_before = [](const Followed& a, const Followed& b) {
    if ((a.number != 0) != (b.number != 0)) return a.number != 0;
    return a.number != 0 ? a.number < b.number : a.target.hits_ever() >= b.target.hits_ever();
  };
  const Followed* first = nullptr;  // whose duplicate it is
  for (auto at = first_from(targets_by_east_, east - kFurthest_m);
       at != targets_by_east_.end() && at->east_m < east + kFurthest_m; ++at) {
    const Followed& other = followed_[at->index];
    if (at->index == who || other.gone || other.target.hits_ever() < kHitsToJoin) continue;
    if (!is_before(other, followed) || !are_one(followed.target, other.target)) continue;
    if (first == nullptr || is_before(other, *first)) first = &other;
  }
  followed.as_one = first == nullptr ? 0 : followed.as_one + 1;
  if (followed.as_one < kLooksAsOne || followed.by_hand || followed.refused) return;
  leave_out(followed);
}

// Own ship and the cause reflect it to and fro: it is so many times as far, and goes so many times
// as fast, both as own ship sees it.
bool Tracker::Book::is_echo_of(const Target& echo, const Target& cause, double times) const {
  const auto from_own = [&](const Target& t) { return t.place_at(antenna_.time) - own_place_; };
  const PlanePoint off = from_own(echo) * (1.0 / times) - from_own(cause);
  if (length_of(off) > 0.5 * std::max(cause.length_m(), cause.width_m()) + kPiecesApart_m)
    return false;
  const auto relative = [&](const Target& t) {
    return t.state().velocity() - own_motion_.velocity_mps();
  };
  // Of what does not move, a ship at twice another's range stays there, too.
  if (length_of(relative(cause)) < kLeastMotion_mps) return false;
  return length_of(relative(echo) * (1.0 / times) - relative(cause)) <
         kSameMotion_mps +
             kSigmas * std::max(echo.speed_sigma_mps() / times, cause.speed_sigma_mps());
}

// It is acquired while its cause has no plot of its own, as in rain or before a shore.
void Tracker::Book::leave_out_if_echoed(std::size_t who) {
  Followed& followed = followed_[who];
  if (followed.gone || followed.target.hits_ever() < kHitsToJoin) return;
  bool is_echo = false;
  for (const double times : {2.0, 3.0}) {
    const double east = own_place_.east_m + (sights_[who].place.east_m - own_place_.east_m) / times;
    for (auto at = first_from(targets_by_east_, east - kFurthest_m);
         at != targets_by_east_.end() && at->east_m < east + kFurthest_m && !is_echo; ++at) {
      const Followed& other = followed_[at->index];
      is_echo = at->index != who && !other.gone && other.target.hits_ever() >= kHitsToJoin &&
                is_echo_of(followed.target, other.target, times);
    }
  }
  followed.as_echo = is_echo ? followed.as_echo + 1 : 0;
  if (followed.as_echo < kLooksEchoed || followed.by_hand || followed.refused) return;
  leave_out(followed);
}

// Without being told as lost, as nobody is.
void Tracker::Book::leave_out(Followed& followed) {
  followed.gone = true;
  if (followed.number == 0) return;
  --shown_;
  followed.number = 0;
}

}  // namespace skerry::server
