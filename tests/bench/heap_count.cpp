#include "tests/bench/heap_count.hpp"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <new>

namespace skerry::bench {
namespace {

std::atomic<std::size_t> in_use = 0;

void* counted(void* p) {
  if (p == nullptr) throw std::bad_alloc();
  in_use.fetch_add(malloc_usable_size(p), std::memory_order_relaxed);
  return p;
}
void give_back(void* p) noexcept {
  if (p == nullptr) return;
  in_use.fetch_sub(malloc_usable_size(p), std::memory_order_relaxed);
  std::free(p);
}

}  // namespace

std::size_t heap_bytes() { return in_use.load(std::memory_order_relaxed); }

}  // namespace skerry::bench

void* operator new(std::size_t size) { return skerry::bench::counted(std::malloc(size)); }
void* operator new(std::size_t size, std::align_val_t line) {
  const auto n = static_cast<std::size_t>(line);
  return skerry::bench::counted(std::aligned_alloc(n, (size + n - 1) / n * n));
}
void operator delete(void* p) noexcept { skerry::bench::give_back(p); }
void operator delete(void* p, std::size_t) noexcept { skerry::bench::give_back(p); }
void operator delete(void* p, std::align_val_t) noexcept { skerry::bench::give_back(p); }
void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  skerry::bench::give_back(p);
}
