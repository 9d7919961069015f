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

// The name that a lock has for it: "world" for "world.sea_state".
std::string lock_of(const ControlChange& change);

// The differences between two Settings of one view, without the locks and without what follows from
// other controls (the pulse on the air).
std::vector<ControlChange> differences(const wire::Settings& before, const wire::Settings& after);

// The differences between two states of the world at one time.
std::vector<ControlChange> differences(const wire::World& before, const wire::World& after);

}  // namespace skerry::server
