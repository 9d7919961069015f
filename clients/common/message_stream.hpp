// MessageStream: the connection under a SpokeClient.  Not installed.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <optional>
#include <string>

#include "clients/common/asio.hpp"
#include "clients/common/client_error.hpp"
#include "clients/common/client_socket.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"

namespace skerry::client {

using Deadline = std::chrono::steady_clock::time_point;

// `timeout` from now, at most a year; now, if it is negative.
Deadline deadline_after(Duration timeout);
bool is_past(Deadline deadline);

// Whole messages to and from one server, each call with a deadline.  The first error ends the
// connection and is the answer to every later call.
// Thread: one at a time.
class MessageStream {
 public:
  MessageStream(const std::string& host, std::uint16_t port);
  MessageStream(const MessageStream&) = delete;
  MessageStream& operator=(const MessageStream&) = delete;

  // `host` as HostName has it.  Error: unreachable, refused, timed_out.
  ClientResult<Done> connect(const std::string& host, std::uint16_t port, Deadline deadline);

  // Connects and waits for the server's Hello.
  // Error: also closed, rejected, malformed (not a Skerry server, or a protocol version this
  // library does not know).
  ClientResult<wire::Hello> open(const std::string& host, std::uint16_t port, Duration timeout);

  // The next message; nothing if none came in time.  What is there already is looked at even if the
  // deadline has passed.
  // Error: closed, with the text of the last error reply among the messages; malformed.
  ClientResult<std::optional<wire::ServerMessage>> next(Deadline deadline);

  // Error: closed; timed_out if the server takes nothing any more.
  ClientResult<Done> send(const wire::ClientMessage& message, Deadline deadline);

  // Ends the connection.
  Failure<ClientError> end(ClientErrorKind kind, std::string text);

  const std::string& name() const { return name_; }  // "host:port", printable

  // Both ends have the same address: the server runs on this host.
  bool is_local() const;

  // The failure of a request of that kind: no answer, or an answer that is an error.
  Failure<ClientError> no_answer(const char* kind) const;
  Failure<ClientError> rejected(const wire::Reply& reply) const;

 private:
  using tcp = boost::asio::ip::tcp;
  using error_code = boost::system::error_code;

  ClientResult<Done> secure(const HostName& host, Deadline deadline);
  // Runs handlers until `done`; false if the deadline came first.
  bool run_until(Deadline deadline, const bool& done);
  void start_read();
  Failure<ClientError> end_of_stream(const error_code& error);
  ClientResult<std::optional<wire::ServerMessage>> parse(std::span<const std::uint8_t> body);

  std::string name_;
  boost::asio::io_context io_;
  ClientSocket socket_{io_};
  FrameReader frames_{kMaxServerFrame};
  std::array<std::uint8_t, 65536> buffer_{};
  std::size_t read_size_ = 0;
  error_code read_error_;
  bool reading_ = false;
  bool read_done_ = false;
  std::optional<ClientError> failure_;
  std::string complaint_;  // the text of the server's last error reply
};

}  // namespace skerry::client
