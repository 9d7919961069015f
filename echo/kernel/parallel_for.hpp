// ParallelFor: how work over independent pieces is handed out.
#pragma once

#include <cstddef>
#include <functional>

namespace skerry::echo {

// Calls body(0) .. body(count-1), in any order, on any threads, and returns when all are done.
using ParallelFor =
    std::function<void(std::size_t count, const std::function<void(std::size_t)>& body)>;

inline void serial_for(std::size_t count, const std::function<void(std::size_t)>& body) {
  for (std::size_t i = 0; i < count; ++i) body(i);
}

}  // namespace skerry::echo
