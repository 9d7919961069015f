// Length: a distance on the water, in metres.
#pragma once

#include <compare>

namespace skerry {

// A distance, held in metres as a double; signed.  1 NM = 1852 m exactly (SI brochure, 8th ed.).
class Length {
 public:
  constexpr Length() = default;
  constexpr double in_metres() const { return metres_; }
  constexpr double in_nautical_miles() const { return metres_ / kMetresPerNauticalMile; }

  friend constexpr Length operator+(Length a, Length b) { return Length(a.metres_ + b.metres_); }
  friend constexpr Length operator-(Length a, Length b) { return Length(a.metres_ - b.metres_); }
  friend constexpr Length operator*(Length a, double k) { return Length(a.metres_ * k); }
  friend constexpr Length operator*(double k, Length a) { return Length(a.metres_ * k); }
  friend constexpr Length operator/(Length a, double k) { return Length(a.metres_ / k); }
  friend constexpr double operator/(Length a, Length b) { return a.metres_ / b.metres_; }
  friend constexpr auto operator<=>(Length, Length) = default;

  static constexpr double kMetresPerNauticalMile = 1852.0;

 private:
  explicit constexpr Length(double metres) : metres_(metres) {}
  friend constexpr Length metres(double value);
  double metres_ = 0.0;
};

constexpr Length metres(double value) { return Length(value); }
constexpr Length nautical_miles(double value) {
  return metres(value * Length::kMetresPerNauticalMile);
}

}  // namespace skerry
