// Speed against error of land behind the beam: rays to a beam, rows to a turn, and how far the rows
// have been moved.
#pragma once

#include <cstdio>

namespace skerry::bench {

// Prints, off Bergen at 6 NM, or among islands where no chart is installed: the time to make a turn
// and to put a turn's spokes together, and decibels over the noise (p50, p90, p99, max) against a
// reference of 16384 rays whose beams are summed in double.
void print_beam_taps_error(std::FILE* out);

}  // namespace skerry::bench
