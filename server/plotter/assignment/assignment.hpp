// The cheapest way to give each row a column of its own.
#pragma once

#include <cstddef>
#include <limits>
#include <span>
#include <vector>

namespace skerry::server {

// A pair at this cost is never made.
inline constexpr double kNoPair = std::numeric_limits<double>::infinity();
inline constexpr std::size_t kUnpaired = std::numeric_limits<std::size_t>::max();

// Pairs rows with columns, each at most once.  A row that stays without a column costs `alone`, so
// no pair dearer than that is made.  Returns the column of each row, or kUnpaired; the sum of all
// costs is the least there is.  Of equal ones, that with the lower numbers: the same on every
// machine.
//
// costs: rows x columns, row by row; not NaN, not negative.  Errors: std::invalid_argument.
// Shortest augmenting paths (Jonker and Volgenant 1987, "A shortest augmenting path algorithm for
// dense and sparse linear assignment problems"): at most rows^2 (rows + columns) steps.
std::vector<std::size_t> cheapest_pairs(std::span<const double> costs, std::size_t rows,
                                        std::size_t columns, double alone);

}  // namespace skerry::server
