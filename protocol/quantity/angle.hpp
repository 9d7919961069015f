// Angle: an amount of turn.  A direction on the circle is a Bearing (bearing.hpp).
#pragma once

#include <cmath>
#include <compare>
#include <numbers>

namespace skerry {

// Between degrees, radians and turns where angles are plain doubles.  A factor and its inverse
// round differently: `x * kRadiansPerDegree` and `x / kDegreesPerRadian` may differ in the last
// bit.
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;
inline constexpr double kRadiansPerTurn = 2.0 * std::numbers::pi;

// `degrees` (finite) brought into [0, 360).
inline double wrapped_degrees(double degrees) {
  const double rest = std::fmod(degrees, 360.0);
  const double positive = rest < 0.0 ? rest + 360.0 : rest;
  return positive < 360.0 ? positive + 0.0 : 0.0;  // a tiny negative rounds to 360; -0 becomes 0
}

// A signed, unbounded amount of turn, clockwise positive, held in degrees as a double: charted and
// counted angles are exact in degrees.
class Angle {
 public:
  constexpr Angle() = default;
  constexpr double in_degrees() const { return degrees_; }
  constexpr double in_radians() const { return degrees_ * kRadiansPerDegree; }

  friend constexpr Angle operator+(Angle a, Angle b) { return Angle(a.degrees_ + b.degrees_); }
  friend constexpr Angle operator-(Angle a, Angle b) { return Angle(a.degrees_ - b.degrees_); }
  friend constexpr Angle operator-(Angle a) { return Angle(-a.degrees_); }
  friend constexpr Angle operator*(Angle a, double k) { return Angle(a.degrees_ * k); }
  friend constexpr Angle operator*(double k, Angle a) { return Angle(a.degrees_ * k); }
  friend constexpr Angle operator/(Angle a, double k) { return Angle(a.degrees_ / k); }
  friend constexpr double operator/(Angle a, Angle b) { return a.degrees_ / b.degrees_; }
  friend constexpr auto operator<=>(Angle, Angle) = default;

 private:
  explicit constexpr Angle(double degrees) : degrees_(degrees) {}
  friend constexpr Angle degrees(double value);
  double degrees_ = 0.0;
};

constexpr Angle degrees(double value) { return Angle(value); }
constexpr Angle radians(double value) { return degrees(value * kDegreesPerRadian); }

}  // namespace skerry
