// Two targets of one ship: she shows as several echoes, and each was taken for a ship.
#include <algorithm>

#include "server/plotter/tracks/book.hpp"

namespace skerry::server {
namespace {

constexpr double kPiecesApart_m = 30.0;  // pieces of a hull
constexpr double kSameMotion_mps = 0.5;
constexpr double kSigmas = 2.0;       // of the velocity, beside that
constexpr unsigned kHitsToJoin = 8;   // before a motion is known
constexpr unsigned kLooksAsOne = 12;  // running, then they are one

}  // namespace

bool Tracker::Book::are_one(const Target& a, const Target& b) const {
  const auto size = [](const Target& t) { return std::max(t.length_m(), t.width_m()); };
  const double reach_m = 0.5 * (size(a) + size(b)) + kPiecesApart_m;
  if (length_of(a.place_at(antenna_.time) - b.place_at(antenna_.time)) > reach_m) return false;
  return length_of(a.state().velocity() - b.state().velocity()) <
         kSameMotion_mps + kSigmas * std::max(a.speed_sigma_mps(), b.speed_sigma_mps());
}

// The one with the older number stays, or the one that has been seen more often.  The other goes
// without being told as lost, as nobody is.
void Tracker::Book::join_duplicates_of(std::size_t who) {
  Followed& followed = followed_[who];
  if (followed.gone || followed.target.hits_ever() < kHitsToJoin) return;
  const double east = sights_[who].place.east_m;
  const auto is_before = [](const Followed& a, const Followed& b) {
    if ((a.number != 0) != (b.number != 0)) return a.number != 0;
    return a.number != 0 ? a.number < b.number : a.target.hits_ever() >= b.target.hits_ever();
  };
  const Followed* first = nullptr;  // whose duplicate it is
  constexpr double kFurthest_m = 400.0;
  auto at = std::lower_bound(targets_by_east_.begin(), targets_by_east_.end(),
                             std::pair<double, std::size_t>(east - kFurthest_m, 0));
  for (; at != targets_by_east_.end() && at->first < east + kFurthest_m; ++at) {
    const Followed& other = followed_[at->second];
    if (at->second == who || other.gone || other.target.hits_ever() < kHitsToJoin) continue;
    if (!is_before(other, followed) || !are_one(followed.target, other.target)) continue;
    if (first == nullptr || is_before(other, *first)) first = &other;
  }
  followed.as_one = first == nullptr ? 0 : followed.as_one + 1;
  if (followed.as_one < kLooksAsOne || followed.by_hand || followed.refused) return;
  followed.gone = true;
  if (followed.number == 0) return;
  --shown_;
  followed.number = 0;
}

}  // namespace skerry::server
