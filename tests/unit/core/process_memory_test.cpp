#include "server/core/process_memory.hpp"

#include <gtest/gtest.h>

#include <vector>

namespace skerry::server {
namespace {

TEST(ProcessMemory, GrowsByWhatIsTouched) {
  constexpr double kMib = 64;
  const double before = resident_mib();
  EXPECT_GT(before, 0.5);
  const std::vector<char> touched(static_cast<std::size_t>(kMib) * 1024 * 1024, 'x');
  EXPECT_EQ(touched.back(), 'x');
  EXPECT_GE(resident_mib(), before + 0.9 * kMib);
}

}  // namespace
}  // namespace skerry::server
