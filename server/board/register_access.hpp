// Accesses to a board's registers, and their answers.
#pragma once

#include <cstdint>

#include "protocol/board/registers.hpp"

namespace skerry::server {

struct RegisterOperation {
  std::uint32_t address = 0;
  bool writes = false;
  std::uint32_t value = 0;
};

struct RegisterValue {
  board::RegisterError error = board::RegisterError::ok;
  std::uint32_t value = 0;  // read, or written
};

}  // namespace skerry::server
