#include "server/plotter/judge/baselines/cv_filter.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace skerry::server {

CvState cv_begun(PlanePoint place, double place_variance, double velocity_variance) {
  CvState state{place, {}, {}};
  state.p[0][0] = state.p[1][1] = place_variance;
  state.p[2][2] = state.p[3][3] = velocity_variance;
  return state;
}

void cv_predict(CvState& state, double dt_s, double variance) {
  state.place = state.place + state.velocity_mps * dt_s;
  auto& p = state.p;
  // F P F': rows, then columns.
  for (std::size_t i : {std::size_t{0}, std::size_t{1}})
    for (std::size_t j = 0; j < 4; ++j) p[i][j] += dt_s * p[i + 2][j];
  for (std::size_t j : {std::size_t{0}, std::size_t{1}})
    for (std::size_t i = 0; i < 4; ++i) p[i][j] += dt_s * p[i][j + 2];
  const double dt_2 = dt_s * dt_s;
  for (std::size_t i : {std::size_t{0}, std::size_t{1}}) {
    p[i][i] += variance * dt_2 * dt_2 / 4.0;
    p[i][i + 2] += variance * dt_2 * dt_s / 2.0;
    p[i + 2][i] += variance * dt_2 * dt_s / 2.0;
    p[i + 2][i + 2] += variance * dt_2;
  }
}

double cv_update(CvState& state, PlanePoint innovation, const PlaceVariance& r) {
  auto& p = state.p;
  const double s00 = p[0][0] + r.east, s01 = p[0][1] + r.across, s11 = p[1][1] + r.north;
  const double determinant = s00 * s11 - s01 * s01;
  if (!(determinant > 0.0)) return 0.0;
  const double i00 = s11 / determinant, i01 = -s01 / determinant, i11 = s00 / determinant;
  std::array<std::array<double, 2>, 4> k{};
  for (std::size_t i = 0; i < 4; ++i) {
    k[i][0] = p[i][0] * i00 + p[i][1] * i01;
    k[i][1] = p[i][0] * i01 + p[i][1] * i11;
  }
  const double e = innovation.east_m, n = innovation.north_m;
  state.place = state.place + PlanePoint{k[0][0] * e + k[0][1] * n, k[1][0] * e + k[1][1] * n};
  state.velocity_mps =
      state.velocity_mps + PlanePoint{k[2][0] * e + k[2][1] * n, k[3][0] * e + k[3][1] * n};
  const auto before = p;
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) p[i][j] -= k[i][0] * before[0][j] + k[i][1] * before[1][j];
  const double square = e * e * i00 + 2.0 * e * n * i01 + n * n * i11;
  return std::exp(-0.5 * square) / (2.0 * std::numbers::pi * std::sqrt(determinant));
}

}  // namespace skerry::server
