// The orders that a board's thread takes from its registers, and the state that it gives back.
#pragma once

#include <optional>

#include "server/board/azimuth_counter.hpp"
#include "server/board/azimuth_generator.hpp"
#include "server/board/board_settings.hpp"

namespace skerry::server {

// Taken before a step; in force for all of it.
struct BoardOrders {
  std::optional<BoardSettings> settings;  // where others are in force than before
  std::uint32_t control = 0;
  std::uint32_t event_enable = 0;
  bool reset = false;
  std::uint64_t arm_number = 0;  // 0: not armed; otherwise which arming it is
  std::uint64_t fifo_epoch = 0;
  bool config_fault = false;
  bool config_is_new = false;  // its reason is another than before
  // How many are to be injected from now on, stall in ms, where that was written.
  std::optional<std::uint32_t> missing_acp, extra_acp, missing_arp, stall_ms;
};

// The counts up to a trigger, and the trigger's place.
struct TriggerLatch {
  PulseCounts counts;
  std::uint32_t ticks_since_acp = 0;
  std::uint64_t utc_ns = 0;
};

// Given after a step.
struct BoardState {
  Tick clocks = 0;
  std::uint64_t utc_ns = 0;
  PulseCounts counts;
  TriggerLatch latched;
  std::uint32_t faults = 0;       // as they are now, without `config`
  std::uint32_t faults_seen = 0;  // raised in the step
  std::uint32_t events_seen = 0;
  bool radiating = true;
  std::uint64_t sweeps = 0, sweeps_late = 0, records = 0;
  std::uint32_t missing_acp = 0, extra_acp = 0, missing_arp = 0, stall_ms = 0;  // still to come
};

}  // namespace skerry::server
