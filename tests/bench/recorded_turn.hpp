// Spokes as they are recorded, for benches: of the simulated radar, and of real ones.
#pragma once

#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::bench {

struct RecordedTurn {
  struct Spoke {
    UtcTime time{};
    Bytes bytes;             // wire::Spoke
    std::size_t utc_at = 0;  // of its utc_ns in them
  };
  std::string name;
  std::vector<Spoke> spokes;
  Duration duration{};  // after which it may begin again
};

// Makes the spoke so much later.
void delay(RecordedTurn::Spoke& spoke, Duration by);

// The full scene at 24 turns a minute, 4096 spokes of 1024 cells of 8 bits; where no chart is
// installed, something like it.
RecordedTurn simulated_turn();
// That turn, and the one of the HALO20 capture where that stands beside the repository.
std::vector<RecordedTurn> recorded_turns();

}  // namespace skerry::bench
