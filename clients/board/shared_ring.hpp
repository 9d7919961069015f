// SharedRing: a board's ring of records in shared memory, mapped read-only.  Not installed.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "clients/common/client_error.hpp"
#include "protocol/board/sweep_ring.hpp"

namespace skerry::client {

// The largest ring this library maps.
inline constexpr std::uint64_t kMaxRingBytes = std::uint64_t{1} << 30;

// The name comes from the network: one that is no name of a board's ring is not opened, nor is
// memory that belongs to another user (who could cut it short under the reader's feet).
// Thread: one at a time.
class SharedRing {
 public:
  // Error: malformed (name, size or content are not a board's ring), unreachable (no such memory,
  // not ours); the text says what of.
  static ClientResult<SharedRing> open(const std::string& name, std::uint64_t bytes);

  board::SweepRingReader& reader() { return reader_; }

 private:
  struct Unmap {
    std::size_t size = 0;
    void operator()(const std::uint8_t* memory) const;
  };
  using Memory = std::unique_ptr<const std::uint8_t, Unmap>;

  SharedRing(Memory memory, board::SweepRingReader reader)
      : memory_(std::move(memory)), reader_(std::move(reader)) {}

  Memory memory_;
  board::SweepRingReader reader_;
};

}  // namespace skerry::client
