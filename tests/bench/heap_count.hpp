// How much of the heap is in use: radar_bench's operators new and delete count.
#pragma once

#include <cstddef>

namespace skerry::bench {

std::size_t heap_bytes();

}  // namespace skerry::bench
