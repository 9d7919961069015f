#include "server/core/error_counts.hpp"

#include <gtest/gtest.h>

namespace skerry::server {
namespace {

TEST(ErrorCounts, CountsByKind) {
  ErrorCounts errors;
  errors.add("tcp accept", "no descriptor left");
  errors.add("tcp accept", "no descriptor left");
  errors.add("udp send", "network unreachable", 5);
  const std::map<std::string, std::uint64_t> expected = {{"tcp accept", 2}, {"udp send", 5}};
  EXPECT_EQ(errors.counts(), expected);
}

TEST(ErrorCounts, KeepsABoundedNumberOfKindsAndLosesNoError) {
  ErrorCounts errors;
  for (int i = 0; i < 1000; ++i) errors.add("kind " + std::to_string(i), "text");
  const auto counts = errors.counts();
  EXPECT_EQ(counts.size(), ErrorCounts::kMaxKinds + 1);
  EXPECT_EQ(counts.at(std::string(ErrorCounts::kOther)), 1000 - ErrorCounts::kMaxKinds);
}

}  // namespace
}  // namespace skerry::server
