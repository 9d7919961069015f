// Arrivals: how late the messages of a console's WebSocket come.
#pragma once

#include <atomic>
#include <thread>
#include <vector>

#include "tests/bench/fan_out/wire_console.hpp"

namespace skerry::bench {

// Reads on a thread of its own until it ends.
class Arrivals {
 public:
  // `sector_bytes`, `sectors_per_second`: of the stream.
  Arrivals(WireConsole console, double sector_bytes, double sectors_per_second);
  ~Arrivals();
  Arrivals(const Arrivals&) = delete;
  Arrivals& operator=(const Arrivals&) = delete;

  // Ends reading.  Of 100 sectors 99 came no later than this, in ms, after the regular beat of
  // which the earliest is the zero.  Sectors that were lost count as none.
  double p99_ms();

 private:
  void run();

  WireConsole console_;
  double sector_bytes_, period_s_;
  std::vector<double> late_s_;  // of each sector, against the beat, from an unknown zero
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace skerry::bench
