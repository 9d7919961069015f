// The picture's estimators against real recordings: what SOURCES.md "Pictures" says they measure.
#include <gtest/gtest.h>

#include <array>
#include <boost/uuid/detail/sha1.hpp>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>

#include "echo/measure/picture_edge.hpp"
#include "echo/measure/picture_outline.hpp"
#include "echo/measure/picture_score.hpp"
#include "tests/unit/measure/picture_recording.hpp"

namespace skerry::test {
namespace {

using echo::PictureTurn;
using echo::PictureWindow;

const std::vector<NavicoSpoke>& spokes_of(const std::string& name, NavicoKind kind) {
  static std::map<std::string, std::vector<NavicoSpoke>> known;
  auto [at, is_new] = known.try_emplace(name);
  if (is_new) at->second = read_navico(recordings_folder() + "/" + name, kind);
  return at->second;
}

PictureTurn picture_of(const NavicoTurn& turn, double beam_deg) {
  return {kNavicoSpokes, kNavicoCells, turn.range_m / kNavicoCells, beam_deg, 15, turn.video};
}

// Turns of the HALO20 with the natural shore, and the sector it fills (reference_stats.json).
std::vector<NavicoTurn> halo_turns() {
  return turns_at(spokes_of("halo20-ranges.pcap.gz", NavicoKind::halo), 3183.0);
}
std::vector<NavicoTurn> lake_turns(double range_m) {
  return turns_at(spokes_of("3g-trueheading.pcap.gz", NavicoKind::br24), range_m);
}
constexpr double kHaloBeam = 4.9, kLakeBeam = 5.2;
const PictureWindow kHaloShore{.from_deg = 208.0, .to_deg = 352.0, .from_m = 100.0};
// The far shore of the lake; SOURCES.md "Pictures" does not say which sector it took.
const PictureWindow kLakeShore{.from_deg = 60.0, .to_deg = 190.0, .from_m = 100.0};
const PictureWindow kLakeShoreFarther{.from_deg = 90.0, .to_deg = 190.0, .from_m = 300.0};

std::string sha1_of_cells(const std::vector<NavicoSpoke>& spokes) {
  boost::uuids::detail::sha1 sha;
  for (const NavicoSpoke& spoke : spokes) sha.process_bytes(spoke.cells.data(), spoke.cells.size());
  unsigned digest[5];
  sha.get_digest(digest);
  std::string text;
  for (unsigned word : digest) {
    char hex[9];
    std::snprintf(hex, sizeof hex, "%08x", word);
    text += hex;
  }
  return text;
}

// Column `column` of a file's row in expected_decode.csv, from the end.
std::string expected(const std::string& file, std::size_t from_end) {
  std::ifstream table(recordings_folder() + "/expected_decode.csv");
  for (std::string row; std::getline(table, row);) {
    if (row.rfind(file, 0) != 0) continue;
    std::vector<std::string> cells;
    std::istringstream in(row);
    for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
    return cells.at(cells.size() - 1 - from_end);
  }
  return "";
}

class PictureOfARecording : public testing::Test {
 protected:
  void SetUp() override {
    if (recordings_folder().empty())
      GTEST_SKIP() << "no captures of real radars beside the repository";
  }
};

TEST_F(PictureOfARecording, IsDecodedAsTheIndependentDecoderDid) {
  const auto check = [](const std::string& file, NavicoKind kind) {
    const auto& spokes = spokes_of(file, kind);
    EXPECT_EQ(sha1_of_cells(spokes), expected(file, 0)) << file;
    std::uint64_t sum = 0;
    for (const NavicoSpoke& s : spokes) sum = std::accumulate(s.cells.begin(), s.cells.end(), sum);
    EXPECT_EQ(std::to_string(sum), expected(file, 3)) << file;
  };
  check("halo20-ranges.pcap.gz", NavicoKind::halo);
  check("3g-trueheading.pcap.gz", NavicoKind::br24);
  EXPECT_EQ(halo_turns().size(), 14u);
  EXPECT_EQ(lake_turns(1633.4).size(), 2u);
}

struct Averages {
  double below = 0.0, above = 0.0;
  std::vector<double> local;
};
Averages outline_of_all(const std::vector<NavicoTurn>& turns, double beam_deg,
                        const PictureWindow& window) {
  Averages mean;
  const auto n = static_cast<double>(turns.size());
  for (const NavicoTurn& turn : turns) {
    const auto d = echo::outline_dimensions(picture_of(turn, beam_deg), window, turn.range_m);
    mean.below += d.recorded.below / n;
    mean.above += d.recorded.above / n;
    mean.local.resize(d.local.size());
    for (std::size_t i = 0; i < d.local.size(); ++i) mean.local[i] += d.local[i].dimension / n;
  }
  return mean;
}

TEST_F(PictureOfARecording, HasTheOutlineDimensionPublished) {
  const Averages halo = outline_of_all(halo_turns(), kHaloBeam, kHaloShore);
  const Averages lake = outline_of_all(lake_turns(1633.4), kLakeBeam, kLakeShore);
  const Averages far = outline_of_all(lake_turns(3273.9), kLakeBeam, kLakeShore);
  std::printf("outline D below | above the beam: HALO20 %.3f | %.3f (published 1.017 | 1.399)\n",
              halo.below, halo.above);
  std::printf("  3G 1633 m %.3f | %.3f (1.046 | 1.340), 3G 3274 m %.3f | %.3f (1.089 | 1.261)\n",
              lake.below, lake.above, far.below, far.above);
  // Published with standard errors of 0.01 to 0.03.
  EXPECT_NEAR(halo.below, 1.017, 0.02);
  EXPECT_NEAR(halo.above, 1.399, 0.03);
  EXPECT_NEAR(lake.below, 1.046, 0.04);
  EXPECT_NEAR(lake.above, 1.340, 0.04);
  // One turn, another sector perhaps.
  EXPECT_NEAR(far.below, 1.089, 0.04);
  EXPECT_NEAR(far.above, 1.261, 0.1);

  // Dimensions by scale, half an octave each: 7.4, 10.5, 14.8 ... 167 m.  The published ones are up
  // to 5 % smaller, which is 0.025 in D, and one of these scatters by 0.03.
  const std::vector<double> published = {0.90, 0.95, 0.99, 1.03, 1.09,
                                         1.15, 1.21, 1.28, 1.35, 1.44};
  ASSERT_GE(halo.local.size(), published.size());
  for (std::size_t i = 0; i < published.size(); ++i) {
    EXPECT_NEAR(halo.local[i], published[i], 0.07) << i;
    if (i == 0) continue;
    EXPECT_GT(halo.local[i], halo.local[i - 1]) << i;
  }
}

TEST_F(PictureOfARecording, HasTheEdgeAndThicknessPublished) {
  const auto mean_of = [](const std::vector<NavicoTurn>& turns, double beam,
                          const PictureWindow& window) {
    echo::EdgeStatistics mean;
    const auto n = static_cast<double>(turns.size());
    for (const NavicoTurn& turn : turns) {
      const auto e = echo::edge_statistics(picture_of(turn, beam), window);
      for (std::size_t i = 0; i < 5; ++i) {
        mean.thickness_m[i] += e.thickness_m[i] / n;
        mean.first_to_last_m[i] += e.first_to_last_m[i] / n;
      }
      mean.mean_range_m += e.mean_range_m / n;
      mean.within_a_cell += e.within_a_cell / n;
      mean.change_p99_m += e.change_p99_m / n;
      mean.jumps += e.jumps / n;
    }
    return mean;
  };
  const auto halo = mean_of(halo_turns(), kHaloBeam, kHaloShore);
  const auto lake = mean_of(lake_turns(1633.4), kLakeBeam, kLakeShoreFarther);
  std::printf("thickness, m: HALO20 %.0f %.0f %.0f %.0f %.0f (published 103 121 165 239 395)\n",
              halo.thickness_m[0], halo.thickness_m[1], halo.thickness_m[2], halo.thickness_m[3],
              halo.thickness_m[4]);
  std::printf("  3G %.0f %.0f %.0f %.0f %.0f (published 89 104 142 190 263)\n", lake.thickness_m[0],
              lake.thickness_m[1], lake.thickness_m[2], lake.thickness_m[3], lake.thickness_m[4]);
  std::printf("edge: HALO20 within a cell %.3f, p99 %.0f m, over 100 m %.4f; 3G %.3f\n",
              halo.within_a_cell, halo.change_p99_m, halo.jumps, lake.within_a_cell);
  const std::array<double, 5> published_halo = {103, 121, 165, 239, 395};
  const std::array<double, 5> published_lake = {89, 104, 142, 190, 263};
  for (std::size_t i = 0; i < 5; ++i) {
    EXPECT_NEAR(halo.thickness_m[i], published_halo[i], 0.06 * published_halo[i]) << i;
    EXPECT_NEAR(lake.thickness_m[i], published_lake[i], 0.08 * published_lake[i]) << i;
  }
  EXPECT_NEAR(halo.first_to_last_m[0], 415, 21);
  EXPECT_NEAR(halo.first_to_last_m[2], 821, 21);
  EXPECT_NEAR(halo.first_to_last_m[4], 1212, 21);
  EXPECT_NEAR(halo.mean_range_m, 1487, 20);
  EXPECT_NEAR(lake.mean_range_m, 560, 10);
  EXPECT_NEAR(halo.within_a_cell, 0.84, 0.01);
  EXPECT_NEAR(lake.within_a_cell, 0.935, 0.015);  // published: 92 to 95 %
  EXPECT_GE(halo.change_p99_m, 66.0);             // published: 70 to 105 m
  EXPECT_LE(halo.change_p99_m, 105.0);
  EXPECT_GE(halo.jumps, 0.0025);  // published: 0.3 to 1 %
  EXPECT_LE(halo.jumps, 0.01);
}

TEST_F(PictureOfARecording, HasTheCorrelationPublished) {
  // The 3G's were taken of single turns all around (reference_stats.json; SOURCES.md "Pictures (f)"
  // has others for it, close to those of two turns' mean).
  const auto lake = lake_turns(1633.4);
  const auto one =
      echo::picture_correlation(picture_of(lake[0], kLakeBeam), PictureWindow{.from_m = 20.0});
  const std::array<double, 6> published_spoke = {0.947, 0.837, 0.618, 0.365, 0.158, 0.062};
  const std::array<double, 5> published_range = {0.803, 0.597, 0.337, 0.190, 0.108};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(one.spoke[i], published_spoke[i], 0.05) << i;
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(one.range[i], published_range[i], 0.05) << i;

  // The HALO20's agree with the mean of all turns where that is at least 6: the ship moves, so what
  // stays is smoother than any one turn.
  std::vector<NavicoTurn> turns = halo_turns();
  std::vector<PictureTurn> pictures;
  for (const NavicoTurn& turn : turns) pictures.push_back(picture_of(turn, kHaloBeam));
  const auto mean = echo::mean_picture_correlation(pictures, kHaloShore, 6.0);
  const std::array<double, 6> halo_spoke = {0.990, 0.964, 0.875, 0.641, 0.274, 0.015};
  const std::array<double, 5> halo_range = {0.983, 0.939, 0.798, 0.532, 0.258};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_NEAR(mean.spoke[i], halo_spoke[i], 0.11) << i;
  for (std::size_t i = 0; i < 5; ++i) EXPECT_NEAR(mean.range[i], halo_range[i], 0.04) << i;
  for (std::size_t i = 0; i < 2; ++i) EXPECT_NEAR(mean.spoke[i], halo_spoke[i], 0.01) << i;

  const auto single = echo::picture_correlation(pictures[0], kHaloShore);
  std::printf("spoke correlation of one turn: HALO20");
  for (double c : single.spoke) std::printf(" %.3f", c);
  std::printf(", 3G");
  for (double c : one.spoke) std::printf(" %.3f", c);
  std::printf("\nof the mean of 14 turns: HALO20");
  for (double c : mean.spoke) std::printf(" %.3f", c);
  std::printf(" |");
  for (double c : mean.range) std::printf(" %.3f", c);
  std::printf("\n");
  for (std::size_t i = 0; i < 4; ++i) EXPECT_LT(single.spoke[i], mean.spoke[i]) << i;
}

TEST_F(PictureOfARecording, HasTheScoreThatIsComparedWith) {
  const auto check = [](const std::vector<NavicoTurn>& turns, const PictureWindow& window,
                        const echo::RecordedPicture& expected) {
    const auto n = static_cast<double>(turns.size());
    echo::PictureScore mean;
    for (const NavicoTurn& turn : turns) {
      const auto s =
          echo::picture_score(picture_of(turn, expected.beam_deg), window, expected.range_m);
      mean.below_beam += s.below_beam / n;
      mean.above_beam += s.above_beam / n;
      mean.below_recorded += s.below_recorded / n;
      mean.above_recorded += s.above_recorded / n;
      mean.within_a_cell += s.within_a_cell / n;
      mean.change_p99_m += s.change_p99_m / n;
      for (std::size_t i = 0; i < 5; ++i) mean.thickness_m[i] += s.thickness_m[i] / n;
      for (std::size_t i = 0; i < 6; ++i) {
        mean.spoke_correlation[i] += s.spoke_correlation[i] / n;
        mean.range_correlation[i] += s.range_correlation[i] / n;
      }
    }
    const echo::PictureScore& e = expected.score;
    EXPECT_NEAR(mean.below_beam, e.below_beam, 0.001) << expected.name;
    EXPECT_NEAR(mean.above_beam, e.above_beam, 0.001) << expected.name;
    EXPECT_NEAR(mean.below_recorded, e.below_recorded, 0.001) << expected.name;
    EXPECT_NEAR(mean.above_recorded, e.above_recorded, 0.001) << expected.name;
    EXPECT_NEAR(mean.within_a_cell, e.within_a_cell, 0.001) << expected.name;
    EXPECT_NEAR(mean.change_p99_m, e.change_p99_m, 0.6) << expected.name;
    for (std::size_t i = 0; i < 5; ++i)
      EXPECT_NEAR(mean.thickness_m[i], e.thickness_m[i], 0.6) << expected.name << i;
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(mean.spoke_correlation[i], e.spoke_correlation[i], 0.001) << expected.name << i;
      EXPECT_NEAR(mean.range_correlation[i], e.range_correlation[i], 0.001) << expected.name << i;
    }
  };
  check(halo_turns(), kHaloShore, echo::kRecordedPictures[0]);
  check(lake_turns(1633.4), kLakeShoreFarther, echo::kRecordedPictures[1]);
}

}  // namespace
}  // namespace skerry::test
