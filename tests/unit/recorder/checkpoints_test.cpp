#include "server/recorder/checkpoints.hpp"

#include <gtest/gtest.h>
#include <openssl/sha.h>

#include <string>

namespace skerry::server {
namespace {

FramedSpoke spoke_of(const std::string& bytes, std::uint64_t sequence, double seconds) {
  return {.bytes = {reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
          .sequence = sequence,
          .utc = UtcTime(seconds_as_duration(seconds))};
}

std::string sha256(const std::string& bytes) {
  std::string digest(SHA256_DIGEST_LENGTH, '\0');
  SHA256(reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size(),
         reinterpret_cast<unsigned char*>(digest.data()));
  return digest;
}

TEST(Checkpoints, EndAfterTwoSecondsOfSpokes) {
  Checkpoints checkpoints;
  std::string all;
  for (std::uint64_t i = 0; i < 60; ++i) {
    const std::string bytes = "spoke " + std::to_string(i);
    all += bytes;
    EXPECT_FALSE(checkpoints.add(1, 2, spoke_of(bytes, 100 + i, static_cast<double>(i) / 30.0)));
  }
  const auto ended = checkpoints.add(1, 2, spoke_of("next", 160, 2.0));
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->checkpoint().radar(), 1u);
  EXPECT_EQ(ended->checkpoint().view(), 2u);
  EXPECT_EQ(ended->checkpoint().first_sequence(), 100u);
  EXPECT_EQ(ended->checkpoint().spokes(), 60u);
  EXPECT_EQ(ended->checkpoint().sha256(), sha256(all));
  const auto last = checkpoints.take();
  ASSERT_TRUE(last);
  EXPECT_EQ(last->checkpoint().first_sequence(), 160u);
  EXPECT_EQ(last->checkpoint().sha256(), sha256("next"));
  EXPECT_FALSE(checkpoints.take());
}

TEST(Checkpoints, HaveNoGapInThem) {
  Checkpoints checkpoints;
  EXPECT_FALSE(checkpoints.add(0, 0, spoke_of("a", 1, 0.0)));
  EXPECT_FALSE(checkpoints.add(1, 0, spoke_of("x", 9, 0.0)));
  EXPECT_FALSE(checkpoints.add(0, 0, spoke_of("b", 2, 0.1)));
  const auto ended = checkpoints.add(0, 0, spoke_of("d", 4, 0.3));
  ASSERT_TRUE(ended);
  EXPECT_EQ(ended->checkpoint().spokes(), 2u);
  EXPECT_EQ(ended->checkpoint().sha256(), sha256("ab"));
  EXPECT_EQ(checkpoints.take()->checkpoint().first_sequence(), 4u);
  EXPECT_EQ(checkpoints.take()->checkpoint().first_sequence(), 9u);
  EXPECT_FALSE(checkpoints.take());
}

}  // namespace
}  // namespace skerry::server
