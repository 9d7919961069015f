// PastPlaces: where a target was, at even distances of time.
#pragma once

#include <deque>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::server {

struct WasAt {
  GeoPoint place;            // true
  PlanePoint from_own_ship;  // relative, m east and north: of own ship as she was then
};

// Keeps a place every 15 s, for as long as the longest interval needs, so that another interval is
// told at once.
//
// Error: between two kept places it is a straight line: 6 m off for a ship that turns at 1 deg/s
// and goes 12 m/s.
class PastPlaces {
 public:
  static constexpr std::size_t kTold = 10;
  static constexpr Duration kGrain = std::chrono::seconds(15);
  static constexpr Duration kLongestInterval = std::chrono::seconds(360);
  static constexpr std::size_t kMostKept =
      static_cast<std::size_t>(kLongestInterval * static_cast<int>(kTold + 1) / kGrain) + 1;

  // `now` does not go back.
  void add(UtcTime now, const WasAt& was);
  // The newest first: at whole multiples of `interval` (UTC) before `now`, so that a dot stays
  // where it is; at most kTold.
  std::vector<WasAt> told(UtcTime now, Duration interval) const;
  void clear() { kept_.clear(); }

 private:
  struct Kept {
    UtcTime utc{};
    WasAt was;
  };
  WasAt at(UtcTime utc) const;
  std::deque<Kept> kept_;  // rising
};

}  // namespace skerry::server
