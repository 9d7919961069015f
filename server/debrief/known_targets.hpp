// What sets knew of targets: the lists that a recording holds.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "protocol/recording/reader.hpp"
#include "protocol/wire/targets.pb.h"
#include "server/debrief/debrief.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Takes the lists of one view, whatever they say; numbers must be in range (bring_into_range()).
// Memory: the bounds below, however many lists.
// Thread: one at a time.
class KnownTargets {
 public:
  static constexpr std::size_t kMostTargets = 2000, kMostAlerts = 2000, kMostPlaces = 200'000;

  // Lists in the order of their times.
  void add(Moment now, const wire::TargetList& list);
  // Into a view whose names are left to the caller.
  KnownView finish();

 private:
  struct Open {
    std::size_t index = 0;  // of its row
    wire::AlertState state = wire::ALERT_ACTIVE;
    std::uint32_t target = 0;
  };
  using AlertKey = std::pair<std::uint32_t, std::uint32_t>;  // number, instance

  void take_targets(const wire::TargetList& list);
  void take(const wire::Target& target);
  void take_alerts(const wire::TargetList& list);
  void take(const wire::Alert& alert);
  void end(const AlertKey& key, const Open& open, bool is_target_there);
  void begin_anew();

  KnownView view_;
  std::map<std::uint32_t, std::size_t> told_;  // rows of those in the last list, by number
  std::map<AlertKey, Open> open_;              // told and not yet acknowledged
  std::map<AlertKey, std::size_t> done_;       // acknowledged, or left out
  std::size_t places_ = 0;
  std::map<std::size_t, double> placed_s_;  // of told rows: when the last place was taken
  std::uint64_t plots_ = 0;
  Moment now_;
};

// Of every view that has lists; those after `end_s` are left out.  `exercise_at`: the exercise's
// clock at a time on the air.
std::vector<KnownView> known_views(const recording::RecordingReader& reader, UtcTime epoch,
                                   double end_s, const scenario::Scenario& scenario,
                                   const std::function<double(double)>& exercise_at);

}  // namespace skerry::server
