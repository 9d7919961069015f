// Speed against error of the receiver's logarithm.
#pragma once

#include <cstdio>

namespace skerry::bench {

// One row for each polynomial (minimax of its degree), the kernels' exact_log2 and libm's: ns per
// value on this processor's best instruction set, and dB (p50, p99, max) against libm in double,
// over powers -60 to 90 dB.  The one in use is marked.
void print_log_error(std::FILE* out);

}  // namespace skerry::bench
