// The metrics, against values that stand in other programs.
#include "server/plotter/judge/set_distance.hpp"

#include <gtest/gtest.h>

#include <stdexcept>
#include <vector>

namespace skerry::server {
namespace {

using Points = std::vector<PlanePoint>;

TEST(SetDistance, HasThePublishedValues) {
  const Points truth{{0, 0}, {1000, 0}};
  const Points three{{30, 40}, {1000, 60}, {3000, 0}};
  EXPECT_NEAR(ospa_m(truth, three, 200, 1), 103.333, 5e-4);
  EXPECT_NEAR(ospa_m(truth, three, 200, 2), 123.962, 5e-4);
  EXPECT_NEAR(gospa(truth, three, 200, 1).m, 210.0, 1e-9);
  EXPECT_NEAR(gospa(truth, three, 200, 2).m, 161.555, 5e-4);
  const Points off{{30, 40}, {1300, 0}};
  EXPECT_NEAR(ospa_m(truth, off, 200, 1), 125.0, 1e-9);
  EXPECT_NEAR(ospa_m(truth, off, 200, 2), 145.774, 5e-4);
  EXPECT_NEAR(gospa(truth, off, 200, 1).m, 250.0, 1e-9);
  EXPECT_NEAR(gospa(truth, off, 200, 2).m, 206.155, 5e-4);
}

TEST(SetDistance, CountsWhatIsMissedAndMadeUp) {
  const Points truth{{0, 0}, {1000, 0}}, told{{10, 0}, {5000, 0}, {7000, 0}};
  const Gospa gospa_of = gospa(truth, told, 200, 2);
  EXPECT_EQ(gospa_of.paired, 1u);
  EXPECT_EQ(gospa_of.missed, 1u);
  EXPECT_EQ(gospa_of.made_up, 2u);
}

TEST(SetDistance, OfNothingIsNothingAndOfNobodyTheCut) {
  EXPECT_EQ(ospa_m({}, {}, 100, 2), 0.0);
  EXPECT_EQ(gospa({}, {}, 100, 2).m, 0.0);
  const Points one{{0, 0}};
  EXPECT_EQ(ospa_m(one, {}, 100, 1), 100.0);
  EXPECT_EQ(ospa_m({}, one, 100, 1), 100.0);
}

TEST(SetDistance, RefusesACutOrAPowerThatIsNone) {
  EXPECT_THROW(ospa_m({}, {}, 0.0, 1), std::invalid_argument);
  EXPECT_THROW(gospa({}, {}, 1.0, 0.5), std::invalid_argument);
}

}  // namespace
}  // namespace skerry::server
