// A Gaussian number out of a hash, in plain arithmetic.
#pragma once

#include <cstdint>

namespace skerry::echo {

// The sum of the four 16-bit quarters of the hash, standardised, bent by a cubic so that the
// variance is 1 and the fourth moment 3 (a + b x^2 from those two equations).  |value| <= 4.0625.
// Error: odd moments are 0, the sixth is 14.5 (15); beyond 2 lie 4.7 % (4.6), beyond 3 0.24 %
// (0.27). Held by GaussianHash.HasTheMomentsOfAGaussian.
constexpr double kGaussianBound = 4.0625;
constexpr double gaussian_of(std::uint64_t hash) {
  const auto sum = static_cast<double>((hash & 0xFFFFu) + ((hash >> 16) & 0xFFFFu) +
                                       ((hash >> 32) & 0xFFFFu) + (hash >> 48));
  const double x = (sum - 131070.0) * (1.7320508075688772 / 65536.0);
  return x * (0.949035521655549 + 0.01864150597565375 * (x * x));
}

}  // namespace skerry::echo
