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

// Mean power of a cell in double, 1000 places to the cell; the peak by the same places.
std::vector<double> exact_shares(double pulse, double poles, double into, std::size_t cells) {
  double peak = 0.0;
  for (double x = 0.0; x < pulse + 20.0 / poles; x += 1e-3)
    peak = std::max(peak, range_voltage_reference(x, pulse, poles));
  std::vector<double> shares(cells, 0.0);
  for (std::size_t c = 0; c < cells; ++c) {
    for (int k = 0; k < 1000; ++k) {
      const double x = static_cast<double>(c) + (k + 0.5) / 1000.0 - into;
      if (x <= 0.0) continue;
      const double v = range_voltage_reference(x, pulse, poles) / peak;
      shares[c] += v * v / 1000.0;
    }
  }
  return shares;
}

TEST(RangeResponse, MatchesItsReference) {
  double worst = 0.0;
  for (const double pulse : {0.3, 1.0, 3.5, 12.0}) {
    for (const double poles : {0.3, 1.0, 4.0, 15.0}) {
      const RangeResponse response(pulse, poles);
      ASSERT_FALSE(response.is_box());
      for (const double into : {0.0, 0.2, 0.51, 0.99}) {
        std::vector<float> shares(response.cells());
        response.shares_of(into, shares);
        const auto exact = exact_shares(pulse, poles, into, shares.size());
        for (std::size_t c = 0; c < shares.size(); ++c)
          worst = std::max(worst, std::fabs(static_cast<double>(shares[c]) - exact[c]));
      }
    }
  }
  std::printf("worst mean over a cell: %.2g of the peak off\n", worst);
  EXPECT_LT(worst, 1e-3);
}

TEST(RangeResponse, RisesAndDecaysFromThePointOnWithAPeakOfOne) {
  const RangeResponse response(10.0, 0.8);
  std::vector<float> shares(response.cells());
  response.shares_of(0.0, shares);
  const auto peak = std::max_element(shares.begin(), shares.end());
  EXPECT_NEAR(*peak, 1.0, 0.02);
  EXPECT_TRUE(std::is_sorted(shares.begin(), peak));
  EXPECT_TRUE(std::is_sorted(shares.rbegin(), shares.rend() - (peak - shares.begin())));
  EXPECT_LT(shares.front(), 0.1f);
  EXPECT_LT(shares.back(), 1e-5f);
}

// A level 20 dB below the peak is reached 0.13 / B after the point's range, one 40 dB below 0.036 /
// B: x = 4 B t.
TEST(RangeResponse, TheLeadingEdgeIsLateByItsLevelOverTheBandwidth) {
  const auto late = [](double db) {
    const double level = std::pow(10.0, -db / 20.0);
    double x = 0.0;
    while (range_voltage_reference(x, 1e9, 1.0) < level) x += 1e-4;
    return x / 4.0;
  };
  EXPECT_NEAR(late(20.0), 0.133, 1e-3);
  EXPECT_NEAR(late(40.0), 0.037, 1e-3);
}

TEST(RangeResponse, OfAFastFilterIsTheBoxOfThePulse) {
  const RangeResponse response(3.5, RangeResponse::kFastest);
  ASSERT_TRUE(response.is_box());
  std::vector<float> shares(response.cells());
  response.shares_of(0.3, shares);
  const std::vector<float> expected = {0.7f, 1.0f, 1.0f, 0.8f, 0.0f};
  ASSERT_EQ(shares.size(), expected.size());
  for (std::size_t c = 0; c < expected.size(); ++c) EXPECT_NEAR(shares[c], expected[c], 1e-6) << c;
}

TEST(RangeResponse, TapsHoldTheWholeEchoHoweverLongItIs) {
  for (const double pulse : {1.0, 8.0, 60.0, 330.0}) {
    const RangeResponse response(pulse, 4.0 / pulse);
    std::vector<float> shares(response.cells());
    response.shares_of(0.0, shares);
    const double all = std::accumulate(shares.begin(), shares.end(), 0.0);
    const double taps = std::accumulate(response.taps().begin(), response.taps().end(), 0.0);
    EXPECT_NEAR(taps * response.tap_cells() / all, 1.0, 1e-4) << pulse;
    EXPECT_LE(response.taps().size(), RangeResponse::kMostTaps);
  }
}

TEST(RangeResponse, CoherenceOfABoxIsThatOfATriangle) {
  EXPECT_NEAR(coherence_cells(5.0, 0.0), 3.16, 0.01);
  // A fast filter changes little, a slow one makes it longer.
  EXPECT_NEAR(coherence_cells(5.0, 15.0), 3.16, 0.15);
  EXPECT_GT(coherence_cells(5.0, 0.8), 3.5);
}

TEST(RangeResponse, IsOneForAllWhoAskForTheSame) {
  RadarSet set;
  set.shapes_echoes = true;
  const RadarModel model =
      radar_model(set, {4096, 1024, 8}, *RangeScale::find(6.0), {24.0, 4096}, 0);
  EXPECT_EQ(range_response_for(model), range_response_for(model));
  EXPECT_FALSE(range_response_for(model)->is_box());
  set.shapes_echoes = false;
  EXPECT_TRUE(
      range_response_for(radar_model(set, {4096, 1024, 8}, *RangeScale::find(6.0), {24.0, 4096}, 0))
          ->is_box());
}

}  // namespace
}  // namespace skerry::echo
