// Blobs against a flood fill over the whole picture; their ends, their pieces and their bounds.
#include "server/plotter/plots/blob_builder.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "server/plotter/plots/blob_split.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {
namespace {

// A picture whose rows are strings, every row as wide: '#' is an echo.  `follows` of all rows but
// those that begin with '|', which stands for nothing.
std::vector<Blob> blobs_of(const std::vector<std::string>& picture, bool flush = true,
                           BlobBuilder* given = nullptr) {
  BlobBuilder own;
  BlobBuilder& builder = given != nullptr ? *given : own;
  std::vector<Blob> blobs;
  for (const std::string& line : picture) {
    std::vector<std::uint8_t> levels(line.size()), thresholds(line.size() / 16 + 1, 10);
    std::vector<Run> runs;
    for (std::size_t i = 0; i < line.size(); ++i) {
      levels[i] = line[i] == '#' ? 50 : 0;
      if (levels[i] == 0) continue;
      if (i > 0 && levels[i - 1] != 0) {
        runs.back().end = static_cast<std::uint32_t>(i + 1);
      } else {
        runs.push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(i + 1)});
      }
    }
    VideoRow row;
    row.width_rad = 0.006;
    row.cell_m = 5.0;
    row.follows = line[0] != '|';
    row.levels = levels;
    builder.add(row, runs, thresholds, blobs);
  }
  if (flush) builder.flush(blobs);
  return blobs;
}

TEST(BlobBuilder, JoinsWhatTouchesAlsoAtACornerAndLate) {
  const auto blobs = blobs_of({
      "..........................",
      ".##....#..#.....#...#.....",
      ".##...#...#.....#...#.....",
      ".....#....###...#.#.#..#..",
      "................#####..#..",
      "..........................",
  });
  ASSERT_EQ(blobs.size(), 5u);
  std::multiset<std::size_t> sizes;
  for (const Blob& blob : blobs) {
    sizes.insert(blob.cells.size());
    EXPECT_FALSE(blob.extended);
    EXPECT_FALSE(blob.cut);
    EXPECT_TRUE(std::is_sorted(blob.cells.begin(), blob.cells.end(),
                               [](const BlobCell& a, const BlobCell& b) {
                                 return std::pair(a.row, a.cell) < std::pair(b.row, b.cell);
                               }));
    EXPECT_EQ(blob.cells.front().row, 0);
    EXPECT_EQ(blob.cells.back().row + 1u, blob.rows.size());
    for (const BlobCell& cell : blob.cells) EXPECT_EQ(cell.over, 40);
  }
  EXPECT_EQ(sizes, (std::multiset<std::size_t>{2, 3, 4, 5, 12}));
}

TEST(BlobBuilder, AreThoseOfAFloodFill) {
  std::uint64_t state = 11;
  for (const double density : {-1.5, -0.8, -0.3, 0.2}) {
    for (int picture = 0; picture < 20; ++picture) {
      std::vector<std::string> lines(40, std::string(60, '.'));
      for (auto& line : lines)
        for (auto& cell : line) cell = next_draw(state) < density ? '#' : '.';
      lines.emplace_back(60, '.');
      lines.front() = std::string(60, '.');
      std::multiset<std::size_t> expected, got;
      auto left = lines;
      for (std::size_t r = 0; r < left.size(); ++r) {
        for (std::size_t c = 0; c < 60; ++c) {
          if (left[r][c] != '#') continue;
          std::vector<std::pair<std::size_t, std::size_t>> todo{{r, c}};
          left[r][c] = '.';
          std::size_t size = 0;
          while (!todo.empty()) {
            const auto [row, cell] = todo.back();
            todo.pop_back();
            ++size;
            for (std::size_t i = row > 0 ? row - 1 : 0; i <= std::min(row + 1, left.size() - 1);
                 ++i)
              for (std::size_t k = cell > 0 ? cell - 1 : 0;
                   k <= std::min<std::size_t>(cell + 1, 59); ++k)
                if (left[i][k] == '#') {
                  left[i][k] = '.';
                  todo.emplace_back(i, k);
                }
          }
          expected.insert(size);
        }
      }
      for (const Blob& blob : blobs_of(lines, false)) got.insert(blob.cells.size());
      ASSERT_EQ(got, expected) << density << " " << picture;
    }
  }
}

TEST(BlobBuilder, EndsARowAfterTheBeamAndIsCutWhereVideoIsMissing) {
  EXPECT_EQ(blobs_of({"....", ".##."}, false).size(), 0u);
  EXPECT_EQ(blobs_of({"....", ".##.", "...."}, false).size(), 1u);
  const auto blobs = blobs_of({"....", ".##.", "|##.", "....", ".#..", "...."});
  ASSERT_EQ(blobs.size(), 3u);
  EXPECT_TRUE(blobs[0].cut);
  EXPECT_TRUE(blobs[1].cut);
  EXPECT_FALSE(blobs[2].cut);
}

TEST(BlobBuilder, GoesOnInExtendedPiecesWhereItIsTooLarge) {
  // Too many rows.
  std::vector<std::string> lines(700, "..##....");
  lines.front() = lines.back() = "........";
  std::size_t cells = 0;
  auto blobs = blobs_of(lines);
  for (const Blob& blob : blobs) {
    EXPECT_TRUE(blob.extended);
    EXPECT_LE(blob.rows.size(), BlobBuilder::kMostRows);
    cells += blob.cells.size();
  }
  EXPECT_EQ(cells, 698u * 2);
  EXPECT_EQ(blobs.size(), 3u);
  // Too many cells.
  SplitScratch scratch;
  lines.assign(40, std::string(4000, '#'));
  blobs = blobs_of(lines);
  cells = 0;
  for (const Blob& blob : blobs) {
    EXPECT_TRUE(blob.extended);
    EXPECT_LE(blob.cells.size(), BlobBuilder::kMostCells);
    cells += blob.cells.size();
    EXPECT_TRUE(split(blob, 0.6, scratch).empty());
  }
  EXPECT_EQ(cells, 40u * 4000);
}

TEST(BlobBuilder, LeavesOutRunsBeyondItsBounds) {
  std::string line(8192, '.');
  for (std::size_t i = 1; i < line.size(); i += 2) line[i] = '#';
  BlobBuilder builder;
  const auto blobs =
      blobs_of({std::string(8192, '.'), line, std::string(8192, '.')}, true, &builder);
  EXPECT_EQ(blobs.size(), BlobBuilder::kMostOpen);
  EXPECT_EQ(builder.left_out(), 4096 - BlobBuilder::kMostOpen);
  // And goes on afterwards.
  EXPECT_EQ(blobs_of({"....", ".##.", "...."}, true, &builder).size(), 1u);
}

TEST(BlobSplit, CutsAtValleysAndNowhereElse) {
  SplitScratch scratch;
  const auto one = blobs_of({"......", ".####.", ".####.", ".####.", "......"});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_TRUE(split(one[0], 0.6, scratch).empty());
  const auto two =
      blobs_of({"...........", ".####.####.", ".#########.", ".####.####.", "..........."});
  ASSERT_EQ(two.size(), 1u);
  const auto parts = split(two[0], 0.6, scratch);
  ASSERT_EQ(parts.size(), 2u);
  EXPECT_EQ(parts[0].size() + parts[1].size(), two[0].cells.size());
  EXPECT_TRUE(split(two[0], 0.1, scratch).empty()) << "the valley is a third of the peaks";
}

}  // namespace
}  // namespace skerry::server
