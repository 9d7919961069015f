// The report of recorder_child: memory that outlives it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>

namespace skerry::system_test {

// In a file that both processes map.  Spokes 0, 1, 2, ... of radar 0 as FakeHost::spoke() makes
// them with `begin_utc_ns`.  What it says besides, how far inputs are known (Reached.first) and
// where own ship is (OwnShip.utc_ns), bears the nanoseconds of the monotonic clock when it was
// said.
struct ChildsTale {
  struct Entry {
    std::atomic<std::int64_t> steady_ns;  // of the monotonic clock
    std::atomic<std::uint64_t> spokes;    // published until then
  };
  static constexpr std::size_t kEntries = 8192;

  std::atomic<std::int64_t> begin_utc_ns;
  std::atomic<std::uint64_t> entries;  // told so far; the last kEntries of them are there
  std::array<Entry, kEntries> told;
};

}  // namespace skerry::system_test
