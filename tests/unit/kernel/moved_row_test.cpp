#include "echo/kernel/moved_row.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <random>
#include <vector>

#include "tests/unit/kernel/every_isa.hpp"

namespace skerry::echo {
namespace {

std::vector<float> powers(std::size_t n, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> octaves(-20.0, 60.0);
  std::vector<float> out(n);
  for (float& p : out)
    p = random() % 5 == 0 ? 0.0f : static_cast<float>(std::exp2(octaves(random)));
  return out;
}

TEST(MovedRow, PacksWithinItsBound) {
  double worst = 0.0;
  on_every_isa([&] {
    for (std::size_t n = 0; n <= 67; ++n) {
      const auto power = powers(n, n);
      std::vector<PackedPower> packed(n);
      std::vector<float> peaks((n + kPackBlock - 1) / kPackBlock);
      pack_power(power, 1e-3f, packed, peaks);
      for (std::size_t i = 0; i < n; ++i) {
        const auto p = static_cast<double>(power[i]);
        if (power[i] < 1e-3f) {
          EXPECT_EQ(packed[i], 0);
        } else {
          worst = std::max(worst, std::fabs(unpacked_reference(packed[i]) / p - 1.0));
        }
      }
      for (std::size_t b = 0; b < peaks.size(); ++b) {
        float most = 0.0f;
        for (std::size_t i = b * kPackBlock; i < std::min(n, (b + 1) * kPackBlock); ++i)
          most = std::max(most, power[i]);
        EXPECT_EQ(peaks[b], most);
      }
    }
  });
  std::printf("worst error of packing: %.3g\n", worst);
  EXPECT_LE(worst, 0x1p-8);
}

// A row and three runs of it, count / 3, count / 2 and count cells long, apart by `gap`.
struct ThreeRuns {
  ThreeRuns(std::uint32_t count, std::uint32_t gap) : row(count + 1 + kRowPadding) {
    std::vector<float> peaks((row.size() + kPackBlock - 1) / kPackBlock);
    pack_power(powers(row.size(), 7 + count), 1e-3f, row, peaks);
    const std::uint32_t second = 5 + count / 3 + gap, third = second + count / 2 + gap;
    runs = {{row.data(), {0.3f, 0.7f, 1.25f, -0.002f}, 5, count / 3},
            {row.data() + count / 2, {1.0f, 0.0f, 0.75f, 0.001f}, second, count / 2},
            {row.data(), {0.6f, 0.4f, 1.0f, 0.0f}, third, count}};
    end = third + count;
  }
  std::vector<PackedPower> row;
  std::vector<MovedRun> runs;
  std::size_t end;
};

// Calls make(count, gap, behind) for all that may come up, on every instruction set, and compares
// the rows that it returns.
template <typename Make>
void same_on_every_isa(Make&& make) {
  std::vector<std::vector<float>> first;
  std::size_t isa = 0;
  on_every_isa([&] {
    std::size_t at = 0;
    for (std::uint32_t count = 0; count <= 67; ++count) {
      for (const std::uint32_t behind : {0u, 3u, 40u}) {
        for (const std::uint32_t gap : {0u, 1u, 21u}) {
          std::vector<float> row = make(count, gap, behind);
          if (isa == 0) {
            first.push_back(std::move(row));
          } else {
            EXPECT_EQ(row, first[at]);
          }
          ++at;
        }
      }
    }
    ++isa;
  });
}

TEST(MovedRow, IsAddedAsItsReferenceHasIt) {
  double worst = 0.0;
  same_on_every_isa([&](std::uint32_t count, std::uint32_t gap, std::uint32_t behind) {
    const ThreeRuns three(count, gap);
    std::vector<float> power(three.end + behind, 2.0f);
    std::vector<double> exact(power.size(), 2.0);
    add_moved(three.runs, power);
    add_moved_reference(three.runs, {}, 0.0f, exact);
    for (std::size_t i = 0; i < power.size(); ++i) {
      if (i < 5 || i >= three.end) {
        EXPECT_EQ(power[i], 2.0f) << "beside the runs";
      }
      worst = std::max(worst, std::fabs(static_cast<double>(power[i]) / exact[i] - 1.0));
    }
    return power;
  });
  std::printf("worst error of adding: %.3g\n", worst);
  EXPECT_LE(worst, 6e-7);
}

TEST(MovedRow, IsLaidAsItsReferenceHasIt) {
  double worst = 0.0;
  same_on_every_isa([&](std::uint32_t count, std::uint32_t gap, std::uint32_t behind) {
    const ThreeRuns three(count, gap);
    const std::size_t cells = three.end + behind;
    // Alone, and two at once.
    std::vector<std::vector<float>> power(3, std::vector<float>(cells + kRowPadding, 2.0f));
    std::vector<std::vector<PackedPower>> speckle;
    for (const std::uint32_t seed : {99u, 98u}) {
      speckle.emplace_back();
      for (const float s : powers(cells + kRowPadding, seed + count))
        speckle.back().push_back(packed_value(s));
    }
    const auto row = [&](std::size_t s, std::size_t k) {
      return SpeckledRow{speckle[s], std::span(power[k]).first(cells)};
    };
    lay_moved(three.runs, 0.4f, row(0, 0));
    lay_moved(three.runs, 0.4f, row(1, 1), row(0, 2));
    for (auto& p : power) p.resize(cells);
    EXPECT_EQ(power[0], power[2]);
    for (std::size_t k = 0; k < 2; ++k) {
      std::vector<double> exact(cells, 0.0);
      std::vector<float> unpacked;
      for (const PackedPower s : speckle[k]) unpacked.push_back(unpacked_value(s));
      add_moved_reference(three.runs, unpacked, 0.4f, exact);
      for (std::size_t i = 0; i < cells; ++i) {
        if (exact[i] == 0.0) {
          EXPECT_EQ(power[k][i], 0.0f);
        } else {
          worst = std::max(worst, std::fabs(static_cast<double>(power[k][i]) / exact[i] - 1.0));
        }
      }
    }
    return power[1];
  });
  std::printf("worst error of laying: %.3g\n", worst);
  EXPECT_LE(worst, 6e-7);
}

}  // namespace
}  // namespace skerry::echo
