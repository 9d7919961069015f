// Rows of spokes: what they hold, where they lie, and what they leave out.
#include "server/plotter/plots/video_row.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "echo/kernel/isa.hpp"
#include "server/plotter/plots/row_kernels.hpp"
#include "tests/unit/plotter/made_spokes.hpp"

namespace skerry::server {
namespace {

Spoke spoke_of(const ScanGeometry& geometry, std::uint64_t n, double range_nm = 6.0) {
  MadeRadar radar;
  radar.geometry = geometry;
  radar.range_nm = range_nm;
  radar.noise_mean = 100.0;
  radar.noise_sigma = 40.0;
  return radar.spoke(n);
}

TEST(RowMaker, IsTheMeanOfItsSpokesAndOfItsCells) {
  struct Case {
    ScanGeometry geometry;
    double range_nm;
    std::uint32_t spokes, cells;  // of a row, of one of its cells
  };
  for (const Case& each : {Case{{2048, 1024, 8}, 6.0, 2, 1}, Case{{4096, 1024, 8}, 0.75, 4, 5},
                           Case{{8192, 4096, 8}, 0.75, 8, 8}, Case{{360, 512, 8}, 3.0, 1, 1},
                           Case{{250, 252, 8}, 0.25, 1, 4}, Case{{2048, 1024, 4}, 3.0, 2, 1}}) {
    RowMaker rows;
    const double scale = each.geometry.bits == 4 ? 17.0 : 1.0;
    std::vector<double> sums(each.geometry.cells / each.cells);
    for (std::uint64_t n = 0; n < 5 * each.spokes; ++n) {
      const Spoke spoke = spoke_of(each.geometry, n, each.range_nm);
      const bool closed = rows.add(spoke);
      ASSERT_EQ(closed, n > 0 && n % each.spokes == 0) << each.geometry.spokes_per_turn;
      if (closed) {
        ASSERT_EQ(rows.row().levels.size(), sums.size());
        for (std::size_t i = 0; i < sums.size(); ++i) {
          // Rounded down, once for the cells of a cell and once for the spokes of a row.
          const double mean = scale * sums[i] / (each.spokes * each.cells);
          ASSERT_LE(rows.row().levels[i], mean + 1e-9) << i;
          ASSERT_GT(rows.row().levels[i], mean - 2.0) << i;
        }
        std::fill(sums.begin(), sums.end(), 0.0);
      }
      for (std::size_t i = 0; i < sums.size(); ++i)
        for (std::uint32_t k = 0; k < each.cells; ++k) sums[i] += spoke.cells[i * each.cells + k];
    }
  }
}

TEST(RowMaker, BrightestVideoStaysBrightestHoweverManySpokes) {
  for (const std::uint32_t spokes : {128u, 1440u, 2048u, 8192u}) {
    for (const std::uint32_t bits : {4u, 8u}) {
      RowMaker rows;
      Spoke spoke = spoke_of({spokes, 256, bits}, 0);
      std::fill(spoke.cells.begin(), spoke.cells.end(), std::uint8_t(bits == 4 ? 15 : 255));
      int closed = 0;
      for (std::uint32_t i = 0; i < 80; ++i) {
        spoke.header.index = i;
        if (!rows.add(spoke)) continue;
        ++closed;
        for (const std::uint8_t level : rows.row().levels) ASSERT_EQ(level, 255) << spokes;
      }
      EXPECT_GT(closed, 0);
    }
  }
}

TEST(RowMaker, LiesInTheMiddleOfItsSpokesAndFollowsTheRowBefore) {
  RowMaker rows;
  const ScanGeometry geometry{4096, 256, 8};  // four spokes a row
  std::uint64_t n = 4000;
  while (!rows.add(spoke_of(geometry, n))) ++n;
  EXPECT_FALSE(rows.row().follows) << "the first one";
  std::uint64_t number = rows.row().number;
  for (++n; n < 4200; ++n) {
    if (!rows.add(spoke_of(geometry, n))) continue;
    EXPECT_TRUE(rows.row().follows) << "also over the bow";
    EXPECT_EQ(rows.row().number, ++number);
    const double middle = static_cast<double>(n % 4096) - 4.0 + 1.5;
    EXPECT_NEAR(std::remainder(rows.row().bearing.in_degrees() - middle * 360.0 / 4096.0, 360.0),
                0.0, 1e-6);
  }
  // A gap of a row.
  n = (n / 4 + 2) * 4;
  ASSERT_TRUE(rows.add(spoke_of(geometry, n)));
  n += 4;
  ASSERT_TRUE(rows.add(spoke_of(geometry, n)));
  EXPECT_FALSE(rows.row().follows);
}

TEST(RowMaker, LeavesOutWhatIsNoSpoke) {
  RowMaker rows;
  const Spoke good = spoke_of({2048, 256, 8}, 5);
  std::uint64_t left_out = 0;
  const auto refused = [&](auto&& change) {
    Spoke bad = good;
    change(bad);
    EXPECT_FALSE(rows.add(bad));
    EXPECT_EQ(rows.left_out(), ++left_out);
  };
  refused([](Spoke& s) { s.cells.clear(); });
  refused([](Spoke& s) { s.cells.pop_back(); });
  refused([](Spoke& s) {
    s.header.geometry.cells = 0;
    s.cells.clear();
  });
  refused([](Spoke& s) { s.header.geometry.spokes_per_turn = 0; });
  refused([](Spoke& s) { s.header.geometry.bits = 1; });
  refused([](Spoke& s) { s.header.index = 2048; });
  refused([](Spoke& s) {
    s.header.instrumented_range = metres(std::numeric_limits<double>::infinity());
  });
  refused([](Spoke& s) { s.header.instrumented_range = metres(1e-300); });
  refused([](Spoke& s) { s.header.instrumented_range = metres(1e12); });
  rows.add(good);
  refused([](Spoke&) {});  // twice
  // Not a number: the range scale holds.
  Spoke scale = good;
  scale.header.index = 6;
  scale.header.instrumented_range = metres(std::numeric_limits<double>::quiet_NaN());
  (void)rows.add(scale);
  EXPECT_EQ(rows.left_out(), left_out);
}

TEST(RowKernels, AreThePlainLoopsOnEveryInstructionSet) {
  std::uint64_t state = 3;
  for (const echo::Isa isa : {echo::Isa::baseline, echo::Isa::avx2, echo::Isa::avx512}) {
    echo::force_isa(isa);
    for (std::size_t count = 0; count < 130; ++count) {
      std::vector<std::uint8_t> cells(count), levels(count);
      std::vector<std::uint16_t> sums(count), before(count);
      for (std::size_t i = 0; i < count; ++i) {
        cells[i] = static_cast<std::uint8_t>(128.0 + 36.0 * next_draw(state));
        before[i] = sums[i] = static_cast<std::uint16_t>(4000.0 + 1000.0 * next_draw(state));
      }
      add_cells(cells.data(), sums.data(), count);
      constexpr std::uint32_t kScale = 65536 / 17 + 1;
      scale_sums(sums.data(), kScale, levels.data(), count);
      for (std::size_t i = 0; i < count; ++i) {
        ASSERT_EQ(sums[i], before[i] + cells[i]);
        ASSERT_EQ(levels[i], std::min(255u, sums[i] * kScale / 65536));
      }
      for (std::uint32_t joined = 1; joined <= kMostJoined; ++joined) {
        auto means_added = before;
        add_joined_cells(cells.data(), joined, means_added.data(), count / joined);
        for (std::size_t i = 0; i < count; ++i) {
          std::uint32_t sum = 0;
          for (std::size_t k = i * joined; k < (i + 1) * joined && i < count / joined; ++k)
            sum += cells[k];
          ASSERT_EQ(means_added[i], before[i] + sum / joined) << joined;
        }
      }
      const std::size_t blocks = count / kBlockCells;
      std::vector<std::int16_t> means(blocks), deviations(blocks);
      std::vector<std::uint8_t> greatest(blocks);
      if (count % 7 == 0)
        std::fill(cells.begin(), cells.begin() + static_cast<std::ptrdiff_t>(count / 2),
                  std::uint8_t{255});
      measure_blocks(cells.data(), blocks, means.data(), deviations.data(), greatest.data());
      for (std::size_t b = 0; b < blocks; ++b) {
        int sum = 0, off = 0, most = 0;
        for (std::size_t i = 0; i < kBlockCells; ++i) {
          sum += cells[b * kBlockCells + i];
          most = std::max<int>(most, cells[b * kBlockCells + i]);
        }
        for (std::size_t i = 0; i < kBlockCells; ++i)
          off += std::abs(16 * cells[b * kBlockCells + i] - sum);
        ASSERT_EQ(means[b], sum);
        ASSERT_EQ(deviations[b], off / 16);
        ASSERT_EQ(greatest[b], most);
      }
      std::vector<std::int16_t> uppers(count), lowers(count), widened(count);
      for (std::size_t b = 0; b < count; ++b) {
        lowers[b] = static_cast<std::int16_t>(cells[b] * 8);
        uppers[b] = static_cast<std::int16_t>(lowers[b] + 20 * (levels[b] % 32) - 40);
        widened[b] = static_cast<std::int16_t>(before[b] / 16);
      }
      const auto share = static_cast<std::int32_t>(count * 300);
      const auto narrow = widened;
      add_spreads(uppers.data(), lowers.data(), share, count, widened.data());
      for (std::size_t b = 0; b < count; ++b) {
        const int spread = std::clamp(uppers[b] - lowers[b] - narrow[b] * 5 / 8, 0, 2 * narrow[b]);
        ASSERT_EQ(widened[b], std::min(narrow[b] + spread * share / 256, 0x7fff));
      }
    }
  }
  echo::force_isa(echo::best_isa());
}

}  // namespace
}  // namespace skerry::server
