#include "server/plotter/motion/motion_model.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::server {
namespace {

// sin(x)/x-like coefficients of a turn by `rate` in `t` seconds, and their derivatives by the rate.
// Series up to the order at which the rest is below 1e-9 for |angle| <= 0.1.
struct TurnTerms {
  double s = 0.0, c = 0.0;      // sin, cos of the angle
  double sw = 0.0, cw = 0.0;    // sin(a) / w and (1 - cos(a)) / w
  double dsw = 0.0, dcw = 0.0;  // their derivatives by w
};
TurnTerms turn_terms(double rate, double t) {
  TurnTerms terms;
  const double a = rate * t;
  const echo::SinCos turn = echo::sin_cos_degrees(a * kDegreesPerRadian);
  terms.s = turn.sin;
  terms.c = turn.cos;
  if (std::fabs(a) < 0.1) {
    const double a2 = a * a;
    terms.sw = t * (1.0 - a2 / 6.0 * (1.0 - a2 / 20.0 * (1.0 - a2 / 42.0)));
    terms.cw = t * a / 2.0 * (1.0 - a2 / 12.0 * (1.0 - a2 / 30.0 * (1.0 - a2 / 56.0)));
    terms.dsw = -t * t * a / 3.0 * (1.0 - a2 / 10.0 * (1.0 - a2 / 28.0));
    terms.dcw = t * t / 2.0 * (1.0 - a2 / 4.0 * (1.0 - a2 / 18.0 * (1.0 - a2 / 40.0)));
  } else {
    terms.sw = terms.s / rate;
    terms.cw = (1.0 - terms.c) / rate;
    terms.dsw = (t * terms.c - terms.sw) / rate;
    terms.dcw = (t * terms.s - terms.cw) / rate;
  }
  return terms;
}

void step(MotionState& state, const MotionModel& model, double t) {
  MotionVector& x = state.mean;
  MotionMatrix f = MotionMatrix::Identity();
  const double ve = x(2), vn = x(3);
  if (model.turns) {
    // A coordinated turn (Bar-Shalom, Li and Kirubarajan 2001, section 11.7.1), clockwise.
    const TurnTerms q = turn_terms(x(4), t);
    f(0, 2) = q.sw, f(0, 3) = q.cw, f(1, 2) = -q.cw, f(1, 3) = q.sw;
    f(2, 2) = q.c, f(2, 3) = q.s, f(3, 2) = -q.s, f(3, 3) = q.c;
    f(0, 4) = q.dsw * ve + q.dcw * vn;
    f(1, 4) = -q.dcw * ve + q.dsw * vn;
    f(2, 4) = t * (-q.s * ve + q.c * vn);
    f(3, 4) = t * (-q.c * ve - q.s * vn);
    x(0) += q.sw * ve + q.cw * vn;
    x(1) += -q.cw * ve + q.sw * vn;
    x(2) = q.c * ve + q.s * vn;
    x(3) = -q.s * ve + q.c * vn;
  } else {
    f(0, 2) = f(1, 3) = t;
    f(4, 4) = 0.0;
    x(0) += t * ve;
    x(1) += t * vn;
    x(4) = 0.0;
  }
  MotionMatrix next = f * state.covariance * f.transpose();
  const double q = model.acceleration;
  for (const int axis : {0, 1}) {
    next(axis, axis) += q * t * t * t / 3.0;
    next(axis, axis + 2) += q * t * t / 2.0;
    next(axis + 2, axis) += q * t * t / 2.0;
    next(axis + 2, axis + 2) += q * t;
  }
  next(4, 4) += model.turns ? model.turn_change * t : model.turn_ahead * model.turn_ahead;
  state.covariance = 0.5 * (next + next.transpose());
}

}  // namespace

void predict(MotionState& state, const MotionModel& model, double seconds) {
  const double most = std::clamp(seconds, 0.0, 600.0);
  const auto steps = static_cast<int>(std::ceil(most / kLongestStep_s));
  for (int i = 0; i < steps; ++i) step(state, model, most / steps);
}

Innovation innovation(const MotionState& expected, const MeasuredPlace& measured) {
  Innovation found;
  found.off = measured.place - expected.mean.head<2>();
  found.covariance = expected.covariance.topLeftCorner<2, 2>() + measured.covariance;
  const double determinant = found.covariance.determinant();
  const double a = found.covariance(0, 0), b = found.covariance(0, 1), d = found.covariance(1, 1);
  found.distance2 = (d * found.off(0) * found.off(0) - 2.0 * b * found.off(0) * found.off(1) +
                     a * found.off(1) * found.off(1)) /
                    determinant;
  constexpr double kLog2OfE = 1.4426950408889634, kLog2OfTurn = 2.651496129472319;  // of 2 pi
  found.log2_density =
      -kLog2OfTurn - 0.5 * echo::exact_log2(determinant) - 0.5 * kLog2OfE * found.distance2;
  return found;
}

void correct(MotionState& state, const MeasuredPlace& measured, const Innovation& innovation) {
  const Eigen::Matrix<double, 5, 2> gain =
      state.covariance.leftCols<2>() * innovation.covariance.inverse();
  state.mean += gain * innovation.off;
  MotionMatrix keep = MotionMatrix::Identity();
  keep.leftCols<2>() -= gain;
  const MotionMatrix next =
      keep * state.covariance * keep.transpose() + gain * measured.covariance * gain.transpose();
  state.covariance = 0.5 * (next + next.transpose());
}

}  // namespace skerry::server
