// How fast one core reads and writes memory beyond its caches.
#pragma once

namespace skerry::bench {

// GB/s (10^9 bytes), each byte read or written counted once; the best of some runs over arrays of
// 64 MiB.
struct MemorySpeed {
  double copy = 0.0;   // memcpy
  double set = 0.0;    // memset
  double triad = 0.0;  // a[i] = b[i] + s * c[i]
};
MemorySpeed memory_speed();

}  // namespace skerry::bench
