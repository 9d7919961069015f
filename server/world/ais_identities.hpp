// Who is who in AIS: the numbers of ships and marks that a scenario does not number itself.
#pragma once

#include "server/world/scenario.pb.h"

namespace skerry::server {

// Gives an MMSI to every own ship, target and racon without one, the same in every run.  Source of
// the form: ITU-R M.585-9; the country is Norway (257), aids to navigation begin with 99.  Numbers
// that are taken are left out.
void fill_in_mmsi(scenario::Scenario& scenario);

// A buoy or marker, which AIS reports as an aid to navigation.
bool is_aid(scenario::Target::Kind kind);

}  // namespace skerry::server
