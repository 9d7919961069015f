#include "echo/kernel/isa.hpp"

#include <atomic>

namespace skerry::echo {
namespace {
std::atomic<Isa>& current() {
  static std::atomic<Isa> isa{best_isa()};
  return isa;
}
}  // namespace

Isa best_isa() {
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
  if (__builtin_cpu_supports("x86-64-v4")) return Isa::avx512;
  if (__builtin_cpu_supports("x86-64-v3")) return Isa::avx2;
#endif
  return Isa::baseline;
}

Isa active_isa() { return current().load(std::memory_order_relaxed); }

void force_isa(Isa isa) {
  current().store(isa > best_isa() ? best_isa() : isa, std::memory_order_relaxed);
}

std::string_view name_of(Isa isa) {
  switch (isa) {
    case Isa::baseline:
      return "baseline";
    case Isa::avx2:
      return "avx2";
    case Isa::avx512:
      return "avx512";
  }
  return "unknown";
}

}  // namespace skerry::echo
