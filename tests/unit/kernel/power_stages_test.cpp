#include "echo/kernel/power_stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

// Powers over sixty decibels, some of them none at all.
std::vector<float> any_powers(std::size_t cells, std::uint32_t seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> octaves(-20.0, 20.0);
  std::vector<float> powers(cells);
  for (float& p : powers)
    p = random() % 7 == 0 ? 0.0f : static_cast<float>(std::exp2(octaves(random)));
  return powers;
}

TEST(PowerStages, SharpenAsTheirReferenceHasIt) {
  const SharpeningLaw law = {0.1f, 0.2f, 0.3f, 0.4f};
  on_every_isa([&] {
    for (std::size_t n : {1u, 15u, 16u, 33u, 1000u}) {
      auto row = any_powers(n, 3);
      auto most = any_powers(n, 4);
      keep_most(most, row);
      const auto before = row;
      sharpen_row(row, most, law);
      for (std::size_t i = 0; i < n; ++i) {
        ASSERT_GE(most[i], before[i]);
        const double exact = sharpened_reference(before[i], most[i], law);
        if (before[i] == 0.0f) {
          EXPECT_EQ(row[i], 0.0f);
        } else {
          ASSERT_NEAR(row[i], exact, 6e-7 * exact);
        }
      }
    }
  });
}

TEST(PowerStages, ARowAgainstItselfStaysAsItIs) {
  auto row = any_powers(300, 5);
  const auto before = row;
  sharpen_row(row, before, {0.0f, 0.0f, 0.0f, 1.0f});
  EXPECT_EQ(row, before);
}

TEST(PowerStages, BoostAsItsReferenceHasItAndKeepTheOrderOfPowers) {
  on_every_isa([&] {
    auto row = any_powers(1000, 6);
    std::sort(row.begin(), row.end());
    const auto before = row;
    boost_row(row, 9.0f, 1000.0f);
    for (std::size_t i = 0; i < row.size(); ++i) {
      const double exact = boosted_reference(before[i], 9.0, 1000.0);
      ASSERT_NEAR(row[i], exact, 6e-7 * exact);
    }
    EXPECT_TRUE(std::is_sorted(row.begin(), row.end()));
    EXPECT_GT(row[before.size() / 2], before[before.size() / 2]);
  });
}

TEST(PowerStages, SuppressWhatIsFarBelowTheStrongest) {
  on_every_isa([&] {
    std::vector<float> power(67, 10.0f), a(67, 0.0f), b(67, 0.0f), row = power;
    a[3] = 1e4f;   // -30 dB: stays
    a[20] = 2e6f;  // -53 dB: goes
    b[40] = 2e6f;
    suppress_row(row, power, a, b, 1e-5f);
    for (std::size_t i = 0; i < row.size(); ++i)
      EXPECT_EQ(row[i], i == 20 || i == 40 ? 0.0f : 10.0f) << i;
  });
}

TEST(PowerStages, GatesKeepWhatIsAsStrongAsTheyAre) {
  on_every_isa([&] {
    std::vector<std::uint8_t> video(70), least(70, 20);
    for (std::size_t i = 0; i < video.size(); ++i) video[i] = static_cast<std::uint8_t>(i);
    gate_video(video, least);
    for (std::size_t i = 0; i < video.size(); ++i) EXPECT_EQ(video[i], i < 20 ? 0 : i);
  });
}

}  // namespace
}  // namespace skerry::echo
