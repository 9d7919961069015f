// The cheapest pairs, against all that there are.
#include "server/plotter/assignment/assignment.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <stdexcept>

namespace skerry::server {
namespace {

double cost_of(const std::vector<double>& costs, std::size_t columns, double alone,
               const std::vector<std::size_t>& pairs) {
  double sum = 0.0;
  for (std::size_t row = 0; row < pairs.size(); ++row)
    sum += pairs[row] == kUnpaired ? alone : costs[row * columns + pairs[row]];
  return sum;
}

// The slow reference: every row takes each free column, and none, in turn.
double least(const std::vector<double>& costs, std::size_t rows, std::size_t columns, double alone,
             std::size_t row, std::vector<bool>& taken) {
  if (row == rows) return 0.0;
  double best = alone + least(costs, rows, columns, alone, row + 1, taken);
  for (std::size_t c = 0; c < columns; ++c) {
    if (taken[c]) continue;
    taken[c] = true;
    best = std::min(best,
                    costs[row * columns + c] + least(costs, rows, columns, alone, row + 1, taken));
    taken[c] = false;
  }
  return best;
}

TEST(Assignment, IsTheCheapestOfAllThereAre) {
  std::mt19937 random(5);
  for (int round = 0; round < 400; ++round) {
    const std::size_t rows = random() % 6, columns = random() % 6;
    std::vector<double> costs(rows * columns);
    for (double& cost : costs) {
      cost = random() % 8 == 0 ? kNoPair : static_cast<double>(random() % 100);
      if (random() % 10 == 0) cost = 0.0;
    }
    const double alone = static_cast<double>(random() % 80);
    const auto pairs = cheapest_pairs(costs, rows, columns, alone);
    ASSERT_EQ(pairs.size(), rows);
    for (std::size_t row = 0; row < rows; ++row) {
      if (pairs[row] == kUnpaired) continue;
      ASSERT_LT(pairs[row], columns);
      EXPECT_EQ(std::count(pairs.begin(), pairs.end(), pairs[row]), 1);
      EXPECT_LE(costs[row * columns + pairs[row]], alone);
    }
    std::vector<bool> taken(columns);
    EXPECT_EQ(cost_of(costs, columns, alone, pairs), least(costs, rows, columns, alone, 0, taken))
        << "round " << round;
  }
}

TEST(Assignment, GivesUpANearPairForTwo) {
  // Row 0 could have column 0 for 1, but then row 1 has nothing.
  const std::vector<double> costs{1.0, 2.0, 1.0, kNoPair};
  EXPECT_EQ(cheapest_pairs(costs, 2, 2, 10.0), (std::vector<std::size_t>{1, 0}));
}

TEST(Assignment, RefusesCostsThatAreNone) {
  EXPECT_THROW(cheapest_pairs(std::vector<double>{1.0}, 1, 2, 1.0), std::invalid_argument);
  EXPECT_THROW(cheapest_pairs(std::vector<double>{-1.0}, 1, 1, 1.0), std::invalid_argument);
  EXPECT_THROW(cheapest_pairs(std::vector<double>{1.0}, 1, 1, kNoPair), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::server
