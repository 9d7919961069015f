// Rules of a target watch and the ranges of its orders: both are rows of targets.proto.
#pragma once

#include <google/protobuf/message.h>

#include <optional>
#include <string>

#include "protocol/wire/targets.pb.h"
#include "server/plotter/tracks/tracker.hpp"

namespace skerry::server {

// As they are at the start; all are present.
wire::TargetRules default_target_rules();

// Of a plotter that works by these, all of which are present and within their ranges.
Tracker::Rule tracker_rule(const wire::TargetRules& rules);

// The first value of the message itself that is not allowed, and what is; nothing if all are.
std::optional<std::string> value_not_allowed(const google::protobuf::Message& message);

}  // namespace skerry::server
