// BoardUnit: an interface board on its thread, and the ways out of it.
#pragma once

#include <atomic>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "protocol/quantity/time.hpp"
#include "server/board/board.hpp"
#include "server/board/shared_ring.hpp"
#include "server/core/board_port.hpp"
#include "server/core/latest.hpp"
#include "server/core/utc_clock.hpp"

namespace skerry::server {

// A board's faults in the server's log, as they come and go.
// One line for every fault raised or cleared, kMostLines at once and one every kLineTime on and on:
// what is beyond is counted in a line of its own, so that no client can fill a disk with faults.
// Thread: one at a time.
class FaultLog {
 public:
  static constexpr int kMostLines = 20;
  static constexpr std::chrono::seconds kLineTime{10};

  explicit FaultLog(std::string name) : name_(std::move(name)) {}

  // Takes the fault changes, whatever events are enabled; `reason`: why the fault `config` is set.
  void look_at(const BoardBatch& batch, const std::function<std::string()>& reason,
               std::chrono::steady_clock::time_point now);

 private:
  // Takes a line's room, if there is any.
  bool take_room();
  void tell_left_out();
  void tell(bool is_raised, std::uint32_t faults, const std::function<std::string()>& reason);

  std::string name_;
  std::chrono::steady_clock::time_point last_{};
  std::chrono::steady_clock::duration room_ = kMostLines * kLineTime;
  std::uint64_t left_out_ = 0;
};

// Lets the board make what has happened since the last step, every kStep while somebody reads,
// captures or has lately accessed it, and every kIdleStep otherwise; hands the records to the rings
// of the network and to the shared one; logs faults that are raised and cleared.
//
// Sweeps are wanted while somebody is registered with the ring "records", holds a lease of the
// shared ring, or the board captures.  Without, no echo is made and no coast asked for.
// Thread: "board-N" makes records; all other functions as stated.
class BoardUnit final : public BoardPort {
 public:
  static constexpr std::chrono::milliseconds kStep{5};
  static constexpr std::chrono::milliseconds kIdleStep{100};
  // So long after an access the board counts as looked at.
  static constexpr std::chrono::milliseconds kInterest{2000};
  // A block of records; one more record may exceed it.
  static constexpr std::size_t kBlockBytes = 64u << 10;
  // The most that the network may lag behind: kRingBlocks or kRingBytes, whichever is less.
  static constexpr std::size_t kRingBlocks = 512, kRingBytes = 32u << 20;

  // `name` for the log.  Without a ring name there is no shared ring.
  BoardUnit(BoardSetup setup, std::string name);
  ~BoardUnit() override { stop(); }

  // Before start().
  void set_shared_ring(std::string ring_name, std::size_t ring_bytes);
  // Once in a unit's life.  When scenario time 0 was, on the clocks outside.
  void start(std::chrono::steady_clock::time_point zero, UtcTime utc_zero);
  // What records are stamped with from the next step on.  Thread: any.
  void set_utc(const UtcClock& clock) { utc_.set(clock); }
  // Ends the thread and the shared ring.
  void stop();

  // Thread: any.
  wire::BoardReply access(const wire::BoardAccess& access) override;
  wire::BoardRecords read_fifo(std::uint32_t count) override;
  Result<BoardRingLease, std::string> open_ring() override;
  FormatRing& ring(const std::string& format) override;
  double bytes_per_second() const override {
    return bytes_per_second_.load(std::memory_order_relaxed);
  }
  wire::BoardState state() const;

 private:
  using Clock = std::chrono::steady_clock;
  void run(const std::stop_token& stop);
  void step();
  // A batch of what was due `now`; false: there is more.
  bool step_once(Clock::time_point now);
  void hand_out();
  void measure(Clock::time_point now, double cpu_s);
  bool sweeps_wanted() const;
  bool looked_at() const;
  // Wakes the thread: something is asked of the board.
  void poke();
  std::shared_ptr<SharedRing> shared_ring() const;

  const std::uint32_t radar_;
  Board board_;
  FaultLog log_;
  FormatRing records_{kRingBlocks, kRingBytes};
  FormatRing signals_{kRingBlocks, kRingBytes};
  Clock::time_point zero_;
  Latest<UtcClock> utc_;
  BoardBatch batch_;  // board-N, as the next two
  Clock::time_point window_begun_{};
  std::uint64_t window_bytes_ = 0;

  std::string ring_name_;
  std::size_t ring_bytes_ = SharedRing::kDefaultBytes;
  mutable std::mutex ring_mutex_;
  std::shared_ptr<SharedRing> shared_ring_;
  std::shared_ptr<std::atomic<int>> leases_ = std::make_shared<std::atomic<int>>(0);

  std::mutex mutex_;
  std::condition_variable_any poked_;
  bool is_poked_ = false;                   // guarded by mutex_
  std::atomic<Clock::rep> last_access_{0};  // since the clock's epoch
  std::atomic<double> bytes_per_second_{0.0}, sweep_us_{0.0};
  std::jthread thread_;
};

}  // namespace skerry::server
