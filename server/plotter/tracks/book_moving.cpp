// Which targets are under way: not pieces of land or rain that are seen here and there.
#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "server/plotter/tracks/book.hpp"

namespace skerry::server {
namespace {

// What is asked of a target's Signs and of its motion.
struct Demand {
  double sure_speed;  // standard deviations of its speed
  double least_way_m;
  double lengths;  // of its echo, that it has gone
  double most_misfit;
  double most_old_ground;
  double unlike_m = 15.0;  // its echo's length may change by this
  double unlike_share;     // and this share of it
  unsigned hits_ever = 0, hits = 0;
  double age_s = 0.0;
};
// At sea, and where other echoes that are no tracks are about.  Held by the scenes of the bench.
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

// Where land or rain is in sight, no single demand tells a ship from land: she too goes over ground
// on which echoes stood, and her echo is long where she passes a rock.  There each sign has a
// weight, and a target is under way if the sum is positive.  Fitted (logistic regression, then a
// search) to some 200,000 looks at 22,000 candidates of seven coasts, four scenes of ships in
// sounds and one of rain.
struct Weight {
  double weight, least, most;  // of the sign, and its bounds
  double of(double sign) const { return weight * std::clamp(sign, least, most); }
};
constexpr double kPrior = -4.0;
constexpr Weight kSureSpeed{1.1, 1.5, 6.5};   // log2 of its speed's standard deviations
constexpr Weight kLengths{0.3, -1.5, 4.5};    // log2 of lengths of its echo, and 25 m, gone
constexpr Weight kAge{-0.65, -0.5, 2.5};      // log2 of half minutes: for the same way, slower
constexpr Weight kSpeed{0.21, 0.0, 10.0};     // m/s
constexpr Weight kHits{0.225, 0.0, 10.0};     // of ten looks
constexpr Weight kMisfit{-1.45, 0.3, 5.0};    // Signs
constexpr Weight kOldGround{-2.3, 0.0, 1.0};  // share
constexpr Weight kUnlike{-1.4, 0.0, 4.0};     // of 15 m and 12 % of its length
constexpr Weight kLobe{-9.5, 0.0, 1.0};       // share
constexpr Weight kLand{-1.0, 0.0, 1.0};       // mean
constexpr Weight kOthers{-0.9, 1.0, 6.0};     // plots about that it might have been as well
constexpr Weight kUneven{-0.025, 0.0, 50.0};  // levels
// Younger ones are too little known to be weighed.
constexpr unsigned kHitsToWeigh = 8;
constexpr double kAgeToWeigh_s = 20.0;
constexpr double kByOwnShip_m = 250.0, kAlong_mps = 2.0;

// What is faster is rare, and chains of what is there by chance are fast.
constexpr double kFast_kn = 30.0;
constexpr unsigned kHitsOfFast = 8;

// Of other echoes that are followed; near own ship boats are small, and so is the way between them.
constexpr double kCompany_m = 400.0, kCompanyShare = 0.25;  // of the range, where that is less
constexpr double kFromLand_m = 12e3;                        // of the middle of an extended echo
constexpr double kTurnsOfLand = 4.0;                        // since when it was seen
constexpr long kLeastOfLand = 8;         // so many then: near ships run together, too
constexpr unsigned kSeenOften = 4;       // looks of the last ten
constexpr double kMostByStanding = 0.3;  // share of its plots

}  // namespace

bool Tracker::Book::is_under_way(const Target& target) const {
  const double speed = length_of(target.state().velocity());
  if (speed <= rule_.least_speed_kn * kKnot) return false;
  if (speed > kFast_kn * kKnot && target.hits_ever() < kHitsOfFast) return false;
  if (is_inshore(target)) return outweighs_land(target);
  return target.suspicion() <= kMostSuspicion &&
         (meets_demands(target, is_among_echoes(target)) || outweighs_land(target));
}

bool Tracker::Book::meets_demands(const Target& target, bool among_echoes) const {
  const Demand& demand = among_echoes ? kAmongEchoes : kAtSea;
  const MotionState& state = target.state();
  const double way = length_of(state.place() - target.first_place());
  const double place_sigma = std::sqrt(std::max(state.covariance(0, 0), state.covariance(1, 1)));
  // The middle of an islet wanders as its aspect changes, but never by more than its own length.
  const double size = std::max(target.length_m(), target.width_m());
  if (length_of(state.velocity()) <= demand.sure_speed * target.speed_sigma_mps() ||
      way <= std::max({demand.least_way_m, 3.0 * place_sigma, demand.lengths * size})) {
    return false;
  }
  if (target.hits_ever() < demand.hits_ever || target.hits() < demand.hits ||
      target.age_s() < demand.age_s) {
    return false;
  }
  const Signs& signs = target.signs();
  return signs.misfit() <= demand.most_misfit && signs.old_ground() <= demand.most_old_ground &&
         signs.unlike_m() <= demand.unlike_m + demand.unlike_share * target.length_m();
}

bool Tracker::Book::outweighs_land(const Target& target) const {
  // Echoes of own ship's own hull and lobes go along with her.
  if (length_of(target.place_at(antenna_.time) - own_place_) < kByOwnShip_m &&
      length_of(target.state().velocity() - own_motion_.velocity_mps()) < kAlong_mps) {
    return false;
  }
  if (target.hits_ever() < kHitsToWeigh || target.age_s() < kAgeToWeigh_s) return false;
  const MotionState& state = target.state();
  const double speed = length_of(state.velocity());
  const double way = length_of(state.place() - target.first_place());
  const double size = std::max(target.length_m(), target.width_m());
  const Signs& signs = target.signs();
  const auto log2_of = [](double x) { return echo::exact_log2(std::max(x, 1e-3)); };
  return kPrior + kSureSpeed.of(log2_of(speed / target.speed_sigma_mps())) +
             kLengths.of(log2_of(way / (size + 25.0))) + kAge.of(log2_of(target.age_s() / 30.0)) +
             kSpeed.of(speed) + kHits.of(target.hits()) + kMisfit.of(signs.misfit()) +
             kOldGround.of(signs.old_ground()) +
             kUnlike.of(signs.unlike_m() / (15.0 + 0.12 * target.length_m())) +
             kLobe.of(signs.lobe()) + kLand.of(signs.on_land()) + kOthers.of(signs.choice() - 1.0) +
             kUneven.of(signs.uneven()) >
         0.0;
}

bool Tracker::Book::is_among_echoes(const Target& target) const {
  if (target.signs().by_standing() > kMostByStanding) return true;
  const PlanePoint place = target.place_at(antenna_.time);
  const double company_m = std::min(kCompany_m, kCompanyShare * length_of(place - own_place_));
  return std::any_of(followed_.begin(), followed_.end(), [&](const Followed& other) {
    return &other.target != &target && other.number == 0 && other.target.hits() >= kSeenOften &&
           length_of(other.target.place_at(antenna_.time) - place) < company_m;
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
