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

  // Whether a sweep of so many samples, of both channels together, would go in.
  bool has_room(std::uint64_t samples) const;
  // Another after every reset().
  std::uint64_t epoch() const;
  // False: no room.  A sweep of an epoch that has ended goes nowhere, and that is no failure.
  bool put(const board::Sweep& sweep, std::uint64_t epoch);
  // True: put() of a sweep like that would find no room, and it counts as lost already.
  bool refuses(const board::SweepMeta& meta, std::uint64_t epoch);
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

  static std::uint64_t samples_of(const board::SweepMeta& meta) {
    return std::uint64_t{meta.channels[0].samples} + meta.channels[1].samples;
  }
  bool refuses_locked(const board::SweepMeta& meta);
  bool has_room_locked(std::uint64_t samples) const {
    return samples_ + samples <= depth_ && held_.size() < kMostSweeps;
  }

  mutable std::mutex mutex_;
  std::uint64_t depth_ = 131'072, samples_ = 0, sequence_ = 0, epoch_ = 0;
  std::array<bool, 2> channels_{true, false};
  std::deque<Held> held_;
  std::vector<Bytes> spare_;
  Counters counters_;
};

}  // namespace skerry::server
