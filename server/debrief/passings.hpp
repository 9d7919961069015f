// Passings: how near ships came to each other, and how near they were about to come.
#pragma once

#include <cstddef>
#include <map>
#include <tuple>
#include <vector>

#include "server/debrief/debrief.hpp"

namespace skerry::server {

// The closest point of approach of two ships that keep course and speed.
struct ForecastCpa {
  double range_m = 0.0;
  double after_s = 0.0;  // negative: they have passed it
};
ForecastCpa forecast_cpa(const ShipState& own, const ShipState& other);

// Of each own ship with every other ship.  Between two looks both go straight: from looks 1 s apart
// the least range is right to about 1 % of the way that they make in that time.
// Thread: one at a time.
class Passings {
 public:
  explicit Passings(const DebriefLimits& limits) : limits_(limits) {}
  // The world some time later.
  void look(const WorldState& state, Moment now);
  // Those that came nearer than the limit, nearest first.
  std::vector<ShipPassing> nearest() const;

 private:
  struct Watched {
    ShipPassing passing;
    double closest_m2 = 0.0;
    double own_heading_deg = 0.0, other_heading_deg = 0.0;
    PlanePoint way;  // at the look before
    Moment looked;
    bool was_under = false;
  };
  void look(Watched& watched, const ShipState& own, const ShipState& other, Moment now,
            bool is_new);

  DebriefLimits limits_;
  std::map<std::tuple<std::size_t, bool, std::size_t>, Watched> watched_;
};

}  // namespace skerry::server
