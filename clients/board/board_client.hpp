// BoardClient: a radar's interface board over TCP, and its ring in shared memory.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "clients/common/client_error.hpp"
#include "protocol/board/registers.hpp"
#include "protocol/board/sweep_record.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::client {

enum class BoardStreamKind : std::uint8_t { none, records, signals };

// One connection to the interface board of one radar.  Nothing that comes from the network throws
// or is believed unchecked.  An error ends the connection: every later call answers with the same
// error.  Exception: a request that the server rejects or does not answer in time, or that this
// library does not send, leaves the connection as it was.
// Memory: at most kMaxWaitingBytes of records, which wait while a request is under way; then the
// oldest give way and count as lost.
// Thread: one at a time.  No call waits longer than its timeout (but for the system's name lookup).
class BoardClient {
 public:
  static constexpr std::size_t kMaxWaitingBytes = 16 << 20;
  static constexpr std::size_t kMaxOperations = 256;   // of an access
  static constexpr std::uint32_t kMaxFifoSweeps = 64;  // of a read_fifo

  // `token`: as of SpokeClient, for what changes the board.
  // Error: as SpokeClient::connect; rejected where the server has no such radar, or no board for
  // it.
  static ClientResult<BoardClient> connect(const std::string& host, std::uint16_t port,
                                           std::uint32_t radar, Duration timeout,
                                           const std::string& token = {});
  BoardClient(BoardClient&&) noexcept;
  BoardClient& operator=(BoardClient&&) noexcept;
  ~BoardClient();

  const wire::Hello& hello() const;
  const wire::RadarInfo& radar() const;
  const std::string& name() const;  // "host:port", for messages

  struct Operation {
    std::uint32_t address = 0;
    std::optional<std::uint32_t> write = std::nullopt;
  };
  struct Value {
    board::RegisterError error = board::RegisterError::ok;
    std::uint32_t value = 0;
  };
  // All at one instant.  A refused one has its error in its Value and changes nothing.
  // Error: rejected, also for more than kMaxOperations; timed_out; closed; malformed.
  ClientResult<std::vector<Value>> access(const std::vector<Operation>& operations,
                                          Duration timeout);

  // From now on next() brings those records; what was waiting of an earlier stream is dropped and
  // records_lost() begins anew.  Error: as access().
  ClientResult<Done> stream(BoardStreamKind kind, Duration timeout);
  // Stream from shared memory instead, from the newest record on.
  // Error: also rejected where the server runs on another host, and unreachable where its memory
  // cannot be mapped; the connection stays in both cases.
  ClientResult<Done> map_ring(Duration timeout);
  // The next record of the stream (or of the ring, once mapped); nothing if none came in time.
  // Error: closed, also where a ring has ended; malformed.
  ClientResult<std::optional<board::DecodedRecord>> next(Duration timeout);
  // Up to `count` sweeps of the FIFO, oldest first.  Error: as access(), for more than
  // kMaxFifoSweeps.
  ClientResult<std::vector<board::Sweep>> read_fifo(std::uint32_t count, Duration timeout);

  std::uint64_t records_lost() const;  // by gaps in their sequence, since the stream began

 private:
  class Connection;
  explicit BoardClient(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

}  // namespace skerry::client
