// Signs: what tells a target under way from pieces of land that are seen here and there.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace skerry::server {

// Means over the last ten plots or so, all of them at first.
class Signs {
 public:
  struct Sign {
    double misfit =
        0.0;  // distance from where a straight line has it, squared, in plots' own errors
    double unlike_m = 0.0;       // its length, off the mean of those before
    bool on_old_ground = false;  // an echo stood there before it can have been there
    bool by_standing = false;
    bool lobe = false;       // another echo's doing, perhaps
    double on_land = 0.0;    // Plot::on_land
    double choice = 1.0;     // plots it might have been
    std::uint8_t level = 0;  // the greatest
  };
  void take(const Sign& sign) {
    constexpr double kLeastShare = 0.1, kMostMisfit = 20.0, kMostChoice = 16.0;
    const double share = std::max(kLeastShare, 1.0 / (++taken_ + 1.0));
    const auto add = [&](double& mean, double now) { mean += (now - mean) * share; };
    add(misfit_, std::min(sign.misfit, kMostMisfit));
    add(unlike_m_, std::fabs(sign.unlike_m));
    add(old_ground_, sign.on_old_ground ? 1.0 : 0.0);
    add(by_standing_, sign.by_standing ? 1.0 : 0.0);
    add(lobe_, sign.lobe ? 1.0 : 0.0);
    add(on_land_, sign.on_land);
    add(choice_, std::min(sign.choice, kMostChoice));
    if (taken_ > 1) add(uneven_, std::fabs(sign.level - level_));
    add(level_, sign.level);
  }
  double misfit() const { return misfit_; }
  double unlike_m() const { return unlike_m_; }
  double old_ground() const { return old_ground_; }
  double by_standing() const { return by_standing_; }
  double lobe() const { return lobe_; }
  double on_land() const { return on_land_; }
  double choice() const { return choice_; }
  double uneven() const { return uneven_; }  // levels off their mean

 private:
  unsigned taken_ = 0;
  double misfit_ = 0.0, unlike_m_ = 0.0, old_ground_ = 0.0, by_standing_ = 0.0;
  double lobe_ = 0.0, on_land_ = 0.0, choice_ = 0.0, level_ = 0.0, uneven_ = 0.0;
};

}  // namespace skerry::server
