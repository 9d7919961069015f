// Exact fractional Brownian motion, and curves of known dimension.
#pragma once

#include <cstdint>
#include <vector>

#include "protocol/quantity/geo_point.hpp"

namespace skerry::test {

// `steps` + 1 heights from 0 on, whose differences are fractional Gaussian noise of Hurst exponent
// `hurst` and variance 1: exact covariance, by circulant embedding.  Source: Davies and Harte
// (1987); Wood and Chan (1994).  A pure function of its arguments.
std::vector<double> exact_fbm(std::size_t steps, double hurst, std::uint64_t seed);

// Koch curve of 4^iterations pieces from (0, 0) to (length_m, 0): D = log 4 / log 3 = 1.2619.
std::vector<PlanePoint> koch_curve(int iterations, double length_m);

// The curve of points on `line` turned by `degrees` about the origin.
std::vector<PlanePoint> turned(const std::vector<PlanePoint>& line, double degrees);

}  // namespace skerry::test
