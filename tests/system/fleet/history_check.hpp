// Whether what several processes were told of a log can have been told of one log.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "server/fleet/log_event.hpp"

namespace skerry::fleet {

// An append of one process, from its first attempt to its end.  Times by the machine's clock.
struct AppendTold {
  enum class End : std::uint8_t {
    done,
    never,    // refused for good: deposed, overtaken, full
    unknown,  // or the process was killed
  };
  std::string process, id;
  Epoch epoch = 0;
  std::int64_t began_ns = 0, ended_ns = 0;
  End end = End::unknown;
  Revision revision = 0;  // of done
};

// Orders that one watch gave, one after the other.
struct WatchTold {
  std::string process;
  Revision from = 0;
  std::vector<std::pair<Revision, std::string>> orders;
};

struct ToldHistory {
  std::vector<AppendTold> appends;
  std::vector<WatchTold> watches;
  std::vector<OrderSeen> log;  // at the end, when all was quiet
};

// What cannot be; empty if all is well:
//  - the log is in one order, each id once, epochs and ticks never smaller than before;
//  - what was acknowledged is there, where it was said to be; what was refused for good is not;
//  - an append that began after another was acknowledged stands behind it;
//  - each watch gave a stretch of the log without a gap, nothing twice.
std::vector<std::string> contradictions(const ToldHistory& history);

}  // namespace skerry::fleet
