// RecordWriter: a board's sweeps, edges and events as numbered records.
#pragma once

#include "server/board/board.hpp"
#include "server/board/tick_clock.hpp"

namespace skerry::server {

// Writes into one batch after another.  Edges are gathered and written by finish(), or when a
// record is full.  Thread: the board's.
class RecordWriter {
 public:
  explicit RecordWriter(std::uint32_t radar) { edges_.radar = radar; }

  // Empties the batch and writes into it until finish().  Edges from `tick` on are to come.
  void begin(BoardBatch& batch, Tick tick, std::uint32_t clock_hz);
  void sweep(const board::Sweep& sweep);
  void edge(Tick tick, board::Line line);
  void event(Tick tick, std::uint32_t event, std::uint32_t faults, std::uint32_t value);
  // Leaves out the edges before `tick`.  Requires that none are gathered.
  void restart_edges(Tick tick) { edges_.from_tick = tick; }
  // No edges before `tick` are left to come.
  void finish(Tick tick);

  std::uint64_t records() const { return next_record_; }

 private:
  void end_of_record();
  void end_of_signal();
  void write_edges(Tick to);

  BoardBatch* batch_ = nullptr;
  board::Edges edges_;
  std::uint64_t next_record_ = 0, next_signal_ = 0;
};

}  // namespace skerry::server
