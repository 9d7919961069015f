// What joining samples by straight lines takes off the texture's variance.
#pragma once

#include <cstdint>

namespace skerry::echo {

// Between two values of unit variance and correlation r a straight line has the variance
// 1 - 2 f (1 - f)(1 - r) at the share f of the way.  Averaged over `steps` places of which the
// first is a sample, the share of the variance that is lost.
double variance_lost(double correlation, std::uint32_t steps);

// Correlation of two gamma values of shape nu whose Gaussian origins are correlated by 1 - u, u
// small: 1 - u (1 + nu) ln(1 + 1/nu), that of the log-normal of the same variance; 0 at least.
double texture_correlation(double gaussian_correlation, double nu);

// Correlation, averaged over places, of two mixtures of unit variance (texture_octaves) of
// uncorrelated neighbours, `apart` (0 to 1) of their distance from each other.
double mixture_correlation(double apart);

}  // namespace skerry::echo
