// ReplayedWorld: the world of a recorded exercise.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "server/replay/recorded_exercise.hpp"
#include "server/world/scenario.pb.h"
#include "server/world/timeline.hpp"

namespace skerry::server {

// True if all values of a Set are within their ranges.
using RangeCheck = std::function<bool(const wire::Set&)>;

// Thread: one at a time.
class ReplayedWorld {
 public:
  // `inputs` by tick, and they must outlive it.
  ReplayedWorld(const scenario::Scenario& scenario, const std::vector<WorldInput>& inputs,
                RangeCheck in_range);

  // The world at a time, as Timeline::at() has it, with every input given at its tick.
  WorldStatePtr at(ScenarioTime time);

  // The world itself, as at() gave it last; to go on from there for a while.
  World world() const { return timeline_.world(); }

  // The first input that the world refused: the recording is not of this scenario.
  const std::optional<std::string>& fault() const { return fault_; }

 private:
  void give(const WorldInput& input);
  void make_up_to(std::uint64_t tick);

  Timeline timeline_;
  const std::vector<WorldInput>& inputs_;
  std::size_t next_ = 0;
  RangeCheck in_range_;
  std::optional<std::string> fault_;
};

}  // namespace skerry::server
