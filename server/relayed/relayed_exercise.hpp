// The exercise of a recording, as instructors are told of it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "protocol/wire/exercise.pb.h"
#include "server/core/traffic.hpp"

namespace skerry::server {

// Octets of a state that is sent, so that its frame stays below kMaxServerFrame.
inline constexpr std::size_t kMostExercise = 900'000;

// A recorded state, whose numbers are in range, as one that can be told: radars get the numbers of
// the playback (`radars`: by recorded number; others are left out), what could be ordered (undo,
// snapshots) is gone, and of one that is too long the routes are, then the last ships.
void make_tellable(wire::ExerciseState& state,
                   const std::map<std::uint32_t, std::uint32_t>& radars);

// Ships and clock `since_s` of real time later, on straight lines, at the exercise's pace; of one
// that is frozen nothing moves.  For some seconds: a ship that turns is off by half her turn rate
// times her speed times the square of the time, 1 m in 1 s at 10 kn and 20 deg/min.
void sail_on(wire::ExerciseState& state, double since_s);

// What a recording without states of the exercise still tells by its traffic: ships and boats, own
// ships first, numbered as there; clock and pace are the recording's.
wire::ExerciseState exercise_of_traffic(const std::vector<TrafficItem>& items, double position_s);

}  // namespace skerry::server
