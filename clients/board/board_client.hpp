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

// Nothing that comes from the network throws or is believed unchecked.  Errors as of SpokeClient.
// Thread: one at a time.  No call waits longer than its timeout.
class BoardClient {
 public:
  // Error: also rejected where the server has no such radar, or no board for it.
  static ClientResult<BoardClient> connect(const std::string& host, std::uint16_t port,
                                           std::uint32_t radar, Duration timeout,
                                           const std::string& token = {});
  BoardClient(BoardClient&&) noexcept;
  BoardClient& operator=(BoardClient&&) noexcept;
  ~BoardClient();

  const wire::Hello& hello() const;
  const wire::RadarInfo& radar() const;

  struct Operation {
    std::uint32_t address = 0;
    std::optional<std::uint32_t> write = std::nullopt;
  };
  struct Value {
    board::RegisterError error = board::RegisterError::ok;
    std::uint32_t value = 0;
  };
  // All at one instant.
  ClientResult<std::vector<Value>> access(const std::vector<Operation>& operations,
                                          Duration timeout);

  ClientResult<Done> stream(BoardStreamKind kind, Duration timeout);
  // Stream from shared memory instead: only on the server's own host.
  ClientResult<Done> map_ring(Duration timeout);
  // The next record of the stream (or of the ring, once mapped); nothing if none came in time.
  ClientResult<std::optional<board::DecodedRecord>> next(Duration timeout);
  // Sweeps of the FIFO, oldest first.
  ClientResult<std::vector<board::Sweep>> read_fifo(std::uint32_t count, Duration timeout);

  std::uint64_t records_lost() const;  // by gaps in their sequence, since the stream began

 private:
  class Connection;
  explicit BoardClient(std::unique_ptr<Connection> connection);
  std::unique_ptr<Connection> connection_;
};

}  // namespace skerry::client
