// A row of speckle between two others.
#pragma once

#include <cstddef>
#include <span>

namespace skerry::echo {

// Two complex Gaussian rows, and how much of either there is.
struct FadingRows {
  const float* re_a = nullptr;
  const float* im_a = nullptr;
  const float* re_b = nullptr;
  const float* im_b = nullptr;
  float share_a = 1.0f, share_b = 0.0f;
};

// What power p becomes: straight lines between knots[0], knots[1], ... at equal steps of its root,
// sqrt(p) * to_knot.  Beyond the last but one it stays.  Values are kept within low .. high.
struct RootLaw {
  std::span<const float> knots;  // at least two
  float to_knot = 1.0f;
  float low = 0.0f, high = 1.0f;
};

// out[i] = the law of |share_a a[i] + share_b b[i]|^2.  Rows do not overlap `out`.
// Error: float roundings, 2e-6 of the greatest knot.  Held by SpeckleFade.MatchesItsReference.
void fade_speckle(const FadingRows& rows, const RootLaw& law, std::span<float> out) noexcept;

double faded_reference(const FadingRows& rows, const RootLaw& law, std::size_t i);

}  // namespace skerry::echo
