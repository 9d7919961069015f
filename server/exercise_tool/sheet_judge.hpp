// Judges the checks of an exercise's sheet.
#pragma once

#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "protocol/video/scan.hpp"
#include "server/replay/exercise_replay.hpp"
#include "server/world/world.hpp"

namespace skerry::server {

struct CheckResult {
  struct Line {
    bool passed = false;
    std::string text;  // "sees Lyngen: level 190, ..."
  };
  const scenario::ExerciseCheck* check = nullptr;
  std::vector<Line> lines;
  bool passed() const;
};

// A checked turn, for those who draw it.
struct CheckedTurn {
  std::string radar;
  Scan scan;
};

// One check, with the exercise where it is now.  Makes video only if the check asks for some;
// `turn` (may be null) gets the first turn.
CheckResult judge(const scenario::ExerciseCheck& check, const ExercisePlan& plan,
                  const echo::ChartSource& chart, const World& world,
                  std::vector<CheckedTurn>* turn);

}  // namespace skerry::server
