// BareSender: the least that sends a stream to many: a timer, send() to each, epoll for those that
// are full.
#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <string>
#include <thread>
#include <vector>

namespace skerry::bench {

struct BareStream {
  std::size_t piece_bytes = 0;
  double pieces_per_second = 0.0;
  std::size_t ring = 0;         // pieces that a console may be behind before some are lost
  std::size_t send_buffer = 0;  // bytes, as the server asks for
};

// Listens on a free port of loopback from its construction on, on a thread of its own.
class BareSender {
 public:
  // Error: std::runtime_error if it cannot listen.
  explicit BareSender(const BareStream& stream);
  ~BareSender();
  BareSender(const BareSender&) = delete;
  BareSender& operator=(const BareSender&) = delete;

  std::uint16_t port() const { return port_; }
  // Its thread runs on that core from now on.
  void pin_to(int core);
  double cpu_seconds() const;                   // of its thread so far
  std::uint64_t sent() const { return sent_; }  // pieces, to all consoles
  std::uint64_t lost() const { return lost_; }

 private:
  struct Console {
    int fd = -1;
    std::uint64_t next = 0;  // piece
    std::size_t offset = 0;  // in it, of what was sent already
    bool full = false;
  };
  void run();
  void accept_all();
  void send_to(Console& console);

  BareStream stream_;
  int listener_ = -1, epoll_ = -1, timer_ = -1;
  std::uint16_t port_ = 0;
  std::vector<std::vector<char>> pieces_;
  std::uint64_t newest_ = 0;  // pieces made so far
  std::vector<Console> consoles_;
  std::atomic<std::uint64_t> sent_ = 0, lost_ = 0;
  std::atomic<bool> ends_ = false;
  std::thread thread_;
};

}  // namespace skerry::bench
