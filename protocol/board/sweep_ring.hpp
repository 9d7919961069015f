// SweepRing: records in memory that a writer shares with any number of readers.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/wire/wire_error.hpp"

namespace skerry::board {

// One writer, which waits for nobody; readers have the memory read-only, so that none can harm the
// writer or another.  A reader that was overtaken notices, counts what it missed and goes on with
// the newest record.  Never wrong data: a record is handed out only after a look at the writer's
// position that proves that it was not touched while it was copied.
//
// Memory: kRingHeader bytes, then `capacity` of records, each in one piece (a filler takes what is
// left before the end).  BOARD.md has the byte table; the position counters are lock-free atomics.
inline constexpr std::size_t kRingHeader = 4096;
// Bytes needed for a ring of at least `capacity` bytes of records (rounded up to 64 KiB).
std::size_t ring_bytes(std::size_t capacity);

class SweepRingWriter {
 public:
  // Lays out the ring in `memory` (page aligned, ring_bytes() long) and owns it as its writer.
  explicit SweepRingWriter(std::span<std::uint8_t> memory);

  // Records one after another, whole, first with sequence `first_sequence`.  They are readable when
  // it returns.  Wakes readers that sleep.  Requires bytes.size() <= capacity / 4.
  void write(std::span<const std::uint8_t> records, std::uint64_t first_sequence,
             std::uint32_t count);
  // Tells readers that nothing more comes.
  void close();

 private:
  std::span<std::uint8_t> memory_;
  std::uint64_t position_ = 0;
};

class SweepRingReader {
 public:
  // Begins behind the newest record.  Nothing if the memory is no ring of this version.
  static std::optional<SweepRingReader> open(std::span<const std::uint8_t> memory);

  enum class State : std::uint8_t { record, empty, closed };
  // The next record into `out`, whole (its size is in its header).
  State take(Bytes& out);
  // Sleeps until there is one or the time is up; false: time is up.
  bool wait(std::chrono::nanoseconds timeout);

  std::uint64_t records_lost() const { return lost_; }

 private:
  std::span<const std::uint8_t> memory_;
  std::uint64_t position_ = 0, next_sequence_ = 0, lost_ = 0;
};

}  // namespace skerry::board
