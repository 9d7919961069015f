#include "tests/bench/fan_out/arrivals.hpp"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <utility>

namespace skerry::bench {

Arrivals::Arrivals(WireConsole console, double sector_bytes, double sectors_per_second)
    : console_(std::move(console)),
      sector_bytes_(sector_bytes),
      period_s_(1.0 / sectors_per_second),
      thread_([this] { run(); }) {}

Arrivals::~Arrivals() { p99_ms(); }

double Arrivals::p99_ms() {
  if (!thread_.joinable()) return 0.0;
  ends_ = true;
  ::shutdown(console_.socket(), SHUT_RDWR);
  thread_.join();
  if (late_s_.empty()) return 0.0;
  const double zero = *std::min_element(late_s_.begin(), late_s_.end());
  const std::size_t at = late_s_.size() * 99 / 100;
  std::nth_element(late_s_.begin(), late_s_.begin() + static_cast<long>(at), late_s_.end());
  return 1000.0 * (late_s_[at] - zero);
}

// A server's messages have no mask: two bytes, then the length in none, two or eight more.  Source:
// RFC 6455, 5.2.
void Arrivals::run() {
  std::vector<char> waiting;
  std::array<char, 65536> piece;
  std::uint64_t sectors = 0;
  const auto begun = std::chrono::steady_clock::now();
  while (const std::size_t got = console_.read(piece)) {
    const std::chrono::duration<double> now = std::chrono::steady_clock::now() - begun;
    waiting.insert(waiting.end(), piece.data(), piece.data() + got);
    for (;;) {
      if (waiting.size() < 2) break;
      const auto at = [&](std::size_t i) { return static_cast<std::uint8_t>(waiting[i]); };
      const std::size_t code = at(1) & 0x7f;
      const std::size_t more = code == 126 ? 2 : code == 127 ? 8 : 0;
      if (waiting.size() < 2 + more) break;
      std::uint64_t size = more == 0 ? code : 0;
      for (std::size_t i = 0; i < more; ++i) size = size << 8 | at(2 + i);
      if (waiting.size() < 2 + more + size) break;
      waiting.erase(waiting.begin(), waiting.begin() + static_cast<long>(2 + more + size));
      const auto whole = std::lround(static_cast<double>(size) / sector_bytes_);
      for (long i = 0; i < whole; ++i) {
        late_s_.push_back(now.count() - static_cast<double>(sectors++) * period_s_);
      }
    }
  }
}

}  // namespace skerry::bench
