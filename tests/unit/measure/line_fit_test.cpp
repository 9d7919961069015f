#include "echo/measure/line_fit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace skerry::echo {
namespace {

TEST(LineFit, AgreesWithAFitDoneByHand) {
  // Mean x 3, Sxx 10, mean y 4, Sxy 13: y = 0.1 + 1.3 x, residuals 0.6 -0.7 0 -0.3 0.4.
  const std::vector<double> x = {1, 2, 3, 4, 5}, y = {2, 2, 4, 5, 7};
  const LineFit fit = fitted_line(x, y);
  EXPECT_NEAR(fit.slope, 1.3, 1e-12);
  EXPECT_NEAR(fit.intercept, 0.1, 1e-12);
  const double squares = 0.6 * 0.6 + 0.7 * 0.7 + 0.0 + 0.3 * 0.3 + 0.4 * 0.4;
  EXPECT_NEAR(fit.scatter, std::sqrt(squares / 3.0), 1e-12);
  EXPECT_NEAR(fit.slope_error, std::sqrt(squares / 3.0 / 10.0), 1e-12);
  EXPECT_NEAR(fit.error_at(7.0), std::sqrt(squares / 3.0 * (1.0 + 0.2 + 16.0 / 10.0)), 1e-12);
}

TEST(LineFit, FollowsThePointsThatAreSure) {
  // Errors 1 and 0.1: the two sure points at 0 and 1 make the line.
  const std::vector<double> x = {0, 1, 2}, y = {0, 1, 8}, weights = {1e6, 1e6, 1e-6};
  const LineFit fit = fitted_line(x, y, weights);
  EXPECT_NEAR(fit.slope, 1.0, 1e-6);
  EXPECT_NEAR(fit.at(2.0), 2.0, 1e-5);
  EXPECT_NEAR(fit.slope_error, 1e-3 * std::sqrt(2.0), 1e-6);
  // Equal weights 4 (errors 0.5) on a line: the errors count as stated.
  const std::vector<double> on = {1, 2, 3, 4}, equal = {4, 4, 4, 4}, at = {1, 2, 3, 4};
  EXPECT_NEAR(fitted_line(at, on, equal).slope_error, 0.5 / std::sqrt(5.0), 1e-12);
}

TEST(LineFit, OfOnePlaceIsNotANumber) {
  const std::vector<double> x = {3, 3, 3}, y = {1, 2, 3};
  EXPECT_TRUE(std::isnan(fitted_line(x, y).slope));
  EXPECT_TRUE(std::isnan(fitted_line({}, {}).slope));
}

TEST(Bootstrap, OfAMeanHasTheErrorOfAMean) {
  // 0 .. 99: the mean's standard error is sqrt(833.25 / 100) = 2.887; 400 draws tell it to 3.5 %.
  const auto mean = [](std::span<const std::uint32_t> drawn) {
    double sum = 0.0;
    for (std::uint32_t d : drawn) sum += d;
    return sum / static_cast<double>(drawn.size());
  };
  const Bootstrap chance = bootstrap(100, mean, 7);
  EXPECT_NEAR(chance.standard_error, 2.887, 4 * 0.035 * 2.887);
  EXPECT_NEAR(chance.interval95.low, 49.5 - 1.96 * 2.887, 1.5);
  EXPECT_NEAR(chance.interval95.high, 49.5 + 1.96 * 2.887, 1.5);
  EXPECT_EQ(chance.standard_error, bootstrap(100, mean, 7).standard_error);
  EXPECT_NE(chance.standard_error, bootstrap(100, mean, 8).standard_error);
}

TEST(Bootstrap, OfNothingIsNotANumber) {
  EXPECT_TRUE(std::isnan(bootstrap(0, [](auto) { return 1.0; }).standard_error));
  EXPECT_TRUE(std::isnan(bootstrap(5, [](auto) { return NAN; }).standard_error));
}

}  // namespace
}  // namespace skerry::echo
