// Board: a radar's interface board, without a thread of its own.
//   register_file     what is written, read and ordered; board_settings: what that means together
//   board_core        a step of time; board_skip: time that is left out
//   trigger_, azimuth_generator   the pulses; tick_clock, azimuth: when, and where
//   azimuth_counter   what a digitiser makes of the pulses
//   sweep_maker       echo or test_pattern, as samples
//   record_writer, sweep_fifo   the ways out
// board_unit puts it on a thread, with record_frames and shared_ring to the outside.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "echo/sweeps/sweep_echoes.hpp"
#include "protocol/board/registers.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/quantity/time.hpp"
#include "server/board/register_access.hpp"

namespace skerry::server {

// The radar that the board drives.
struct BoardSetup {
  std::uint32_t radar = 0;
  echo::RadarSet set;
  // Registers at the start: address and value, checked already.  A reset leaves them as they are.
  std::vector<std::pair<std::uint32_t, std::uint32_t>> initial = {};
  // The echoes of a radar of the same own ship (this one among them); nullptr where there is none.
  // The board keeps what it got.
  std::function<std::shared_ptr<echo::SweepEchoes>(std::uint32_t radar)> echoes;
  std::function<bool(std::uint32_t radar)> has_radar;  // cheap: whether `echoes` would find it
  // The transmission of the board's radar.  Asked at every step, so it must be cheap.  Without a
  // radar: the set's first pulse.
  struct OnAir {
    echo::Pulse pulse;
    bool radiates = true;
  };
  std::function<OnAir()> on_air = {};
};

// The records of one step of time, ready to be sent.
struct BoardBatch {
  Bytes records;  // all
  Bytes signals;  // edges and events alone, with sequence numbers of their own
  std::uint64_t first_record = 0, first_signal = 0;
  std::vector<std::uint32_t> record_ends, signal_ends;  // record k is bytes [ends[k-1], ends[k])
  std::uint32_t sweeps = 0;
  // FaultBit, in order, whatever EVENT_ENABLE says.
  struct FaultChange {
    std::uint32_t raised = 0, cleared = 0;
  };
  std::vector<FaultChange> fault_changes;
  // False: kMostBytes of records were made before all that was due, and more is to be had at once.
  bool is_complete = true;

  // One record may exceed it.
  static constexpr std::size_t kMostBytes = 8u << 20;
  // Memory above this is given back by the first batch that does without.
  static constexpr std::size_t kKeptBytes = 1u << 20;
  void clear();
};

struct BoardCounters {
  std::uint64_t triggers = 0, sweeps = 0, sweeps_late = 0, records = 0;
  std::uint32_t faults = 0;
  std::string fault_reason;
};

// Time is passed in; what comes out is a pure function of the setup, the writes with the steps they
// came before, the echoes and what is on the air: bit by bit the same on every machine and, but for
// how edges are put into records, for steps of any length up to kMostBehind.  Where nobody wants
// sweeps none are made, but every pulse is counted.
//
// Azimuth: board::azimuth_turns() of a sweep's metadata is where the antenna points, clockwise from
// the ARP.  Every pulse stands at its nearest tick; so under steady rotation the error is at most
// half a tick from the second whole turn on, half a tick more where a turn is no whole number of
// ticks, and half a tick more with an ARP between two ACPs: its own place is rounded, too.
// Under wow w in m waves and gusts g the period known is as old as one ACP: with a = w / (1 + w), b
// = g / (1 + g) at most (2 pi (m a + b) / ACPs) / (1 - a - b) of an ACP more.  Held by
// BoardAzimuth.*.
class Board {
 public:
  explicit Board(BoardSetup setup);
  ~Board();

  // Registers.  Thread: any.  A write is checked at once and acts from the next step on; settings
  // that contradict each other set the fault `config` with its reason at once, and the board goes
  // on with the last ones that did not.
  board::RegisterError write(std::uint32_t address, std::uint32_t value);
  using Value = RegisterValue;
  Value read(std::uint32_t address) const;
  // Several in their order at one instant; `write` absent in an access that reads.
  using Operation = RegisterOperation;
  std::vector<Value> access(const std::vector<Operation>& operations);

  // Records of up to `count` sweeps out of the FIFO; appended to `out`; gives how many.  Each that
  // was not there counts as an underrun.  Thread: any.
  std::uint32_t take_fifo(std::uint32_t count, std::size_t max_bytes, Bytes& out,
                          std::uint64_t& first_sequence);

  // Makes all that happens before `now` (after the `now` of the call before).  `utc_zero`: UTC at
  // scenario time 0.  Where more than `kMostBehind` of sweeps are due the oldest are left out and
  // counted.  Where a batch is full first (BoardBatch::is_complete), the next call with the same
  // `now` goes on.  Thread: the board's.
  void advance(ScenarioTime now, UtcTime utc_zero, bool sweeps_wanted, BoardBatch& out);
  static constexpr std::chrono::milliseconds kMostBehind{250};

  // True while a capture is armed, or the FIFO takes sweeps: then they are made without readers.
  bool captures() const;
  BoardCounters counters() const;

 private:
  struct Core;
  std::unique_ptr<Core> core_;
};

}  // namespace skerry::server
