// BoardSession: a board as a program of the C interface has it open.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "clients/board/board_client.hpp"

namespace skerry::client::capi {

// A BoardClient, and what came of it and is not yet in the caller's hands.
// Error: of every call: CallError.
// Thread: whoever holds in_use.
class BoardSession {
 public:
  // `shared`: sweeps come from shared memory, which is mapped already.
  BoardSession(BoardClient client, bool shared, Duration timeout)
      : client_(std::move(client)), shared_(shared), timeout_(timeout), streaming_(shared) {}

  std::mutex in_use;

  struct Arrived {
    std::uint64_t sequence = 0;
    board::Sweep sweep;
  };

  // Values of registers read at one instant; a write where it has one.  Refusals are errors that
  // name the register and what is allowed.
  std::vector<std::uint32_t> access(const std::vector<BoardClient::Operation>& operations);
  std::string fault_reason();

  void start();
  // The next sweep; stays the next one until drop_sweep().  Error: TIMEOUT.
  const Arrived& next_sweep(Duration timeout);
  void drop_sweep() { waiting_.pop_front(); }
  // The same for the FIFO's oldest.
  const Arrived& next_of_fifo(Duration timeout);
  void drop_of_fifo() { of_fifo_.reset(); }
  // The first event of `mask` that comes; later sweeps begin at its tick.  Error: TIMEOUT.
  board::Event wait(std::uint32_t mask, Duration timeout);

  std::uint64_t lost() const { return client_.records_lost(); }
  std::string description() const;

 private:
  std::optional<board::DecodedRecord> next_record(Duration timeout);
  void follow_clock(const board::Record& record);
  void keep(std::uint64_t sequence, board::Sweep sweep);
  std::optional<board::Event> event_in(const board::Record& record, std::uint32_t mask);

  BoardClient client_;
  bool shared_;
  Duration timeout_;
  bool streaming_;
  std::deque<Arrived> waiting_;
  std::optional<Arrived> of_fifo_;
  std::uint32_t clock_hz_ = 0;    // of the last record; ticks of another clock mean nothing
  std::uint64_t first_tick_ = 0;  // sweeps before it are passed over
  std::uint64_t last_arp_tick_ = 0;
};

}  // namespace skerry::client::capi
