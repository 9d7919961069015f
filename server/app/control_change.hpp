// ControlChange: what a Set changed, as the log tells it and locks look at it.
#pragma once

#include <string>
#include <vector>

#include "protocol/wire/radar.pb.h"

namespace skerry::server {

struct ControlChange {
  std::string control;  // a field of Set; of the world "world.sea_state"
  std::string before, after;
};

// Of which a lock speaks: "world" of "world.sea_state".
std::string lock_of(const ControlChange& change);

// What differs between two Settings of one view; what follows from other controls (the pulse on the
// air) and the locks are not looked at.
std::vector<ControlChange> differences(const wire::Settings& before, const wire::Settings& after);

// What differs between two states of the world at one time.
std::vector<ControlChange> differences(const wire::World& before, const wire::World& after);

}  // namespace skerry::server
