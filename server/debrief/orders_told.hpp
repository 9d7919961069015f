// What was ordered in an exercise, in words.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "server/debrief/debrief.hpp"
#include "server/replay/recorded_exercise.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// The lines of an input; `when` and whom it is about are filled in.  None of fixes, and of orders
// that the world tells as marks itself (texts, marks, groundings).
std::vector<HappenedLine> lines_of(const recording::Input& input, Moment when,
                                   const scenario::Scenario& scenario);

// Radars by number, as a scenario has them aboard its own ships.
struct RadarAboard {
  std::string name;
  std::size_t own_ship = 0;
};
std::vector<RadarAboard> radars_aboard(const scenario::Scenario& scenario);

// The lines of all changes of radars' and consoles' settings that the recording holds.  `epoch`:
// the scenario's time 0; exercise_s is left at 0.
std::vector<HappenedLine> setting_lines(const recording::RecordingReader& reader, UtcTime epoch,
                                        const scenario::Scenario& scenario);

// What each own ship did after what called for it: events, texts, faults, and the first time that
// a CPA was forecast to be too small.  `happened` by time.
std::vector<Reaction> reactions_to(const std::vector<HappenedLine>& happened,
                                   const std::vector<ShipPassing>& passings,
                                   const std::vector<ShipTrack>& own_ships);

}  // namespace skerry::server
