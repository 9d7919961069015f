// Which targets are under way: not pieces of land or rain that are seen here and there.
#include <algorithm>
#include <cmath>

#include "server/plotter/tracks/book.hpp"

namespace skerry::server {
namespace {

// What is asked of a target's Signs and of its motion.
struct Demand {
  double speeds = 1.0;  // of Rule::least_speed_kn
  double sure_speed;    // standard deviations of its speed
  double least_way_m;
  double lengths;  // of its echo, that it has gone
  double most_misfit;
  double most_old_ground;
  double unlike_m = 15.0;  // its echo's length may change by this
  double unlike_share;     // and this share of it
  unsigned hits_ever = 0, hits = 0;
  double age_s = 0.0;
};
// At sea; where other echoes that are no tracks are about; and where land or rain is.  Held by the
// scenes of the bench: on a coast, highlights of its slopes go along with own ship for a minute and
// fragments line up for half of one.
constexpr Demand kAtSea{.sure_speed = 4.0,
                        .least_way_m = 25.0,
                        .lengths = 1.0,
                        .most_misfit = 4.0,
                        .most_old_ground = 0.3,
                        .unlike_share = 0.15};
constexpr Demand kAmongEchoes{.sure_speed = 6.0,
                              .least_way_m = 60.0,
                              .lengths = 1.25,
                              .most_misfit = 2.5,
                              .most_old_ground = 0.15,
                              .unlike_share = 0.15,
                              .hits_ever = 8,
                              .hits = 6,
                              .age_s = 20.0};
constexpr Demand kInshore{.speeds = 1.5,
                          .sure_speed = 8.0,
                          .least_way_m = 150.0,
                          .lengths = 2.5,
                          .most_misfit = 2.5,
                          .most_old_ground = 0.05,
                          .unlike_share = 0.12,
                          .hits_ever = 12,
                          .hits = 6,
                          .age_s = 60.0};
// What is faster is rare, and chains of what is there by chance are fast.
constexpr double kFast_kn = 30.0;
constexpr unsigned kHitsOfFast = 8;

constexpr double kCompany_m = 400.0;     // of other echoes that are followed
constexpr double kFromLand_m = 12e3;     // of the middle of an extended echo
constexpr double kTurnsOfLand = 4.0;     // since when it was seen
constexpr long kLeastOfLand = 4;         // so many then: near ships run together, too
constexpr unsigned kSeenOften = 4;       // looks of the last ten
constexpr double kMostByStanding = 0.3;  // share of its plots

}  // namespace

bool Tracker::Book::is_under_way(const Target& target) const {
  const Demand& demand = is_inshore(target)        ? kInshore
                         : is_among_echoes(target) ? kAmongEchoes
                                                   : kAtSea;
  const MotionState& state = target.state();
  const double speed = length_of(state.velocity());
  const double sigma = std::sqrt(std::max(state.covariance(2, 2), state.covariance(3, 3)));
  const double way = length_of(state.place() - target.first_place());
  const double place_sigma = std::sqrt(std::max(state.covariance(0, 0), state.covariance(1, 1)));
  // The middle of an islet wanders as its aspect changes, but never by more than its own length.
  const double size = std::max(target.length_m(), target.width_m());
  if (speed <= demand.speeds * rule_.least_speed_kn * kKnot || speed <= demand.sure_speed * sigma ||
      way <= std::max({demand.least_way_m, 3.0 * place_sigma, demand.lengths * size})) {
    return false;
  }
  if (speed > kFast_kn * kKnot && target.hits_ever() < kHitsOfFast) return false;
  if (target.hits_ever() < demand.hits_ever || target.hits() < demand.hits ||
      in_seconds(target.last_seen() - target.first_seen()) < demand.age_s) {
    return false;
  }
  const Signs& signs = target.signs();
  return signs.misfit() <= demand.most_misfit && signs.old_ground() <= demand.most_old_ground &&
         signs.unlike_m() <= demand.unlike_m + demand.unlike_share * target.length_m();
}

bool Tracker::Book::is_among_echoes(const Target& target) const {
  if (target.signs().by_standing() > kMostByStanding) return true;
  const PlanePoint place = target.place_at(antenna_.time);
  return std::any_of(followed_.begin(), followed_.end(), [&](const Followed& other) {
    return &other.target != &target && other.number == 0 && other.target.hits() >= kSeenOften &&
           length_of(other.target.place_at(antenna_.time) - place) < kCompany_m;
  });
}

bool Tracker::Book::is_inshore(const Target& target) const {
  const PlanePoint place = target.place_at(antenna_.time);
  const auto count = std::count_if(extended_.begin(), extended_.end(), [&](const Extended& land) {
    return in_seconds(antenna_.time - land.time) < kTurnsOfLand * turn_s_ &&
           length_of(land.place - place) < kFromLand_m;
  });
  return count >= kLeastOfLand;
}

}  // namespace skerry::server
