// make_debrief(): sails a recorded exercise again and notes what happens.
#pragma once

#include <functional>
#include <optional>

#include "protocol/recording/reader.hpp"
#include "server/debrief/debrief.hpp"
#include "server/replay/exercise_replay.hpp"
#include "server/replay/recorded_exercise.hpp"

namespace skerry::server {

struct DebriefOptions {
  DebriefLimits limits;
  std::optional<double> until_s;  // on the air; without, the recording's end
  // Judges a check of the exercise's sheet, with the world where it is then; null: none is judged.
  std::function<JudgedCheck(const scenario::ExerciseCheck&, const World&)> judge;
};

// The world is remade by the recorded inputs, so everything is the truth to the last bit.
// `progress` gets the share done, 0 .. 1, and what is being done; false gives up, which gives
// nothing. Error: that of length_to_replay().
using DebriefProgress = std::function<bool(double, const char*)>;
std::optional<Debrief> make_debrief(const recording::RecordingReader& reader,
                                    const RecordedExercise& exercise, const ExercisePlan& plan,
                                    const DebriefOptions& options, const DebriefProgress& progress);

}  // namespace skerry::server
