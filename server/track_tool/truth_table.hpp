// Where the ships of a recorded exercise really were, as a table.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "protocol/recording/reader.hpp"
#include "protocol/wire/exercise.pb.h"

namespace skerry::server {

// A row for each ship and each state of the exercise that the recording holds (once a second),
// under a line of names: utc_s,id,lat_deg,lon_deg,course_deg,speed_kn; course and speed over
// ground.
//
// The id is "own" for the own ship that carries `radar` (without a number: the first own ship), and
// the name of any other; "NAME #n" where several have it, "#n" where there is none, with n her
// number among own ships or targets.  Ships that were removed have no row; marks and buoys are not
// part of these states.
//
// Error: a state was taken up to a tick (100 ms) before the time that it bears.
class TruthTable {
 public:
  using Sink = std::function<void(std::string_view)>;
  TruthTable(std::optional<std::uint32_t> radar, Sink sink);
  void add(UtcTime utc, const wire::ExerciseState& state);

  std::uint64_t states() const { return states_; }

 private:
  std::optional<std::uint32_t> radar_;
  Sink sink_;
  std::uint64_t states_ = 0;
};

// All states of a recording.  Error: std::runtime_error that names the file: it holds none, or
// none that has such a radar aboard an own ship.
std::uint64_t write_truth(const recording::RecordingReader& reader,
                          std::optional<std::uint32_t> radar, const TruthTable::Sink& sink);

}  // namespace skerry::server
