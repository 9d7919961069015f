// ToldTarget: a tracked target as sentences tell it, plotted or true.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/geo_point.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/own_ship.pb.h"
#include "protocol/wire/targets.pb.h"
#include "server/navigation/track_table.hpp"

namespace skerry::server {

struct ToldTarget {
  enum class Status : std::uint8_t { acquiring, tracking, alarm, alarm_acknowledged, lost };

  unsigned number = 0;  // 1 .. 99
  std::string label;    // what the operator calls it, if not by that number
  Status status = Status::tracking;
  GeoPoint place;
  double range_m = 0.0;
  double bearing_deg = 0.0;  // true
  // Absent: not known yet, or not at all.
  std::optional<double> course_deg, speed_mps;  // true
  bool through_water = false;                   // those; else over ground
  std::optional<double> heading_deg;            // true
  std::optional<double> cpa_m, tcpa_s;          // negative: past
  std::string name;
  bool by_hand = false, is_reference = false, is_test = false;
};

// As they really are.
std::vector<ToldTarget> true_targets(const std::vector<Track>& tracks, const wire::OwnShip& ship);

// What a plotter has, under numbers that every display can show: its own up to 99, others a number
// that is free and stays theirs.  A target that is lost, or has been cancelled, is told as lost for
// a while, so that every sentence can say so.
class PlottedTargets {
 public:
  // At most `most` (1 .. 99) within `range_m`, the nearest; dangerous ones before all others.
  PlottedTargets(double range_m, std::size_t most, Duration lost_for)
      : range_m_(range_m), most_(most), lost_for_(lost_for) {}

  // By number.  `now` does not go back.
  std::vector<ToldTarget> update(const wire::TargetList& list, ScenarioTime now);

 private:
  static constexpr unsigned kMostNumber = 99;
  struct Kept {
    std::uint32_t plotted = 0;  // its number in lists
    ToldTarget told;
    bool seen = false;
    std::optional<ScenarioTime> lost_at;
  };
  Kept* kept_of(std::uint32_t plotted);
  // nullptr: no number is free.
  Kept* give_number(std::uint32_t plotted);

  double range_m_;
  std::size_t most_;
  Duration lost_for_;
  std::map<unsigned, Kept> kept_;  // by the number told
};

}  // namespace skerry::server
