// ExerciseInputs: what an exercise was given, as a recorder sees it.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"

namespace skerry::server {

// A file that belongs to a recording: scenario, identity of the charts.
struct ExerciseDocument {
  std::string name;        // "scenario.yaml"
  std::string media_type;  // "application/yaml"
  std::string bytes;
};

// When scenario time 0 was by the clock as it was then, and as it is now: by that runs a recording
// that begins now.
struct ScenarioZero {
  UtcTime then, now;
};

// All inputs since scenario time 0 are kept, some kilobytes an hour, so that a recording that
// begins later has them too.  Thread: any; every function returns at once.
class ExerciseInputs {
 public:
  virtual ~ExerciseInputs() = default;

  // recording::Input messages from number `from` (0: the first) on, in their order; at most
  // kMostAtOnce, so that no radar waits for long: ask until there are none.
  static constexpr std::size_t kMostAtOnce = 1000;
  virtual std::vector<std::string> since(std::size_t from) const = 0;
  // How far the inputs are known, one message per radar.  All inputs up to there are in what
  // since() gives from now on: ask for this after spokes were taken and before inputs are, and
  // write it behind them.
  virtual std::vector<std::string> reached() const = 0;
  // When scenario time 0 was.  Nothing before it was.
  virtual std::optional<ScenarioZero> zero() const { return std::nullopt; }
  // Documents that never change while the server runs.
  virtual std::vector<ExerciseDocument> documents() const = 0;
};

}  // namespace skerry::server
