// Rain grains: a fractal field of octaves, grown by doubling, each grain with a life of its own.
#pragma once

#include <cstdint>
#include <vector>

namespace skerry::echo {

// A lattice of columns << levels by rows << levels values.  The grains of level l lie on the
// lattice of columns << l by rows << l, have 2^-Hl of the first one's amplitude and live 2^(-2l/3)
// as long, as eddies do.
struct GrainField {
  std::uint64_t seed = 0;
  std::uint32_t columns = 4, rows = 4, levels = 1;
  double hurst = 0.4;      // 0.1 to 0.9
  double life_s = 1800.0;  // of the largest grains
};

// The grains of one level at a time: `now` and `next` are the weights of two hashes, cosine and
// sine, so that a grain fades into the next one and the variance stays.
struct GrainAge {
  std::uint32_t seed = 0, salt = 0;
  float now = 1.0f, next = 0.0f;
};
GrainAge grain_age(const GrainField& field, std::uint32_t level, double seconds);

// Values of zero mean and a variance of 1 (of many levels; of a few, less), row by row.  A level's
// grains are spread by quadratic splines from doubling to doubling; the last doubling adds none, so
// that the values go smoothly from one to the next.  Error: float roundings, 1e-5; held by
// RainGrain.IsItsReference.
std::vector<float> rain_grains(const GrainField& field, double seconds);

// Twin in double, one value; for tests.
double rain_grain_reference(const GrainField& field, double seconds, std::uint32_t column,
                            std::uint32_t row);

}  // namespace skerry::echo
