#include "protocol/video/spoke_resampler.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <random>
#include <utility>
#include <vector>

namespace skerry {
namespace {

struct Given {
  std::uint32_t index;
  std::uint64_t source_sequence;
  std::vector<std::uint8_t> cells;
  std::vector<DopplerClass> doppler;
};

class Turn {
 public:
  Turn(std::uint32_t spokes, std::uint32_t cells, std::uint64_t seed) {
    std::mt19937_64 random(seed);
    for (std::uint32_t i = 0; i < spokes; ++i) {
      Spoke spoke;
      spoke.header.sequence = 100 + i;
      spoke.header.index = i;
      spoke.header.geometry = {spokes, cells, 8};
      spoke.cells.resize(cells);
      for (std::uint8_t& cell : spoke.cells) {
        cell = random() % 5 == 0 ? static_cast<std::uint8_t>(random() % 256) : std::uint8_t{0};
      }
      spokes_.push_back(std::move(spoke));
    }
  }
  std::vector<Spoke>& spokes() { return spokes_; }

 private:
  std::vector<Spoke> spokes_;
};

std::vector<Given> resampled(const std::vector<Spoke>& spokes, std::uint32_t turn_spokes,
                             std::uint32_t cells) {
  SpokeResampler resampler(turn_spokes, cells);
  std::vector<Given> out;
  for (const Spoke& spoke : spokes) {
    resampler.add(spoke, [&](const ResampledSpoke& given) {
      EXPECT_EQ(given.header.geometry.spokes_per_turn, turn_spokes);
      EXPECT_EQ(given.header.geometry.cells, cells);
      out.push_back({given.header.index,
                     given.header.sequence,
                     {given.cells.begin(), given.cells.end()},
                     {given.doppler.begin(), given.doppler.end()}});
    });
  }
  return out;
}

// Which part of `to` holds the middle of part `i` of `from`, found by trying.
std::uint32_t home_of(std::uint32_t i, std::uint32_t from, std::uint32_t to) {
  const double middle = (i + 0.5) / from;
  for (std::uint32_t k = 0; k < to; ++k) {
    if (middle < (k + 1.0) / to - 1e-12) return k;
  }
  return to - 1;
}

struct Shape {
  std::uint32_t spokes, cells, to_spokes, to_cells;
};
class SpokeResamplerTest : public testing::TestWithParam<Shape> {};

TEST_P(SpokeResamplerTest, GivesEveryTargetSpokeOfATurnOnceAndInOrder) {
  const Shape shape = GetParam();
  Turn turn(shape.spokes, shape.cells, 1);
  const std::vector<Given> given = resampled(turn.spokes(), shape.to_spokes, shape.to_cells);
  ASSERT_EQ(given.size(), shape.to_spokes);
  for (std::uint32_t k = 0; k < shape.to_spokes; ++k) EXPECT_EQ(given[k].index, k);
}

TEST_P(SpokeResamplerTest, ShowsInEachCellTheStrongestOfThoseThatBelongThere) {
  const Shape shape = GetParam();
  Turn turn(shape.spokes, shape.cells, 2);
  const std::vector<Given> given = resampled(turn.spokes(), shape.to_spokes, shape.to_cells);
  const bool fewer_spokes = shape.to_spokes <= shape.spokes;
  const bool fewer_cells = shape.to_cells <= shape.cells;
  std::vector<std::uint32_t> home_spoke, home_cell;
  for (std::uint32_t i = 0; i < std::max(shape.spokes, shape.to_spokes); ++i) {
    home_spoke.push_back(fewer_spokes ? home_of(i, shape.spokes, shape.to_spokes)
                                      : home_of(i, shape.to_spokes, shape.spokes));
  }
  for (std::uint32_t j = 0; j < std::max(shape.cells, shape.to_cells); ++j) {
    home_cell.push_back(fewer_cells ? home_of(j, shape.cells, shape.to_cells)
                                    : home_of(j, shape.to_cells, shape.cells));
  }
  std::vector<std::uint8_t> want(std::size_t{shape.to_spokes} * shape.to_cells);
  const std::uint32_t finest_spokes = std::max(shape.spokes, shape.to_spokes);
  const std::uint32_t finest_cells = std::max(shape.cells, shape.to_cells);
  for (std::uint32_t i = 0; i < finest_spokes; ++i) {
    for (std::uint32_t j = 0; j < finest_cells; ++j) {
      const std::uint32_t source_spoke = fewer_spokes ? i : home_spoke[i];
      const std::uint32_t source_cell = fewer_cells ? j : home_cell[j];
      const std::uint32_t target_spoke = fewer_spokes ? home_spoke[i] : i;
      const std::uint32_t target_cell = fewer_cells ? home_cell[j] : j;
      std::uint8_t& cell = want[std::size_t{target_spoke} * shape.to_cells + target_cell];
      cell = std::max(cell, turn.spokes()[source_spoke].cells[source_cell]);
    }
  }
  ASSERT_EQ(given.size(), shape.to_spokes);
  for (std::uint32_t k = 0; k < shape.to_spokes; ++k) {
    const auto row = want.begin() + static_cast<std::ptrdiff_t>(std::size_t{k} * shape.to_cells);
    EXPECT_TRUE(std::equal(row, row + shape.to_cells, given[k].cells.begin())) << "spoke " << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Protocols, SpokeResamplerTest,
                         testing::Values(Shape{4096, 1024, 2048, 1024},
                                         Shape{4096, 1024, 1440, 705}, Shape{4096, 1024, 250, 231},
                                         Shape{2048, 512, 2048, 1024}, Shape{360, 300, 2048, 1024},
                                         Shape{256, 256, 256, 256}, Shape{8192, 4096, 250, 252},
                                         Shape{720, 900, 1440, 512}));

TEST(SpokeResamplerStreamTest, GivesASpokeAsSoonAsItsLastSourceSpokeHasCome) {
  Turn turn(4096, 256, 3);
  for (const Given& given : resampled(turn.spokes(), 1440, 256)) {
    const auto last = static_cast<std::uint32_t>(given.source_sequence - 100);
    EXPECT_EQ(home_of(last, 4096, 1440), given.index);
    if (last + 1 == 4096) continue;
    EXPECT_EQ(home_of(last + 1, 4096, 1440), given.index + 1);
  }
}

TEST(SpokeResamplerStreamTest, LosesNoEchoToAGap) {
  Turn turn(4096, 256, 4);
  std::vector<Spoke> spokes = turn.spokes();
  spokes.erase(spokes.begin() + 101, spokes.begin() + 1500);
  spokes[100].cells[7] = 255;  // the first of its target spoke, whose rest is lost
  ASSERT_EQ(home_of(100, 4096, 2048), home_of(101, 4096, 2048));
  const std::vector<Given> given = resampled(spokes, 2048, 256);
  const auto found =
      std::find_if(given.begin(), given.end(), [](const Given& one) { return one.index == 50; });
  ASSERT_NE(found, given.end());
  EXPECT_EQ(found->cells[7], 255);
  EXPECT_EQ((found + 1)->index, 750u);
}

TEST(SpokeResamplerStreamTest, DoesNotMixTwoRanges) {
  Turn turn(4096, 256, 5);
  std::vector<Spoke> spokes(turn.spokes().begin(), turn.spokes().begin() + 4);
  for (std::size_t i = 0; i < 4; ++i)
    std::fill(spokes[i].cells.begin(), spokes[i].cells.end(), static_cast<std::uint8_t>(i + 1));
  spokes[3].header.instrumented_range = metres(5000);
  const std::vector<Given> given = resampled(spokes, 1024, 256);
  ASSERT_EQ(given.size(), 2u);
  EXPECT_EQ(given[0].cells[0], 3);
  EXPECT_EQ(given[1].cells[0], 4);
}

TEST(SpokeResamplerStreamTest, AStrongestCellBringsItsDopplerClass) {
  Turn turn(512, 256, 6);
  std::vector<Spoke> spokes(turn.spokes().begin(), turn.spokes().begin() + 2);
  for (Spoke& spoke : spokes) {
    std::fill(spoke.cells.begin(), spoke.cells.end(), std::uint8_t{10});
    spoke.doppler.assign(256, DopplerClass::none);
  }
  spokes[0].cells[20] = 90;
  spokes[0].doppler[20] = DopplerClass::approaching;
  spokes[1].cells[20] = 100;
  spokes[1].doppler[20] = DopplerClass::receding;
  spokes[0].cells[30] = 50;
  spokes[0].doppler[30] = DopplerClass::approaching;
  spokes[1].doppler[40] = DopplerClass::approaching;  // equal in strength to one that stands
  const std::vector<Given> given = resampled(spokes, 256, 256);
  ASSERT_EQ(given.size(), 1u);
  EXPECT_EQ(given[0].doppler[20], DopplerClass::receding);
  EXPECT_EQ(given[0].doppler[30], DopplerClass::approaching);
  EXPECT_EQ(given[0].doppler[40], DopplerClass::approaching);
  EXPECT_EQ(given[0].doppler[50], DopplerClass::none);
}

TEST(CellSharesTest, CoverTheSourceOnceFromEndToEnd) {
  for (const auto& [from, to] :
       {std::pair{1024u, 705u}, std::pair{4096u, 231u}, std::pair{256u, 256u}, std::pair{7u, 1u}}) {
    const CellShares shares(from, to);
    std::uint32_t next = 0;
    for (std::uint32_t c = 0; c < to; ++c) {
      EXPECT_EQ(shares.begin(c), next);
      EXPECT_GT(shares.end(c), shares.begin(c));
      next = shares.end(c);
    }
    EXPECT_EQ(next, from);
  }
}

}  // namespace
}  // namespace skerry
