// SharedRing: a board's ring of records in the host's shared memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "protocol/board/sweep_ring.hpp"
#include "protocol/quantity/result.hpp"

namespace skerry::server {

// Memory of this user alone (mode 0600), there from construction to destruction.  All of it is
// reserved at once: a host that runs out of it later does not end the server.  The file is locked
// while its server lives, so that one left behind by a dead server is known and replaced, and one
// of another server is not.
// Thread: one at a time.
class SharedRing {
 public:
  static constexpr std::size_t kDefaultBytes = 16u << 20;
  static constexpr std::size_t kMinBytes = 1u << 20, kMaxBytes = 256u << 20;

  // `name` as of shm_open, at least `capacity` bytes of records (kMinBytes .. kMaxBytes).
  // Error: the name is another server's, or the host has no such memory left; names the reason.
  static Result<SharedRing, std::string> create(const std::string& name, std::size_t capacity);
  SharedRing(SharedRing&& other) noexcept;
  SharedRing& operator=(SharedRing&&) = delete;
  // Tells readers that nothing more comes.
  ~SharedRing();

  const std::string& name() const { return name_; }
  std::size_t size() const { return memory_.size(); }
  board::SweepRingWriter& writer() { return *writer_; }

 private:
  SharedRing(std::string name, int file, std::span<std::uint8_t> memory);

  std::string name_;
  int file_ = -1;
  std::span<std::uint8_t> memory_;
  std::optional<board::SweepRingWriter> writer_;
};

}  // namespace skerry::server
