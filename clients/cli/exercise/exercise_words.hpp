// An ExerciseState in words.
#pragma once

#include <string>
#include <vector>

#include "protocol/wire/exercise.pb.h"

namespace skerry::client {

// Tables of the clock, ships, snapshots and the newest marks.
std::string exercise_text(const wire::ExerciseState& state);

// What has changed but that ships move, a line each, each with the time of the exercise.
std::vector<std::string> exercise_changes(const wire::ExerciseState& before,
                                          const wire::ExerciseState& after);

}  // namespace skerry::client
