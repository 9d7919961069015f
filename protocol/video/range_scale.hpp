// RangeScale: the closed table of range scales.
#pragma once

#include <array>
#include <cstdint>
#include <optional>

#include "protocol/quantity/length.hpp"

namespace skerry {

// One of the twelve range scales, 0.125 to 96 NM.  They contain the scales MSC.192(79) 5.5 requires
// (0.25 0.5 0.75 1.5 3 6 12 24 NM).  A scale outside the table cannot be made.
class RangeScale {
 public:
  static constexpr std::array<double, 12> kNauticalMiles = {0.125, 0.25, 0.5, 0.75, 1.5, 3.0,
                                                            6.0,   12.0, 24., 48.,  72., 96.};
  static constexpr std::size_t kCount = kNauticalMiles.size();

  constexpr RangeScale() = default;  // 12 NM

  static constexpr std::optional<RangeScale> from_index(std::size_t index) {
    if (index >= kCount) return std::nullopt;
    return RangeScale(static_cast<std::uint8_t>(index));
  }
  // The scale of exactly `nm` nautical miles (to 1e-6), if there is one.
  static constexpr std::optional<RangeScale> find(double nm) {
    for (std::size_t i = 0; i < kCount; ++i) {
      const double d = kNauticalMiles[i] - nm;
      if (d < 1e-6 && d > -1e-6) return from_index(i);
    }
    return std::nullopt;
  }

  constexpr std::size_t index() const { return index_; }
  constexpr double in_nautical_miles() const { return kNauticalMiles[index_]; }
  constexpr Length length() const { return nautical_miles(in_nautical_miles()); }
  // Number of fixed range rings customary for the scale (the last lies on the edge).
  constexpr int ring_count() const {
    return in_nautical_miles() < 0.3 ? 5 : in_nautical_miles() < 3.0 ? 3 : 6;
  }

  friend constexpr bool operator==(RangeScale, RangeScale) = default;

 private:
  explicit constexpr RangeScale(std::uint8_t index) : index_(index) {}
  std::uint8_t index_ = 7;
};

}  // namespace skerry
