#include "echo/clutter/sea_field.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "echo/clutter/gamma_law.hpp"
#include "tests/unit/clutter/clutter_scene.hpp"

namespace skerry::echo {
namespace {

SeaSurface blowing_from(double deg, double state = 3.16) {
  SeaSurface sea;
  sea.state = state;
  sea.wind_from_deg = deg;
  return sea;
}

struct Line {
  double bearing_deg;
  double east() const { return std::sin(bearing_deg * std::numbers::pi / 180.0); }
  double north() const { return std::cos(bearing_deg * std::numbers::pi / 180.0); }
};

double texture_of(const RankLaw& law, float x) {
  const float t = law.slope * std::clamp(x, law.low, law.high) + law.offset;
  double sum = 0.0;
  for (std::size_t k = law.terms.size(); k-- > 0;) sum = sum * t + law.terms[k];
  return std::exp2(sum);
}

// Texture of shape nu on `lines` lines 300 m apart at a time, moved along them by `shift_m`.
std::vector<double> texture(const SeaField& field, double nu, Line line, double shift_m,
                            double seconds, int lines = 60) {
  const RankLaw law = gamma_law(nu);
  std::vector<double> values;
  std::vector<float> row(2000);
  for (int k = 0; k < lines; ++k) {
    const PlanePoint from = {300.0 * k * line.north(), -300.0 * k * line.east()};
    field.sample(from, line.east(), line.north(), shift_m, 7.0, seconds, row);
    for (const float x : row) values.push_back(nu > 0.0 ? texture_of(law, x) : double{x});
  }
  return values;
}

TEST(SeaField, HasZeroMeanAndUnitVarianceAtAnyTime) {
  const SeaField field(blowing_from(70.0), 1);
  for (const double seconds : {0.0, 1.0, 2.0, 3.3, 1234.5, 8e6}) {
    double mean = 0.0, square = 0.0;
    const std::vector<double> values = texture(field, 0.0, {20.0}, 0.0, seconds);
    for (const double v : values) mean += v, square += v * v;
    mean /= static_cast<double>(values.size());
    square /= static_cast<double>(values.size());
    EXPECT_NEAR(mean, 0.0, 0.06) << seconds;
    EXPECT_NEAR(square, 1.0, 0.08) << seconds;
  }
}

// 1/e of the gamma texture's autocorrelation, against (pi/2)(U^2/g) sqrt(3 cos^2 + 1).
TEST(SeaField, MakesATextureOfTheLawsLength) {
  const SeaField field(blowing_from(0.0), 3);
  const double wind = 3.16 * std::pow(3.16, 0.8);
  for (const double angle : {0.0, 45.0, 90.0}) {
    const double c = std::cos(angle * std::numbers::pi / 180.0);
    const double law =
        0.5 * std::numbers::pi * wind * wind / 9.80665 * std::sqrt(3.0 * c * c + 1.0);
    for (const double nu : {0.2, 0.5, 1.0}) {
      double length = 0.7 * law;
      const std::vector<double> here = texture(field, nu, {angle}, 0.0, 10.0, 80);
      do {
        length += 0.02 * law;
      } while (correlation(here, texture(field, nu, {angle}, length, 10.0, 80)) >
               1.0 / std::numbers::e);
      std::printf("%3.0f deg from the wind, nu %.1f: %.1f m, law %.1f m\n", angle, nu, length, law);
      EXPECT_GE(length, (angle == 45.0 ? 0.75 : 0.85) * law);
      EXPECT_LE(length, 1.15 * law);
    }
  }
}

TEST(SeaField, IsFixedToTheSeaWhereverItIsLookedAtFrom) {
  const SeaField field(blowing_from(250.0), 5);
  // The same places from south and from north.
  std::vector<float> up(500), down(500);
  field.sample({100.0, 2000.0}, 0.0, 1.0, 0.0, 8.0, 77.0, up);
  field.sample({100.0, 2000.0 + 499 * 8.0}, 0.0, -1.0, 0.0, 8.0, 77.0, down);
  std::size_t off = 0;
  for (std::size_t i = 0; i < 500; ++i) off += std::fabs(up[i] - down[499 - i]) > 1e-5;
  EXPECT_LE(off, 5u);  // places half-way between two values
}

TEST(SeaField, DriftsDownwindAndIsForgottenInSeconds) {
  const SeaField field(blowing_from(0.0), 7);  // from north: towards the south
  const double group = 0.57 * 3.16 * std::pow(3.16, 0.8);
  const Line line{180.0};
  const std::vector<double> now = texture(field, 0.0, line, 0.0, 100.0, 80);
  std::vector<double> best;
  for (const double dt : {0.0, 1.0, 2.0, 4.0, 8.0}) {
    double most = -1.0, at = 0.0;
    for (double shift = -12.0; shift <= 48.0; shift += 3.0) {
      const double r = correlation(now, texture(field, 0.0, line, shift, 100.0 + dt, 80));
      if (r > most) most = r, at = shift;
    }
    std::printf("%.0f s later: correlation %.2f, %.0f m further (group %.1f m)\n", dt, most, at,
                group * dt);
    best.push_back(most);
    // The layers' own speeds lie within 20 % of it.
    if (dt > 0.0 && dt <= 2.0) {
      EXPECT_NEAR(at, group * dt, 0.25 * group * dt + 2.0);
    }
  }
  EXPECT_GT(best[0], 0.999);
  EXPECT_GT(best[1], 0.75);
  EXPECT_GT(best[2], 0.45);
  EXPECT_LT(best[3], 0.45);
  EXPECT_LT(best[4], 0.10);
}

TEST(SeaField, OfAnotherSeedIsAnotherSea) {
  const std::vector<double> a = texture(SeaField(blowing_from(0.0), 1), 0.0, {10.0}, 0.0, 5.0);
  const std::vector<double> b = texture(SeaField(blowing_from(0.0), 2), 0.0, {10.0}, 0.0, 5.0);
  EXPECT_NEAR(correlation(a, b), 0.0, 0.04);
}

}  // namespace
}  // namespace skerry::echo
