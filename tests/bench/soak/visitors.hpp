// Visitors: consoles that come, look, turn knobs and go, well behaved or not.
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <random>
#include <span>
#include <string>
#include <vector>

#include "tests/system/load_console.hpp"

namespace skerry::bench {

// What a server's port numbers are, and what may be asked of it.
struct Visited {
  std::uint16_t tcp_port = 0, http_port = 0;
  std::uint32_t radars = 1;
  bool has_controls = true;  // false: a playback, which is told where to go instead
  double played_s = 0.0;     // the length of what it plays
};

struct VisitCounts {
  std::uint64_t visits = 0, views = 0, orders = 0, resets = 0, stalls = 0;
  std::uint64_t spokes = 0;
  // Missing in the numbers that came, of those who read all the time and of those who did not.
  std::uint64_t lost = 0, stalls_lost = 0;
  std::uint64_t untold = 0;  // of these, such as the server does not tell of
};

// At all times `count` of them, half on TCP and half on WebSocket.  What they do follows from the
// seed; when, from the machine.  Error: std::runtime_error as LoadConsole has.
// Thread: one.
class Visitors {
 public:
  using Clock = std::chrono::steady_clock;

  Visitors(const Visited& server, std::size_t count, std::uint64_t seed);
  ~Visitors();

  // Lets come and go who is due, and has some of them ask for something.
  void look(Clock::time_point now);
  // All go, and nobody comes until begin(); look() still has to be called until nobody is there.
  void leave();
  void begin() { are_welcome_ = true; }
  bool is_anybody_there() const { return !visitors_.empty(); }
  void add_readers(std::vector<system_test::LoadReceiver*>& readers) const;

  const VisitCounts& counts() const { return counts_; }

 private:
  struct Visitor;
  std::unique_ptr<Visitor> arrive(Clock::time_point now);
  // Counts what it has seen, and what its last status says of it.
  void depart(Visitor& visitor);
  void ask(Visitor& visitor);
  double between(double least, double most);

  const Visited server_;
  const std::size_t count_;
  std::mt19937_64 random_;
  std::vector<std::unique_ptr<Visitor>> visitors_;
  bool are_welcome_ = true;
  VisitCounts counts_;
};

}  // namespace skerry::bench
