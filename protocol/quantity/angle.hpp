// Angle: an amount of turn.  A direction on the circle is a Bearing (bearing.hpp).
#pragma once

#include <compare>
#include <numbers>

namespace skerry {

// A signed, unbounded amount of turn, clockwise positive, held in degrees as a double: charted and
// counted angles are exact in degrees.
class Angle {
 public:
  constexpr Angle() = default;
  constexpr double in_degrees() const { return degrees_; }
  constexpr double in_radians() const { return degrees_ * (std::numbers::pi / 180.0); }

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
constexpr Angle radians(double value) { return degrees(value * (180.0 / std::numbers::pi)); }

}  // namespace skerry
