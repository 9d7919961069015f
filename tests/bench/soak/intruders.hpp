// Intruders: connections that no console makes.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <random>
#include <vector>

namespace skerry::bench {

// They come singly or in crowds, say what makes no sense, half of it or nothing, and wait to be
// closed.  None stays longer than kPatience.  Thread: one.
class Intruders {
 public:
  using Clock = std::chrono::steady_clock;
  static constexpr std::chrono::seconds kPatience{60};

  Intruders(std::uint16_t tcp_port, std::uint16_t http_port, std::uint64_t seed);
  ~Intruders();

  // A crowd of the next kind; what it was.
  const char* come(Clock::time_point now);
  // Reads and forgets what they are told; lets go of those that were closed.
  void look(Clock::time_point now);
  void leave() { inside_.clear(); }

  std::uint64_t came() const { return came_; }
  std::uint64_t closed_by_server() const { return closed_; }
  std::uint64_t refused() const { return refused_; }  // no connection at all

 private:
  struct Intruder;
  const std::uint16_t tcp_port_, http_port_;
  std::mt19937_64 random_;
  std::size_t next_kind_ = 0;
  std::vector<std::unique_ptr<Intruder>> inside_;
  std::uint64_t came_ = 0, closed_ = 0, refused_ = 0;
};

}  // namespace skerry::bench
