// Tori of noise values: made once, in arithmetic that is the same on every machine.
#pragma once

#include <cstdint>
#include <vector>

namespace skerry::echo {

struct ComplexTorus {
  std::vector<double> re, im;
};

// `period` (a power of two) independent complex Gaussians of mean power `power`: their powers are
// the (j + 1/2) / period quantiles of an exponential in random order, so their distribution is that
// of the law to 1 / period; phases are random.  Their sum is 0: it would be the same in every row.
ComplexTorus white_noise(std::uint32_t period, double power, std::uint64_t seed);

// The same through a rectangular filter `band` (0 to 1) of the sampling rate wide, made of its
// spectrum without its middle line; autocorrelation sin(pi band k) / (pi band k).  Mean power is
// `power` exactly.
ComplexTorus band_noise(std::uint32_t period, double band, double power, std::uint64_t seed);

// Quantiles of the law -ln Beta(2, b) and of the law Gamma(a, 1), at (j + 1/2) / period, in random
// order.  a, b in (0, 256].  Error: 1e-3 of the spread.
std::vector<double> peak_excess(std::uint32_t period, double b, std::uint64_t seed);
std::vector<double> gamma_values(std::uint32_t period, double a, std::uint64_t seed);

}  // namespace skerry::echo
