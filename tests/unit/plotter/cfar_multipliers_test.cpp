// Multipliers of the four CFARs against a table of figures computed apart from them.
#include "server/plotter/plots/cfar_multipliers.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace skerry::server {
namespace {

TEST(CfarMultipliers, AreThoseOfTheTable) {
  struct Row {
    std::uint32_t cells;
    double false_alarms, cell_mean, greatest_of, smallest_of, ordered;
  };
  for (const Row& row : {Row{16, 1e-2, 5.3363, 4.5827, 7.3052, 4.4251},
                         Row{16, 1e-3, 8.6388, 7.4873, 12.5997, 7.4214},
                         Row{16, 1e-4, 12.4525, 10.8710, 19.5567, 11.0802},
                         Row{16, 1e-6, 21.9420, 19.3556, 41.0567, 20.9542},
                         Row{32, 1e-4, 10.6727, 9.6307, 13.6305, 8.5801},
                         Row{32, 1e-6, 17.2776, 15.7242, 23.6065, 14.3985}}) {
    const std::uint32_t n = row.cells;
    const double p = row.false_alarms;
    EXPECT_NEAR(cell_mean_multiplier(n, p), row.cell_mean, 6e-5) << n << " " << p;
    EXPECT_NEAR(greatest_of_multiplier(n, p), row.greatest_of, 6e-5) << n << " " << p;
    EXPECT_NEAR(smallest_of_multiplier(n, p), row.smallest_of, 6e-5) << n << " " << p;
    EXPECT_NEAR(ordered_multiplier(n, 3 * n / 4, p), row.ordered, 6e-5) << n << " " << p;
  }
}

TEST(CfarMultipliers, SeeFadingEchoesAsPublished) {
  struct Row {
    double snr_db, cell_mean, ordered;
  };
  const double mean = cell_mean_multiplier(16, 1e-4), rank = ordered_multiplier(16, 12, 1e-4);
  for (const Row& row :
       {Row{10, .335, .292}, Row{13, .558, .514}, Row{16, .739, .707}, Row{20, .884, .868}}) {
    const double snr = std::pow(10.0, row.snr_db / 10.0);
    EXPECT_NEAR(cell_mean_detection(16, mean, snr), row.cell_mean, 6e-4) << row.snr_db;
    EXPECT_NEAR(ordered_detection(16, 12, rank, snr), row.ordered, 6e-4) << row.snr_db;
  }
}

TEST(CfarMultipliers, OfManyCellsAreThatOfKnownNoise) {
  // -ln P, plus what 1024 cells leave uncertain.
  EXPECT_NEAR(cell_mean_multiplier(1024, 1e-6), 13.8155, 0.1);
}

TEST(CfarMultipliers, RefuseWhatIsNone) {
  EXPECT_THROW(cell_mean_multiplier(0, 1e-3), std::invalid_argument);
  EXPECT_THROW(cell_mean_multiplier(1025, 1e-3), std::invalid_argument);
  EXPECT_THROW(cell_mean_multiplier(16, 0.0), std::invalid_argument);
  EXPECT_THROW(cell_mean_multiplier(16, 1.0), std::invalid_argument);
  EXPECT_THROW(greatest_of_multiplier(15, 1e-3), std::invalid_argument);
  EXPECT_THROW(smallest_of_multiplier(15, 1e-3), std::invalid_argument);
  EXPECT_THROW(ordered_multiplier(16, 0, 1e-3), std::invalid_argument);
  EXPECT_THROW(ordered_multiplier(16, 17, 1e-3), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::server
