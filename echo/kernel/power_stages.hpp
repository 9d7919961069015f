// Stages of a receiver on rows of echo power before its detector: sharpening in azimuth, side lobe
// suppression, boost of small echoes.
#pragma once

#include <array>
#include <cstdint>
#include <span>

namespace skerry::echo {

// Powers are echo over noise, >= 0, < 1e30.  All spans of a call are as long as each other.

// most[i] = max(most[i], row[i]).  Exact.
void keep_most(std::span<float> most, std::span<const float> row) noexcept;

// row[i] *= c0 + c1 t + c2 t^2 + c3 t^3, t = row[i] / most[i]; nothing where most[i] is 0.
// Requires row[i] <= most[i].  Error: 6e-7 relative for coefficients >= 0.
using SharpeningLaw = std::array<float, 4>;
void sharpen_row(std::span<float> row, std::span<const float> most, SharpeningLaw law) noexcept;

// row[i] = 0 where power[i] < share * max(a[i], b[i]).  Exact but for the product's rounding.
void suppress_row(std::span<float> row, std::span<const float> power, std::span<const float> a,
                  std::span<const float> b, float share) noexcept;

// row[i] *= 1 + more * row[i] / (1 + row[i]) * knee / (knee + row[i]): echoes over the noise and
// below `knee` grow by up to `more`, strong ones stay, and the order of powers is kept.
// Requires knee >= 1, 0 <= more.  Error: 6e-7 relative.
void boost_row(std::span<float> row, float more, float knee) noexcept;

// video[i] = 0 where video[i] < least[i].
void gate_video(std::span<std::uint8_t> video, std::span<const std::uint8_t> least) noexcept;

// Twins in double.
double sharpened_reference(double power, double most, SharpeningLaw law);
double boosted_reference(double power, double more, double knee);

// row[i] *= factor.
void scale_row(std::span<float> row, float factor) noexcept;

}  // namespace skerry::echo
