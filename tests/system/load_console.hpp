// The receiving ends of the load check, many on one thread: each reads when poll() says so.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "protocol/wire/datagram.hpp"
#include "protocol/wire/frame.hpp"
#include "protocol/wire/radar.pb.h"
#include "protocol/wire/sequence_gap.hpp"

namespace skerry::system_test {

// Counts the spokes of one radar that came in.
class SpokeCount {
 public:
  void take(std::uint64_t sequence);
  const LossCounter& losses() const { return losses_; }
  std::optional<std::uint64_t> newest() const { return newest_; }
  // From now on spokes of this sequence number or later are counted by counted().
  void count_from(std::uint64_t sequence) { count_from_ = sequence; }
  std::uint64_t counted() const { return counted_; }

 private:
  LossCounter losses_;
  std::optional<std::uint64_t> newest_;
  std::uint64_t count_from_ = UINT64_MAX;
  std::uint64_t counted_ = 0;
};

// A non-blocking socket with something to count behind it.  Errors are std::runtime_error: of a
// good client nothing may go wrong.
class LoadReceiver {
 public:
  virtual ~LoadReceiver();
  LoadReceiver(const LoadReceiver&) = delete;
  LoadReceiver& operator=(const LoadReceiver&) = delete;

  int socket() const { return socket_; }
  // Takes what is there.
  virtual void read() = 0;

  SpokeCount& spokes() { return spokes_; }
  std::uint64_t bytes() const { return bytes_; }

 protected:
  explicit LoadReceiver(int socket) : socket_(socket) {}
  int socket_;
  SpokeCount spokes_;
  std::uint64_t bytes_ = 0;
};

// Reads whatever has come to any of them, or waits a little (20 ms) for something.
void read_ready(std::span<LoadReceiver* const> receivers);

// A console on TCP.
class LoadConsole : public LoadReceiver {
 public:
  // Connects to that port of loopback.  `receive_buffer` bytes in the kernel, 0: its default.
  LoadConsole(std::uint16_t port, int receive_buffer = 0);

  void subscribe(std::uint32_t radar);
  void subscribe(const wire::Subscribe& subscribe);
  void set(const wire::Set& set);
  // Anything else; its number is put in.
  void send(wire::ClientMessage& message);
  // The answer is status() once it has come; all that came before it has then been counted.
  void ask_status();
  const std::optional<wire::Status>& status() const { return status_; }
  // What was missing of the spokes that came before it.
  std::uint64_t lost_before_status() const { return lost_before_status_; }
  // The name of this connection in the server's Status.
  const std::string& name() const { return name_; }

  // Error: std::runtime_error if the server closes, refuses, or sends what is no message.
  void read() override;
  // Other messages that came: OwnShip, ExerciseState.
  std::uint64_t own_ships() const { return own_ships_; }
  std::uint64_t exercise_states() const { return exercise_states_; }

 protected:
  virtual void send_frame(const Bytes& frame);
  virtual void take(std::span<const std::uint8_t> bytes);

 private:
  FrameReader frames_{kMaxServerFrame};
  std::uint64_t own_ships_ = 0, exercise_states_ = 0;
  wire::ServerMessage message_;
  std::optional<wire::Status> status_;
  std::uint64_t lost_before_status_ = 0;
  std::uint32_t requests_ = 0;
  std::string name_;
};

// A console on WebSocket, as a browser's: the same frames within messages (RFC 6455).
class LoadWebConsole : public LoadConsole {
 public:
  // Connects to that HTTP port of loopback and waits for the upgrade.
  explicit LoadWebConsole(std::uint16_t http_port);

 protected:
  void send_frame(const Bytes& frame) override;
  void take(std::span<const std::uint8_t> bytes) override;

 private:
  Bytes unread_;                    // of a header that is not whole
  std::uint64_t payload_left_ = 0;  // of the present message
};

// A subscriber of native datagrams on a free port of loopback.
class LoadSubscriber : public LoadReceiver {
 public:
  LoadSubscriber();
  std::uint16_t port() const { return port_; }
  void read() override;

 private:
  DatagramReassembler reassembler_;
  std::vector<std::uint8_t> buffer_;
  std::uint16_t port_ = 0;
};

}  // namespace skerry::system_test
