#include "tests/bench/error/log_error.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/fast_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/isa.hpp"
#include "tests/bench/error/study.hpp"

namespace skerry::echo {
namespace {

// Coefficients of q in log2(1 + t) = t + t (1 - t) q(t), lowest first.
template <std::size_t kTerms>
using Polynomial = std::array<float, kTerms>;
constexpr Polynomial<1> kConstant = {0.346555385f};
constexpr Polynomial<2> kLinear = {0.422865376f, -0.159220193f};
constexpr Polynomial<4> kCubic = {0.441917041f, -0.267179418f, 0.148426675f, -0.0451490616f};
constexpr Polynomial<6> kQuintic = {0.44266644f,   -0.277887797f, 0.195436395f,
                                    -0.129703793f, 0.0633258627f, -0.0152091086f};

template <std::size_t kTerms>
inline __attribute__((always_inline)) float log2_by(const Polynomial<kTerms>& q, float x) {
  const auto bits = std::bit_cast<std::int32_t>(x);
  const float exponent = static_cast<float>((bits >> 23) - 127);
  const float t = std::bit_cast<float>((bits & 0x007FFFFF) | 0x3F800000) - 1.0f;
  float sum = q[kTerms - 1];
  for (std::size_t k = kTerms - 1; k-- > 0;) sum = sum * t + q[k];
  return exponent + (t + t * (1.0f - t) * sum);
}

#define SKERRY_LOG_KERNEL(name, expression)                                                       \
  SKERRY_KERNEL_BODY name##_body(const float* __restrict x, float* __restrict y, std::size_t n) { \
    for (std::size_t i = 0; i < n; ++i) y[i] = expression;                                        \
  }                                                                                               \
  SKERRY_KERNEL(name, (const float* __restrict x, float* __restrict y, std::size_t n), (x, y, n))
SKERRY_LOG_KERNEL(log_constant, log2_by(kConstant, x[i]))
SKERRY_LOG_KERNEL(log_linear, log2_by(kLinear, x[i]))
SKERRY_LOG_KERNEL(log_in_use, fast_log2(x[i]))
SKERRY_LOG_KERNEL(log_cubic, log2_by(kCubic, x[i]))
SKERRY_LOG_KERNEL(log_quintic, log2_by(kQuintic, x[i]))
#undef SKERRY_LOG_KERNEL

void log_exact(const float* x, float* y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i)
    y[i] = static_cast<float>(exact_log2(static_cast<double>(x[i])));
}

void log_libm(const float* x, float* y, std::size_t n) {
  for (std::size_t i = 0; i < n; ++i) y[i] = std::log2(x[i]);
}

}  // namespace
}  // namespace skerry::echo

namespace skerry::bench {
namespace {

using Logarithm = void (*)(const float*, float*, std::size_t);
struct Choice {
  const char* name;
  Logarithm logarithm;
  bool in_use;
};

constexpr std::size_t kValues = 4096;
constexpr int kRounds = 64, kRepetitions = 15;

}  // namespace

void print_log_error(std::FILE* out) {
  const std::array<Choice, 7> choices = {Choice{"quadratic", echo::log_constant, false},
                                         {"cubic", echo::log_linear, false},
                                         {"4th order", echo::log_in_use, true},
                                         {"5th order", echo::log_cubic, false},
                                         {"7th order", echo::log_quintic, false},
                                         {"exact_log2 (double)", echo::log_exact, false},
                                         {"libm log2f", echo::log_libm, false}};
  std::vector<float> powers(kValues), octaves(kValues);
  for (std::size_t i = 0; i < kValues; ++i) {
    const double db = -60.0 + 150.0 * echo::as_unit(echo::mixed(11, i));
    powers[i] = static_cast<float>(std::pow(10.0, db / 10.0));
  }
  std::fprintf(out, "%-22s %10s %12s %12s %12s\n", "logarithm", "ns/value", "p50 dB", "p99 dB",
               "max dB");
  for (const Choice& choice : choices) {
    const double seconds = median_seconds(kRepetitions, [&] {
      for (int round = 0; round < kRounds; ++round) {
        choice.logarithm(powers.data(), octaves.data(), kValues);
        asm volatile("" ::: "memory");
      }
    });
    std::vector<double> errors;
    for (std::size_t i = 0; i < kValues; ++i) {
      const double truth = std::log2(static_cast<double>(powers[i]));
      errors.push_back(3.0102999566398120 * std::fabs(static_cast<double>(octaves[i]) - truth));
    }
    std::sort(errors.begin(), errors.end());
    std::fprintf(out, "%-22s %10.3f %12.2e %12.2e %12.2e%s\n", choice.name,
                 seconds * 1e9 / (kRounds * static_cast<double>(kValues)), errors[kValues / 2],
                 errors[kValues * 99 / 100], errors.back(), choice.in_use ? "  in use" : "");
  }
}

}  // namespace skerry::bench
