// The refiner of a style, found once.
#pragma once

#include <memory>

#include "echo/fractal/edge_refiner.hpp"

namespace skerry::echo {

// Solving for a style's factors takes up to 7 ms, so refiners are kept for the whole process: at
// most 64, and then none before.  A pure function.
// Error: std::invalid_argument as require_valid().
// Thread: any number.
std::shared_ptr<const EdgeRefiner> refiner_of(const CoastStyle& style);

}  // namespace skerry::echo
