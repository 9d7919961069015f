// TurnFinder: where the turns of a recorded radar begin.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/quantity/time.hpp"
#include "protocol/recording/reader.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::server {

// Reads spokes of one radar and view here and there, with a cursor of its own.
// Cost: some chunks read; to the 1000th turn from here about ten.
// Thread: one at a time.
class TurnFinder {
 public:
  // `rpm`: about how fast it turns, for the first guess; 5 .. 60.
  TurnFinder(const recording::RecordingReader& reader, recording::Topic topic, double rpm);

  // Whether it turns there: a spoke within the slowest turn before or after.
  bool turns_at(UtcTime place);

  // From where on one whole turn lies before `place`: what a console has to be sent to show its
  // picture as of then.  `place` itself where no spokes came just before.
  UtcTime turn_before(UtcTime place);

  // The `turns`-th begin of a turn after `place` (negative: before).  Nothing: the recording ends
  // (begins) before that.
  std::optional<UtcTime> turn_from(UtcTime place, int turns);

 private:
  struct Seen {
    UtcTime time{};
    std::uint32_t scan = 0;
    std::uint32_t index = 0;
  };
  // The next spoke of the cursor that can be read.
  std::optional<Seen> next();
  std::optional<Seen> first_from(UtcTime time);
  std::optional<UtcTime> begin_of(std::uint32_t scan, Seen near);

  const recording::Summary& summary_;
  recording::ItemCursor cursor_;
  Duration turn_;
  wire::Spoke message_;
};

}  // namespace skerry::server
