// TrackTable: which targets a radar tracks, and under which numbers.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/core/traffic.hpp"
#include "server/navigation/target_geometry.hpp"

namespace skerry::server {

// A target as she really is: the tracker makes no errors.
struct Track {
  unsigned number = 0;  // 1 .. 99
  bool lost = false;    // then all else is as it was last
  TrafficItem target;
  TargetPlace place;
};

// Ships and boats, the nearest first.  A target keeps her number for as long as she is tracked: to
// kHysteresis times the range in which she was found, and even if another comes nearer.  A lost one
// is listed as lost for a while, so that every sentence can say so; then her number is free.
class TrackTable {
 public:
  static constexpr double kHysteresis = 1.1;

  TrackTable(double range_m, std::size_t most, Duration lost_for)
      : range_m_(range_m), most_(most), lost_for_(lost_for) {}

  // The tracks, ordered by number.
  std::vector<Track> update(GeoPoint own, std::span<const TrafficItem> traffic, ScenarioTime now);

 private:
  struct Kept {
    Track track;
    ScenarioTime lost_at{};
  };
  double range_m_;
  std::size_t most_;
  Duration lost_for_;
  std::map<unsigned, Kept> tracks_;  // by number
};

}  // namespace skerry::server
