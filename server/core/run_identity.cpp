#include "server/core/run_identity.hpp"

#include <cstdint>
#include <cstdio>
#include <random>

namespace skerry::server {

std::string new_run_identity() {
  std::random_device random;  // of the system
  std::string text;
  for (int i = 0; i < 4; ++i) {
    char digits[9];
    std::snprintf(digits, sizeof digits, "%08x", static_cast<unsigned>(random()));
    text += digits;
  }
  return text;
}

}  // namespace skerry::server
