#include "tests/bench/memory_speed.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <vector>

#include "tests/bench/bench_support.hpp"

namespace skerry::bench {
namespace {

constexpr std::size_t kFloats = std::size_t{1} << 24;
constexpr int kRuns = 5;

template <typename Run>
double best_speed(double bytes, Run&& run) {
  double best = 0.0;
  for (int i = 0; i < kRuns; ++i) {
    const double begun = thread_seconds();
    run();
    best = std::max(best, 1e-9 * bytes / (thread_seconds() - begun));
  }
  return best;
}

}  // namespace

MemorySpeed memory_speed() {
  std::vector<float> a(kFloats, 1.0f), b(kFloats, 2.0f), c(kFloats, 3.0f);
  constexpr double kBytes = 4.0 * kFloats;
  MemorySpeed speed;
  speed.copy = best_speed(2.0 * kBytes, [&] {
    std::memcpy(a.data(), b.data(), kFloats * sizeof(float));
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  });
  int value = 0;
  speed.set = best_speed(kBytes, [&] {
    std::memset(a.data(), ++value, kFloats * sizeof(float));
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  });
  speed.triad = best_speed(3.0 * kBytes, [&] {
    for (std::size_t i = 0; i < kFloats; ++i) a[i] = b[i] + 0.5f * c[i];
    benchmark::DoNotOptimize(a.data());
    benchmark::ClobberMemory();
  });
  return speed;
}

}  // namespace skerry::bench
