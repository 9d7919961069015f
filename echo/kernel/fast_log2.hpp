// log2 for the receiver: a few instructions, vectorised by the compiler.
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

}  // namespace skerry::echo
