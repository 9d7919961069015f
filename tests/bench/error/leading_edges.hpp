// The leading edge of the land on a number of rays: what the knobs of the coast are judged by.
#pragma once

#include <vector>

#include "echo/returns/coast_crossings.hpp"
#include "echo/scene/coast_picture.hpp"
#include "tests/bench/error/study.hpp"

namespace skerry::bench {

// Bearing of ray `i` of `rays`, off the bearings of spokes.
std::uint32_t ray_bearing(int i, int rays);

// Range of the first land on each ray, infinite where there is none; every edge tried.
std::vector<double> leading_edges_by_all(const echo::CoastPicture& picture, PlanePoint own_ship,
                                         double range_m, int rays);
// The same by the index.
std::vector<double> leading_edges(const echo::CoastPicture& picture, const echo::PolarIndex& index,
                                  PlanePoint own_ship, double range_m, int rays);

// Differences where both have land; a ray on which one has none counts `range_m`.
std::vector<double> differences(const std::vector<double>& a, const std::vector<double>& b,
                                double range_m);

// Dimension by the divider of the longest run of the picture, rulers from 8 to 250 m; NaN where it
// is too short.
double dimension_of(const echo::CoastPicture& picture);

// The study's coast, as fine as `finer` times what the radar resolves; the reference for 0.
echo::CoastPicturePtr picture_of(const ErrorStudy& study, double finer, double* seconds = nullptr);

}  // namespace skerry::bench
