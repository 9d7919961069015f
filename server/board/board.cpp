#include "server/board/board.hpp"

#include "server/board/board_core.hpp"

namespace skerry::server {

struct Board::Core {
  explicit Core(const BoardSetup& setup)
      : registers({setup.radar, setup.set, setup.initial, setup.has_radar}, fifo),
        core(setup, registers, fifo) {}

  SweepFifo fifo;
  RegisterFile registers;
  BoardCore core;
};

Board::Board(BoardSetup setup) : core_(std::make_unique<Core>(setup)) {}
Board::~Board() = default;

board::RegisterError Board::write(std::uint32_t address, std::uint32_t value) {
  return core_->registers.access({{address, true, value}}).front().error;
}

Board::Value Board::read(std::uint32_t address) const { return core_->registers.read(address); }

std::vector<Board::Value> Board::access(const std::vector<Operation>& operations) {
  return core_->registers.access(operations);
}

std::uint32_t Board::take_fifo(std::uint32_t count, std::size_t max_bytes, Bytes& out,
                               std::uint64_t& first_sequence) {
  return core_->fifo.take(count, max_bytes, out, first_sequence);
}

void Board::advance(ScenarioTime now, UtcTime utc_zero, bool sweeps_wanted, BoardBatch& out) {
  core_->core.advance(now, utc_zero, sweeps_wanted, out);
}

bool Board::captures() const { return core_->registers.captures(); }

BoardCounters Board::counters() const {
  const BoardState state = core_->registers.state();
  return {state.counts.triggers, state.sweeps, state.sweeps_late,
          state.records,         state.faults, core_->registers.fault_reason()};
}

}  // namespace skerry::server
