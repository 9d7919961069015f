// A plotter's list as Signal K has it.
#pragma once

#include "protocol/signalk/documents.hpp"
#include "protocol/signalk/target.hpp"
#include "protocol/wire/targets.pb.h"

namespace skerry::server {

// Of a target of the list, not of a test target.
signalk::Json target_document(const wire::Target& target, const wire::TargetList& list);

// For displays that know vessels and no tracked targets: "Radar target 12".  Of a target that no
// AIS target is taken to be.  Her motion is told if it is over ground.
signalk::OtherVessel tracked_vessel(const wire::Target& target, const wire::TargetList& list);

// The state of an alert: an alarm is "alarm", a warning "warn", a caution "alert"; one whose cause
// is gone is "normal".
signalk::Json notification_of(const wire::Alert& alert);

}  // namespace skerry::server
