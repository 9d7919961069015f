// Function multiversioning: each kernel is compiled for three instruction sets from one body.
#pragma once

#include <string_view>

namespace skerry::echo {

enum class Isa { baseline, avx2, avx512 };

Isa best_isa();    // what this processor has
Isa active_isa();  // what the kernels use: best_isa() unless forced
// For tests and benches: uses a lesser one.  More than best_isa() is cut down to it.
void force_isa(Isa isa);
std::string_view name_of(Isa isa);

}  // namespace skerry::echo

// SKERRY_KERNEL(name, (parameters), (arguments)) defines `void name(parameters) noexcept` from the
// always-inline `name_body(parameters)` above it.
//
// SKERRY_NARROW_KERNEL does so for kernels of short rows, or of rows that begin anywhere: nearly
// every vector of 64 bytes would lie across two lines there, and what a block of it leaves over
// costs more than it saves, so AVX-512 runs what AVX2 does.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define SKERRY_KERNEL_UP_TO_AVX2(name, parameters, arguments)                      \
  namespace {                                                                      \
  __attribute__((target("arch=x86-64-v3"))) void name##_avx2 parameters noexcept { \
    name##_body arguments;                                                         \
  }                                                                                \
  void name##_baseline parameters noexcept { name##_body arguments; }              \
  }
#define SKERRY_KERNEL(name, parameters, arguments)                                                \
  SKERRY_KERNEL_UP_TO_AVX2(name, parameters, arguments)                                           \
  namespace {                                                                                     \
  __attribute__((                                                                                 \
      target("arch=x86-64-v4,prefer-vector-width=512"))) void name##_avx512 parameters noexcept { \
    name##_body arguments;                                                                        \
  }                                                                                               \
  }                                                                                               \
  void name parameters noexcept {                                                                 \
    switch (active_isa()) {                                                                       \
      case Isa::avx512:                                                                           \
        return name##_avx512 arguments;                                                           \
      case Isa::avx2:                                                                             \
        return name##_avx2 arguments;                                                             \
      case Isa::baseline:                                                                         \
        return name##_baseline arguments;                                                         \
    }                                                                                             \
  }
#define SKERRY_NARROW_KERNEL(name, parameters, arguments)                \
  SKERRY_KERNEL_UP_TO_AVX2(name, parameters, arguments)                  \
  void name parameters noexcept {                                        \
    if (active_isa() == Isa::baseline) return name##_baseline arguments; \
    name##_avx2 arguments;                                               \
  }
#else
#define SKERRY_KERNEL(name, parameters, arguments) \
  void name parameters noexcept { name##_body arguments; }
#define SKERRY_NARROW_KERNEL(name, parameters, arguments) SKERRY_KERNEL(name, parameters, arguments)
#endif

#define SKERRY_KERNEL_BODY static inline __attribute__((always_inline)) void
