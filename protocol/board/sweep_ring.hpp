// SweepRing: records in memory that a writer shares with any number of readers.
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <span>

#include "protocol/wire/wire_error.hpp"

namespace skerry::board {

// One writer, which waits for nobody; readers have the memory read-only, so that none can harm the
// writer or another, dead or alive.  A reader that was overtaken notices, counts what it missed and
// goes on with the newest record.  Never wrong data: a record is handed out only after a look at
// the writer's position that proves that it was not touched while it was copied.
//
// Memory: kRingHeader bytes, then the records, each in one piece (a filler takes what is left
// before the end).  BOARD.md has the byte table; the position counters are lock-free atomics.
inline constexpr std::size_t kRingHeader = 4096;
// Bytes needed for a ring of at least `capacity` bytes of records (rounded up to 64 KiB, at least
// 512 KiB).
std::size_t ring_bytes(std::size_t capacity);

class SweepRingWriter {
 public:
  // Lays out the ring in `memory` (page aligned, ring_bytes() long) and owns it as its writer.
  // Readers of an earlier ring in the same memory, whose writer is gone, go on with this one.
  // Error: std::invalid_argument where the memory is not as said.
  explicit SweepRingWriter(std::span<std::uint8_t> memory);

  // Records one after another, whole, first with sequence `first_sequence`, any number of bytes.
  // They are readable when it returns.  Wakes readers that sleep: one system call, more only where
  // `records` are longer than a quarter of the ring.
  // Error: std::invalid_argument where `records` are not `count` whole records; nothing is written.
  void write(std::span<const std::uint8_t> records, std::uint64_t first_sequence,
             std::uint32_t count);
  // Tells readers that nothing more comes.
  void close();

 private:
  std::uint64_t capacity() const { return memory_.size() - kRingHeader; }
  void publish(std::span<const std::uint8_t> records);
  void copy_in(std::span<const std::uint8_t> records);

  std::span<std::uint8_t> memory_;
  std::uint64_t start_ = 0, position_ = 0;
};

class SweepRingReader {
 public:
  // Begins behind the newest record.  Nothing if the memory is no ring of this version.
  static std::optional<SweepRingReader> open(std::span<const std::uint8_t> memory);

  enum class State : std::uint8_t { record, empty, closed };
  // The next record into `out`, whole (its size is in its header).
  // Checks everything it reads from the memory; where that makes no sense there is no record.
  State take(Bytes& out);
  // Sleeps until there is one, or the ring is closed.  False: not yet; time is up, a signal came,
  // or the wake was that of a record already taken (a reader may take one before its writer comes
  // to wake it).
  bool wait(std::chrono::nanoseconds timeout);

  // Since open(), exactly: by the records' sequence.
  std::uint64_t records_lost() const { return lost_; }

 private:
  explicit SweepRingReader(std::span<const std::uint8_t> memory) : memory_(memory) {}
  std::uint64_t capacity() const { return memory_.size() - kRingHeader; }
  std::uint64_t published() const;
  bool ready() const;
  bool untouched() const;
  void to_newest();
  bool begin_behind_newest();
  void count(std::uint64_t sequence);

  std::span<const std::uint8_t> memory_;
  std::uint64_t position_ = 0;
  std::optional<std::uint64_t> next_sequence_;  // nothing: no record is known yet
  bool from_start_ = false;                     // there was none when it was opened
  std::uint64_t lost_ = 0;
};

}  // namespace skerry::board
