#include "echo/radar/range_response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <vector>

#include "echo/radar/shipped_sets.hpp"

namespace skerry::echo {
namespace {

constexpr RangeFilter kFilters[] = {RangeFilter::two_poles, RangeFilter::gaussian};

// Mean power in double, 1000 places to the cell, of cells from `first` on; the peak by the same
// places.
std::vector<double> exact_shares(const RangeShape& shape, double into, double first,
                                 std::size_t cells) {
  const double pulse = std::max(1.0, shape.pulse_cells), reach = 5.0 / shape.bandwidth_cells;
  double peak = 0.0;
  for (double x = -reach; x < pulse + reach; x += 1e-3)
    peak = std::max(peak, range_voltage_reference(x, shape));
  std::vector<double> shares(cells, 0.0);
  for (std::size_t c = 0; c < cells; ++c) {
    for (int k = 0; k < 1000; ++k) {
      const double x = first + static_cast<double>(c) + (k + 0.5) / 1000.0 - into;
      const double v = range_voltage_reference(x, shape) / peak;
      shares[c] += v * v / 1000.0;
    }
  }
  return shares;
}

std::vector<float> shares_of(const RangeResponse& response, double into) {
  std::vector<float> shares(response.cells());
  response.shares_of(into, shares);
  return shares;
}

TEST(RangeResponse, MatchesItsReference) {
  double worst = 0.0;
  for (const RangeFilter filter : kFilters) {
    for (const double pulse : {0.3, 1.0, 3.5, 12.0}) {
      for (const double bandwidth : {0.08, 0.25, 1.0, 3.7}) {
        const RangeShape shape{filter, pulse, bandwidth};
        const RangeResponse response(shape);
        ASSERT_FALSE(response.is_box());
        for (const double into : {0.0, 0.2, 0.51, 0.99}) {
          const std::vector<float> shares = shares_of(response, into);
          const auto exact = exact_shares(shape, into, -1.0 * response.lead(), shares.size());
          for (std::size_t c = 0; c < shares.size(); ++c)
            worst = std::max(worst, std::fabs(static_cast<double>(shares[c]) - exact[c]));
        }
      }
    }
  }
  std::printf("worst mean over a cell: %.2g of the peak off\n", worst);
  EXPECT_LT(worst, 1e-3);
}

TEST(RangeResponse, RisesAndDecaysWithAPeakOfOne) {
  for (const RangeFilter filter : kFilters) {
    const std::vector<float> shares = shares_of(RangeResponse({filter, 10.0, 0.2}), 0.0);
    const auto peak = std::max_element(shares.begin(), shares.end());
    EXPECT_NEAR(*peak, 1.0, 0.02);
    EXPECT_TRUE(std::is_sorted(shares.begin(), peak));
    EXPECT_TRUE(std::is_sorted(shares.rbegin(), shares.rend() - (peak - shares.begin())));
    EXPECT_LT(shares.front(), 0.1f);
    EXPECT_LT(shares.back(), 1e-5f);
  }
}

TEST(RangeResponse, OfTwoPolesBeginsAtThePointAndOfAGaussianIsAlikeOnBothSides) {
  EXPECT_EQ(RangeResponse({RangeFilter::two_poles, 10.0, 0.2}).lead(), 0u);
  const RangeResponse response({RangeFilter::gaussian, 10.0, 0.2});
  EXPECT_EQ(response.lead(), 5u);
  const std::vector<float> shares = shares_of(response, 0.0);
  for (std::size_t k = 0; k < 10; ++k) {  // about the pulse's middle, 5 cells behind the point
    EXPECT_NEAR(shares[9 - k], shares[10 + k], 1e-5) << k;
  }
}

// A level 20 dB below the peak of a long echo is reached 0.13 / B after the point's range behind
// two poles and 0.36 / B before it behind a Gaussian; one 40 dB below 0.036 / B and 0.66 / B.
TEST(RangeResponse, TheLeadingEdgeLiesByItsLevelOverTheBandwidth) {
  const auto edge = [](RangeFilter filter, double db) {
    const double level = std::pow(10.0, -db / 20.0);
    double x = -2.0;
    while (range_voltage_reference(x, {filter, 1e9, 1.0}) < level) x += 1e-4;
    return x;
  };
  EXPECT_NEAR(edge(RangeFilter::two_poles, 20.0), 0.133, 1e-3);
  EXPECT_NEAR(edge(RangeFilter::two_poles, 40.0), 0.037, 1e-3);
  EXPECT_NEAR(edge(RangeFilter::gaussian, 6.02), 0.0, 1e-3);
  EXPECT_NEAR(edge(RangeFilter::gaussian, 20.0), -0.361, 1e-3);
  EXPECT_NEAR(edge(RangeFilter::gaussian, 40.0), -0.656, 1e-3);
}

TEST(RangeResponse, OfAFastFilterIsTheBoxOfThePulse) {
  for (const RangeFilter filter :
       {RangeFilter::none, RangeFilter::two_poles, RangeFilter::gaussian}) {
    const RangeResponse response({filter, 3.5, RangeResponse::kFastest});
    ASSERT_TRUE(response.is_box());
    EXPECT_EQ(response.lead(), 0u);
    const std::vector<float> shares = shares_of(response, 0.3);
    const std::vector<float> expected = {0.7f, 1.0f, 1.0f, 0.8f, 0.0f};
    ASSERT_EQ(shares.size(), expected.size());
    for (std::size_t c = 0; c < expected.size(); ++c)
      EXPECT_NEAR(shares[c], expected[c], 1e-6) << c;
  }
}

TEST(RangeResponse, TapsHoldTheWholeEchoHoweverLongItIs) {
  for (const RangeFilter filter : kFilters) {
    for (const double pulse : {1.0, 8.0, 60.0, 330.0}) {
      const RangeResponse response({filter, pulse, 1.0 / pulse});
      const std::vector<float> shares = shares_of(response, 0.0);
      const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
      const double taps = std::accumulate(response.taps().begin(), response.taps().end(), 0.0);
      EXPECT_NEAR(taps * response.tap_cells() / all, 1.0, 1e-4) << pulse;
      EXPECT_LE(response.taps().size(), RangeResponse::kMostTaps);
    }
  }
}

TEST(RangeResponse, CoherenceOfABoxIsThatOfATriangle) {
  EXPECT_NEAR(coherence_cells({RangeFilter::none, 5.0, 0.2}), 3.16, 0.01);
  // A fast filter changes little, a slow one makes it longer.
  for (const RangeFilter filter : kFilters) {
    EXPECT_NEAR(coherence_cells({filter, 5.0, 3.75}), 3.16, 0.15);
    EXPECT_GT(coherence_cells({filter, 5.0, 0.2}), 3.5);
  }
}

TEST(RangeResponse, IsOneForAllWhoAskForTheSame) {
  RadarSet set;
  set.range_filter = RangeFilter::gaussian;
  const RadarModel model =
      radar_model(set, {4096, 1024, 8}, *RangeScale::find(6.0), {24.0, 4096}, 0);
  EXPECT_EQ(range_response_for(model), range_response_for(model));
  EXPECT_FALSE(range_response_for(model)->is_box());
  set.range_filter = RangeFilter::none;
  EXPECT_TRUE(
      range_response_for(radar_model(set, {4096, 1024, 8}, *RangeScale::find(6.0), {24.0, 4096}, 0))
          ->is_box());
}

}  // namespace
}  // namespace skerry::echo
