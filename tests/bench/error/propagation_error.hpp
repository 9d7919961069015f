// Speed against error of the propagation tables.
#pragma once

#include <cstdio>

namespace skerry::bench {

// One row for each grid of nodes: build time, size, time of a look-up at places spread over range
// and height, and dB (p50, p99, max) against the double reference; the grid in use is marked, and
// the reference itself stands last.  X and S band, 15 m, calm and 1.5 m of waves.
void print_propagation_error(std::FILE* out);

}  // namespace skerry::bench
