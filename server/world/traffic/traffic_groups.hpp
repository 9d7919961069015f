// Groups of ships laid out by chance.
#pragma once

#include <cstddef>

#include "server/config/yaml_message.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Refuses groups that contradict themselves, and more than `most_ships` with those that are there.
// True if expand_groups() may have them.
bool check_groups(const scenario::Scenario& scenario, int ships, int most_ships,
                  YamlSource& source);

// Appends the groups' ships to the targets, called "<group> 1" and so on.  They follow from the
// scenario's seed and the group's place in the list, with the same bits on every machine.
// Requires what check_groups() checks.
//   lane: spread along the way with an even chance, within half the width to either side, each at
//     a speed of her own; who arrives is put back to the begin (route end `again`).
//   anchorage: within the radius, apart by 0.15 NM where there is room.
//   fishing: each with a ground of a third of the radius within it.
//   crossing: somewhere on the way, half of them in the other direction, lying 5 min at each end.
void expand_groups(scenario::Scenario& scenario);

}  // namespace skerry::server
