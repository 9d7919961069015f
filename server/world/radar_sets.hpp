// Radar sets: the equipment that a scenario's radar names and alters.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Something wrong with a radar's equipment, to be reported at its key.
struct SetComplaint {
  std::string key;   // of scenario::Radar: "peak_power_kw", "pulses[1].prf_hz"
  std::string text;  // value and what is allowed
};

// A shipped set by name; what is wrong with the name lists those there are.
std::optional<echo::RadarSet> shipped_set(const std::string& name);
std::string complain_of_name(const std::string& name);

// The shipped set with the scenario's alterations; without a name, the first one.  A beam of
// another width changes the antenna's gain with it, unless that is given too.  Requires a name that
// shipped_set() knows.
echo::RadarSet radar_set(const scenario::Radar& radar);

// All that makes the altered set unphysical (echo/radar/set_checks.hpp).
std::vector<SetComplaint> complaints_of(const scenario::Radar& radar);

}  // namespace skerry::server
