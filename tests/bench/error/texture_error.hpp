// Speed against error of the sea's texture: how often it is laid anew.
#pragma once

#include <cstdio>

namespace skerry::bench {

// One row for each number of spokes between rows of texture (SeaReturns): ns per cell of laying the
// rows and of adding them, and how far the clutter over noise comes out, speckle apart, from that
// of a texture made for every spoke in double, dB.  Sea state 4 with and without swell, 3 NM.
void print_texture_error(std::FILE* out);

}  // namespace skerry::bench
