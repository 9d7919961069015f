// ExerciseEvents: what a scenario has happen by time, place or condition.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "server/config/config_error.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Each event happens once, at the first look at which all its conditions hold.  A copy is a
// snapshot.  Thread: one at a time.
class ExerciseEvents {
 public:
  static constexpr Duration kLook = std::chrono::seconds(1);  // of the exercise, between two looks

  // `scenario` must outlive it and have passed check_events().
  explicit ExerciseEvents(std::shared_ptr<const scenario::Scenario> scenario);

  bool is_empty() const { return happened_.empty(); }
  // The events that happen now, in the order of the scenario; each is given once.
  std::vector<const scenario::Event*> look(Duration now, const std::vector<ShipState>& own_ships,
                                           const std::vector<ShipState>& targets);
  // When an event of that name happened; nothing if it has not.
  std::optional<Duration> happened(const std::string& name) const;
  // For conditions: this ship has touched another, has run aground.
  void collided(const std::string& ship) { collided_.insert(ship); }
  void grounded(const std::string& ship) { grounded_.insert(ship); }

 private:
  // Where a ship of an event's conditions is found; nullptr if she is not on the water.
  const ShipState* find(const std::string& name, const std::vector<ShipState>& own_ships,
                        const std::vector<ShipState>& targets) const;
  bool holds(const scenario::Event& event, Duration now, const std::vector<ShipState>& own_ships,
             const std::vector<ShipState>& targets) const;

  std::shared_ptr<const scenario::Scenario> scenario_;
  std::vector<std::optional<Duration>> happened_;  // of each event
  std::set<std::string> collided_, grounded_;      // ships
};

// True if the position is within the area: a circle, or corners joined by straight lines.
bool is_within(const scenario::Area& area, GeoPoint position);

inline constexpr int kMaxEvents = 1000, kMaxAreas = 200, kMaxCorners = 200;

// Adds to the source what is wrong with events and areas: names that differ, names that are there,
// conditions that are complete.
void check_events(const scenario::Scenario& scenario, YamlSource& source);

}  // namespace skerry::server
