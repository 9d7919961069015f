// DatagramPacer: when each datagram of an emulated radar leaves.
#pragma once

#include <chrono>

#include "protocol/quantity/time.hpp"
#include "server/core/video_channel.hpp"

namespace skerry::server {

// The radar's thread makes spokes a sector at a time and a moment late, now more, now less.  A
// display is sent them at the pace of the antenna, a sector and kMargin behind it: what comes less
// than kMargin late leaves on time, what comes later leaves at once.
// Pure; times of arrival are a steady clock's.
class DatagramPacer {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  static constexpr Duration kMargin = std::chrono::milliseconds(4);
  // A sector that comes so much later than the best so far begins a new count: the antenna's clock
  // was set, or the radar fell behind for good.
  static constexpr Duration kStep = std::chrono::milliseconds(100);

  // `burst`: what completes within so much time leaves together; 0: each on its own.
  explicit DatagramPacer(Duration burst = {}) : burst_(burst) {}

  // A sector came whose spokes the antenna passed from `first` to `last`.
  void on_sector(SteadyTime arrival, ScenarioTime first, ScenarioTime last);
  // When what was completed at `at`, of that sector, leaves; at most kMargin and the sector's
  // length after its arrival.
  SteadyTime leaves(ScenarioTime at) const;

 private:
  Duration burst_;
  bool begun_ = false;
  Duration behind_{};  // least of arrival - last
  ScenarioTime first_{};
  Duration length_{};
  SteadyTime latest_{};
};

// `inner`, whose sectors tell when each of their spokes was completed.  `inner` is called with one
// spoke at a time.
SectorEncoder timed_encoder(SectorEncoder inner);

}  // namespace skerry::server
