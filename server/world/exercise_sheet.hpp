// What an exercise's sheet may name, and what is wrong with one.
#pragma once

#include "server/config/config_error.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

inline constexpr int kMaxSheetAnswers = 50, kMaxSheetChecks = 200;

// Gives a SART without a name "SART 1", by its place in the list.
void name_sarts(scenario::Scenario& scenario);

// Adds to the source what is wrong with `exercise`: names that are not there, a check that asks
// nothing or after the end.  Requires named SARTs and radars.
void check_sheet(const scenario::Scenario& scenario, YamlSource& source);

}  // namespace skerry::server
