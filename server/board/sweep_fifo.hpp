// SweepFifo: sweeps that wait to be asked for.
#pragma once

#include <cstdint>
#include <deque>
#include <mutex>
#include <vector>

#include "protocol/board/sweep_record.hpp"

namespace skerry::server {

// Holds sweeps as records.  What comes when it is full is lost and counted, what is asked of it
// when it is empty is counted, for each channel that is on.  A sweep that was lost has a sequence
// number too, so that its gap is seen.  Sweeps of a single length are stored without allocation
// once as many have passed as it holds.
// Thread: any; a sweep is copied under the lock, no more.
class SweepFifo {
 public:
  // However short they are.
  static constexpr std::size_t kMostSweeps = 4096;

  struct Counters {
    std::uint32_t level = 0;  // sweeps
    std::array<std::uint32_t, 2> overruns{}, underruns{};
  };

  // False: no room.
  bool put(const board::Sweep& sweep);
  // Up to `count` records, as many as fit `max_bytes`, appended to `out`; gives how many.  Those
  // that were not there are underruns; those that did not fit stay.
  std::uint32_t take(std::uint32_t count, std::size_t max_bytes, Bytes& out,
                     std::uint64_t& first_sequence);
  // Samples of both channels together.  A smaller depth lets what is in it stay.
  void set_depth(std::uint32_t samples);
  // Which channels an underrun is counted for.
  void set_channels(bool a, bool b);
  // Empty, counters 0.
  void reset();
  Counters counters() const;

 private:
  struct Held {
    Bytes record;
    std::uint64_t sequence = 0;
    std::uint64_t samples = 0;
  };

  mutable std::mutex mutex_;
  std::uint64_t depth_ = 131'072, samples_ = 0, sequence_ = 0;
  std::array<bool, 2> channels_{true, false};
  std::deque<Held> held_;
  std::vector<Bytes> spare_;
  Counters counters_;
};

}  // namespace skerry::server
