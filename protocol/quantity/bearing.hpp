// Bearing: a direction on the circle, in a named frame.
#pragma once

#include <cmath>
#include <cstdint>

#include "protocol/quantity/angle.hpp"

namespace skerry {

struct TrueFrame {};      // clockwise from true north
struct RelativeFrame {};  // clockwise from the own ship's bow

// Binary angles as numbers.
inline constexpr double kUnitsPerTurn = 4294967296.0;
inline constexpr double kUnitsPerDegree = kUnitsPerTurn / 360.0;
inline constexpr double kUnitsPerRadian = kUnitsPerTurn / kRadiansPerTurn;
inline constexpr double kDegreesPerUnit = 360.0 / kUnitsPerTurn;
inline constexpr std::uint32_t kUnitsPerHalfTurn = 1u << 31;

// The smaller turn between two bearings, either way: at most half a turn.
constexpr std::uint32_t units_apart(std::uint32_t a, std::uint32_t b) {
  const std::uint32_t d = a - b;
  return d <= kUnitsPerHalfTurn ? d : 0u - d;
}

// A direction, clockwise from its frame's zero, held as a binary angle: 2^32 units are one turn, so
// wrapping is the integer's.  One unit is 8.4e-8 deg, 0.26 mm at 96 NM.  Two bearings of one frame
// differ by an Angle; adding two bearings, or mixing frames, does not compile.
template <typename Frame>
class Bearing {
 public:
  constexpr Bearing() = default;

  static constexpr Bearing from_units(std::uint32_t units) { return Bearing(units); }
  constexpr std::uint32_t units() const { return units_; }

  // Any finite angle; whole turns fall away.  Error: half a unit.
  static Bearing from(Angle angle) {
    const double turns = angle.in_degrees() / 360.0;
    const double part = turns - std::floor(turns);
    return Bearing(
        static_cast<std::uint32_t>(static_cast<std::uint64_t>(part * kUnitsPerTurn + 0.5)));
  }

  constexpr double in_degrees() const { return units_ * kDegreesPerUnit; }  // [0, 360)
  constexpr double in_radians() const { return degrees(in_degrees()).in_radians(); }

  // Index of the nearest of `count` evenly spaced spokes, spoke 0 at the frame's zero.
  // Requires 1 <= count <= 65536.  Rounds: with floor, k degrees landed in spoke k-1 for many k.
  constexpr std::uint32_t nearest_spoke(std::uint32_t count) const {
    const std::uint64_t scaled = std::uint64_t{units_} * count + (std::uint64_t{1} << 31);
    return static_cast<std::uint32_t>((scaled >> 32) % count);
  }

  // The bearing of spoke `index` of `count`.  Error: one unit (truncated).
  static constexpr Bearing of_spoke(std::uint32_t index, std::uint32_t count) {
    return Bearing(static_cast<std::uint32_t>((std::uint64_t{index % count} << 32) / count));
  }

  friend Bearing operator+(Bearing b, Angle turn) {
    return Bearing(b.units_ + Bearing::from(turn).units_);
  }
  friend Bearing operator-(Bearing b, Angle turn) { return b + (-turn); }
  // The smaller turn from b to a, in [-180, 180) deg.
  friend constexpr Angle operator-(Bearing a, Bearing b) {
    return degrees(static_cast<std::int32_t>(a.units_ - b.units_) * kDegreesPerUnit);
  }
  friend constexpr bool operator==(Bearing, Bearing) = default;

 private:
  explicit constexpr Bearing(std::uint32_t units) : units_(units) {}
  std::uint32_t units_ = 0;
};

using TrueBearing = Bearing<TrueFrame>;
using RelativeBearing = Bearing<RelativeFrame>;

// The only ways between the frames.  `heading` is the bow's true bearing.
constexpr TrueBearing to_true(RelativeBearing relative, TrueBearing heading) {
  return TrueBearing::from_units(relative.units() + heading.units());
}
constexpr RelativeBearing to_relative(TrueBearing bearing, TrueBearing heading) {
  return RelativeBearing::from_units(bearing.units() - heading.units());
}

}  // namespace skerry
