// FleetPort: what RadarServer asks of the fleet that runs its exercise on several hosts.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "protocol/wire/radar.pb.h"
#include "server/core/answered.hpp"

namespace skerry::server {

// Thread: any; returns at once.
class FleetPort {
 public:
  virtual ~FleetPort() = default;

  // To all hosts; `later` is called once, when it holds here or will not.
  virtual void order(const wire::Set& set, const std::string& origin, const Answered& later) = 0;
  virtual void leave(const std::string& origin) = 0;
  // A ship has run aground at the shore.  Only the leader's counts.
  virtual void ground(const wire::ExerciseOrder& order) = 0;

  // As what all hosts know a console of this one, and the other way round: who has a con as this
  // host's consoles are told it.
  virtual std::string known_as(const std::string& origin) const = 0;
  virtual std::string shown(const std::string& known_as) const = 0;

  // Why no order would be taken now.
  virtual std::optional<std::string> refusal() const = 0;
  virtual wire::Fleet told() const = 0;
  virtual std::uint64_t version() const = 0;
};

}  // namespace skerry::server
