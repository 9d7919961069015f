// ManyConsoles: connections that take all they are sent and throw it away, in a process of their
// own.
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <cstdint>
#include "tests/bench/fan_out/wire_console.hpp"

namespace skerry::bench {

class ManyConsoles {
 public:
  // Connects `count` times that way.
  // Error: std::runtime_error if there is no process to be had, or not all could connect.
  ManyConsoles(std::size_t count, Way way, std::uint16_t port);
  ~ManyConsoles();
  ManyConsoles(const ManyConsoles&) = delete;
  ManyConsoles& operator=(const ManyConsoles&) = delete;

  std::uint64_t bytes() const;  // that came so far, on all of them, encrypted or not

 private:
  struct Shared;
  Shared* shared_ = nullptr;
  pid_t pid_ = 0;
};

}  // namespace skerry::bench
