// Base-2 logarithm and power in single precision, the same bits on every machine.
#pragma once

#include <bit>
#include <cstdint>

namespace skerry::echo {

// Error: 1.2e-4 absolute (3.5e-4 dB) for positive, normal x; exact at powers of two, continuous,
// monotone.  A video step is 0.24 dB or more.  Held by LogReceiver.FastLogStaysInItsBound.
// log2(1+t) = t + t(1-t) q(t), q minimax on [0, 1].
inline constexpr float kFastLog2Error = 1.2e-4f;

inline __attribute__((always_inline)) float fast_log2(float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const float exponent = static_cast<float>((bits >> 23) - 127);
  const float t = std::bit_cast<float>((bits & 0x007FFFFF) | 0x3F800000) - 1.0f;
  const float q = (0.0821305896f * t - 0.239058108f) * t + 0.438725708f;
  return exponent + (t + t * (1.0f - t) * q);
}

// Requires -126 <= x <= 126.  Error: 1.2e-5 relative (5e-5 dB), of which 8e-6 is x + 127 in float;
// exact at whole x, continuous.  Held by FastExp2.StaysInItsBound.
// 2^(n+t) = 2^n (1 + t + t(1-t) q(t)), q minimax on [0, 1].
inline constexpr float kFastExp2Error = 1.2e-5f;

inline __attribute__((always_inline)) float fast_exp2(float x) {
  const float biased = x + 127.0f;
  const auto whole = static_cast<std::int32_t>(biased);
  const float t = biased - static_cast<float>(whole);
  const float q = (-0.0135557464f * t - 0.0655881147f) * t - 0.306967880f;
  return std::bit_cast<float>(whole << 23) * (1.0f + (t + t * (1.0f - t) * q));
}

}  // namespace skerry::echo
