// PictureReport for programs.
#pragma once

#include <string>

#include "echo/picture_tool/picture_report.hpp"

namespace skerry::echo {

// "kind,name,measure,value": of statistics first, first_spread, second and second_spread; of calls
// the AUC and its folds on either view.  What cannot be measured is empty.
std::string report_csv(const PictureReport& report);

// One object: names, beam_deg, statistics by key {first, first_spread, second, second_spread},
// calls by name {mask, all}, leaks, notes.  What cannot be measured is null.
std::string report_json(const PictureReport& report);

}  // namespace skerry::echo
