// NavigationTalker: what an output says, and when.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "protocol/nmea/ais_messages.hpp"
#include "protocol/wire/radar.pb.h"
#include "server/core/traffic.hpp"
#include "server/navigation/alert_talker.hpp"
#include "server/navigation/navigation_plan.hpp"
#include "server/navigation/told_targets.hpp"
#include "server/navigation/track_table.hpp"

namespace skerry::server {

// The present state that a talker reports.  Asked only for what is due.
class NavigationWorld {
 public:
  virtual ~NavigationWorld() = default;
  virtual wire::OwnShip own_ship() const = 0;
  virtual wire::Settings settings() const = 0;
  virtual std::vector<TrafficItem> traffic() const = 0;  // without own ship herself
  // What the radar's plotter has; nullptr if nothing yet.
  virtual std::shared_ptr<const wire::TargetList> targets() const = 0;
};

// Sentences with CR LF that belong together.
struct NavigationMessage {
  NavigationSentence sentence = NavigationSentence::rmc;
  std::vector<std::string> lines;
};

// Each sentence is due once per period, counted from its first time: lateness does not add up, and
// what was missed is left out.  The AIS of a ship begins at a moment of its own within her
// interval, so that not all report at once; what is around is looked at every kTrafficStep. No
// clock, no sockets.  Thread: one at a time.
class NavigationTalker {
 public:
  static constexpr Duration kTrafficStep = std::chrono::milliseconds(100);
  // Ships and marks whose AIS is told, at most; the nearest.
  static constexpr std::size_t kMostAis = 1000;

  // Requires a plan without fault.
  explicit NavigationTalker(const NavigationPlan& plan);

  // All that is due; `now` is of any steady clock and does not go back.
  std::vector<NavigationMessage> due(ScenarioTime now, const NavigationWorld& world);
  // When due() has something to do again.  Requires that it has been called.
  ScenarioTime next_due() const;

 private:
  // When an AIS station speaks next.
  struct Station {
    ScenarioTime position{}, fixed{};
  };
  void say_ais(ScenarioTime now, const wire::OwnShip& own, const std::vector<TrafficItem>& traffic,
               std::vector<NavigationMessage>& out);
  void say_own_ais(ScenarioTime now, const wire::OwnShip& own, std::vector<NavigationMessage>& out);
  void add_ais(NavigationSentence sentence, const nmea::AisMessage& message,
               std::vector<NavigationMessage>& out);
  std::uint32_t own_mmsi(const wire::OwnShip& own) const;

  // Of plan_.targets, as of now; and when that is.
  struct ToldNow {
    std::vector<ToldTarget> targets;
    UtcTime utc{};
  };
  ToldNow told_targets(ScenarioTime now, const NavigationWorld& world);

  NavigationPlan plan_;
  TrackTable tracks_;
  PlottedTargets plotted_;
  AlertTalker alerts_;
  bool begun_ = false;
  std::map<NavigationSentence, ScenarioTime> next_;  // of vdm: when to look at the traffic
  std::map<std::uint32_t, Station> stations_;        // by the scenario's number
  Station own_station_;
  unsigned ais_identifier_ = 0, ttd_identifier_ = 0;
  bool channel_b_ = false;
};

}  // namespace skerry::server
