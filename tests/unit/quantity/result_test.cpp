#include "protocol/quantity/result.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>

namespace skerry {
namespace {

Result<int, std::string> half_of(int even) {
  if (even % 2 != 0) return Failure{std::string("odd")};
  return even / 2;
}

TEST(Result, HoldsAValue) {
  const auto result = half_of(4);
  ASSERT_TRUE(result.ok());
  EXPECT_TRUE(result);
  EXPECT_EQ(result.value(), 2);
  EXPECT_EQ(*result, 2);
}

TEST(Result, HoldsWhyThereIsNone) {
  const auto result = half_of(3);
  ASSERT_FALSE(result.ok());
  EXPECT_FALSE(result);
  EXPECT_EQ(result.error(), "odd");
}

TEST(Result, CanBeTakenOverWithoutACopy) {
  Result<std::unique_ptr<int>, std::string> result(std::make_unique<int>(7));
  const std::unique_ptr<int> taken = std::move(result).value();
  EXPECT_EQ(*taken, 7);
}

TEST(Result, ValueAndErrorMayBeOfOneType) {
  const Result<std::string, std::string> good(std::string("a"));
  const Result<std::string, std::string> bad(Failure{std::string("b")});
  EXPECT_TRUE(good.ok());
  EXPECT_EQ(good->size(), 1u);
  ASSERT_FALSE(bad.ok());
  EXPECT_EQ(bad.error(), "b");
}

TEST(Result, ValueMayBeChangedInPlace) {
  auto result = half_of(4);
  *result = 9;
  EXPECT_EQ(result.value(), 9);
}

}  // namespace
}  // namespace skerry
