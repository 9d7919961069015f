// What a filter knows of a target: place, velocity and rate of turn, with their covariance.
#pragma once

#include <Eigen/Core>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {

// East and north in m, east and north in m/s, rate of turn in rad/s, clockwise.
using MotionVector = Eigen::Matrix<double, 5, 1>;
using MotionMatrix = Eigen::Matrix<double, 5, 5>;
using PlaceMatrix = Eigen::Matrix2d;
using PlaceVector = Eigen::Vector2d;

struct MotionState {
  MotionVector mean = MotionVector::Zero();
  MotionMatrix covariance = MotionMatrix::Identity();

  PlanePoint place() const { return {mean(0), mean(1)}; }
  PlanePoint velocity() const { return {mean(2), mean(3)}; }
};

// A place as it was measured, with its covariance in m^2, positive definite.
struct MeasuredPlace {
  PlaceVector place = PlaceVector::Zero();
  PlaceMatrix covariance = PlaceMatrix::Identity();
};

// How far a measured place is from where it was expected.
struct Innovation {
  PlaceVector off = PlaceVector::Zero();  // m, measured less expected
  PlaceMatrix covariance = PlaceMatrix::Identity();
  double distance2 = 0.0;     // off in standard deviations, squared (Mahalanobis)
  double log2_density = 0.0;  // base-2 logarithm of the density there, 1/m^2
};
Innovation innovation(const MotionState& expected, const MeasuredPlace& measured);

// The Kalman filter's step, in Joseph's form: the covariance stays symmetric and positive (Bucy and
// Joseph 1968; Bar-Shalom, Li and Kirubarajan 2001, "Estimation with Applications to Tracking and
// Navigation", eq. 5.2.3-18).
void correct(MotionState& state, const MeasuredPlace& measured, const Innovation& innovation);

}  // namespace skerry::server
