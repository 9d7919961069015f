// Losses of a whole row of powers, applied after all echoes are in it.
#pragma once

#include <cstddef>
#include <span>

namespace skerry::echo {

// The greatest of powers that are all >= 0 and no NaN; 0 of none.
float peak_of(std::span<const float> power) noexcept;
// The same of each kPeakCells cells; the last block is what is left.  Requires
// peaks.size() == (power.size() + kPeakCells - 1) / kPeakCells.  Returns the greatest of them.
inline constexpr std::size_t kPeakCells = 64;
float peaks_of(std::span<const float> power, std::span<float> peaks) noexcept;

// The loss of a tilted beam.  With L(x) = max(-fall x^2, floor) the pattern in octaves at x off its
// axis, power[i] *= 2^min(0, L(tilt - depression[i]) - L(depression[i])).
// Requires depression.size() >= power.size(), fall > 0, -60 <= floor < 0.
// Error: 4e-5 relative against the double reference for |x| <= pi, fall <= 2000.  Held by
// RowLosses.TiltIsThatOfItsReference.
struct TiltedBeam {
  float tilt = 0.0f;   // of the axis, radians below the horizon
  float fall = 1.0f;   // octaves per square radian
  float floor = 0.0f;  // octaves
};
void lose_by_tilt(const TiltedBeam& beam, std::span<const float> depression,
                  std::span<float> power) noexcept;
void lose_by_tilt_reference(const TiltedBeam& beam, std::span<const float> depression,
                            std::span<double> power);

// A loss that dies away: power[i] *= 2^(-loss dying[i]).  Requires dying.size() >= power.size(),
// 0 <= loss dying[i] <= 100.  Error: 3e-5 relative.  Held by RowLosses.DyingIsThatOfItsReference.
void lose_dying(float loss, std::span<const float> dying, std::span<float> power) noexcept;
void lose_dying_reference(float loss, std::span<const float> dying, std::span<double> power);

}  // namespace skerry::echo
