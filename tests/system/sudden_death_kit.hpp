// What a recorder that was killed had been given, and what of it is in its files.
#pragma once

#include <chrono>
#include <cstdint>
#include <string>
#include <vector>

#include "protocol/quantity/time.hpp"
#include "tests/system/recorder_child.hpp"

namespace skerry::system_test {

inline constexpr std::chrono::nanoseconds kMostLost = std::chrono::seconds(1);

// SKERRY_KILLS; 20 without.
int kills();

// The memory in which a child tells what it published.
class Tale {
 public:
  explicit Tale(std::string path);  // Error: std::runtime_error
  ~Tale();
  Tale(const Tale&) = delete;
  Tale& operator=(const Tale&) = delete;

  const std::string& path() const { return path_; }
  const ChildsTale& told() const { return *static_cast<const ChildsTale*>(memory_); }
  UtcTime begin() const { return UtcTime(Duration(told().begin_utc_ns.load())); }
  // Spokes that had been published then.
  std::uint64_t published(std::chrono::steady_clock::time_point time) const;

 private:
  std::string path_;
  void* memory_ = nullptr;
};

struct Found {
  std::uint64_t spokes = 0;
  std::uint64_t next = 0;     // after the last spoke
  std::uint64_t missing = 0;  // before it
  std::uint64_t told = 0;     // of these, told in events
  // When it was said, at the latest, how far inputs are known and where own ship is.
  std::chrono::steady_clock::time_point reached{};
};

// Every spoke of radar 0 in the file must be one that the child published.
Found check_bytes(const std::string& path, UtcTime begin);
// The same of the files of a series, one after the other.
Found check_bytes(const std::vector<std::string>& paths, UtcTime begin);

}  // namespace skerry::system_test
