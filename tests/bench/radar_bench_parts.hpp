// The parts of radar_bench that have a file of their own.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "tests/scenes/scenes.hpp"

namespace skerry::bench {

// Of one call.
inline constexpr std::uint32_t kSectorSpokes = 16;

double median_of(std::vector<double> values);
// The share-th (0 to 1) of the values in order.
double percentile_of(std::vector<double> values, double share);

// What so many radars of the full scene cost one core when it makes a sector of each by turns, so
// that none finds its state in a near cache, against one radar after the other, a turn each.
void by_turns(const scenes::NamedScene& full, std::size_t radars, int turns);

// Bytes of a radar's own and shared memory by owner, and how much of it a sector touches.
void working_set(const scenes::NamedScene& full);

// What each stage costs and what memory it goes through, for each instruction set, beside the
// speed of memory in the same run.
void stage_table(const scenes::NamedScene& full);

// First sectors after a change of the range scale, against the median of later ones.
void range_changes(const scenes::NamedScene& full);

}  // namespace skerry::bench
