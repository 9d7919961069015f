#include "echo/rain/rain_grain.hpp"

#include <cmath>
#include <span>
#include <utility>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/rain_grid.hpp"
#include "echo/kernel/relief_noise.hpp"

namespace skerry::echo {
namespace {

// Around every lattice: what its values are made of lies up to a value outside.
constexpr std::int32_t kAround = 2;

double amplitude_of(const GrainField& field, std::uint32_t level) {
  // A uniform value in [-1, 1] has the variance 1/3, spread by the spline 0.3025 (0.55 each way) of
  // it; the levels' variances are a geometric series.
  const double ratio = exact_exp2(-2.0 * field.hurst);
  return std::sqrt(3.0 * (1.0 - ratio) / 0.3025) * exact_exp2(-field.hurst * level);
}

std::uint32_t lattice_place(std::int32_t column, std::int32_t row) {
  return static_cast<std::uint32_t>(row) * kRowStep +
         static_cast<std::uint32_t>(column) * kColumnStep;
}

// A lattice with its margin.
struct Lattice {
  std::int32_t columns, rows;
  std::vector<float> values;
  Lattice(std::uint32_t c, std::uint32_t r)
      : columns(static_cast<std::int32_t>(c)),
        rows(static_cast<std::int32_t>(r)),
        values(static_cast<std::size_t>((columns + 2 * kAround) * (rows + 2 * kAround)), 0.0f) {}
  std::span<float> row(std::int32_t index) {
    const auto pitch = static_cast<std::size_t>(columns + 2 * kAround);
    return std::span(values).subspan(static_cast<std::size_t>(index + kAround) * pitch, pitch);
  }
};

void add_level(const GrainField& field, std::uint32_t level, double seconds, Lattice& lattice) {
  const GrainAge age = grain_age(field, level, seconds);
  const double amplitude = amplitude_of(field, level);
  const auto now = static_cast<float>(amplitude * static_cast<double>(age.now));
  const auto next = static_cast<float>(amplitude * static_cast<double>(age.next));
  for (std::int32_t r = -kAround; r < lattice.rows + kAround; ++r)
    add_grain(lattice_place(-kAround, r) + age.seed, age.salt, now, next, lattice.row(r));
}

// Value i of the fine lattice lies in value floor(i / 2) of the coarse one.
std::int32_t parent_of(std::int32_t index) { return (index + 2 * kAround) / 2 - kAround; }
std::int32_t neighbour_of(std::int32_t index) {
  return parent_of(index) + ((index & 1) != 0 ? 1 : -1);
}

Lattice twice_as_fine(Lattice& coarse) {
  Lattice fine(static_cast<std::uint32_t>(2 * coarse.columns),
               static_cast<std::uint32_t>(2 * coarse.rows));
  // Fine value -2 lies in coarse value -1, the second of its row.
  const auto wide = static_cast<std::size_t>(coarse.columns + 4);
  for (std::int32_t r = -kAround; r < fine.rows + kAround; ++r)
    refine_row(coarse.row(parent_of(r)).first(wide), coarse.row(neighbour_of(r)).first(wide),
               fine.row(r));
  return fine;
}

double level_reference(const GrainField& field, std::uint32_t level, double seconds,
                       std::int32_t column, std::int32_t row) {
  double value = 0.0;
  if (level > 0) {
    const std::int32_t c[2] = {parent_of(column), neighbour_of(column)};
    const std::int32_t r[2] = {parent_of(row), neighbour_of(row)};
    constexpr double kWeight[2] = {0.75, 0.25};
    for (int i = 0; i < 2; ++i)
      for (int k = 0; k < 2; ++k)
        value += kWeight[i] * kWeight[k] * level_reference(field, level - 1, seconds, c[i], r[k]);
  }
  if (level < field.levels) {
    const GrainAge age = grain_age(field, level, seconds);
    const std::uint32_t place = lattice_place(column, row) + age.seed;
    value +=
        amplitude_of(field, level) * (static_cast<double>(age.now) * corner(place) +
                                      static_cast<double>(age.next) * corner(place + age.salt));
  }
  return value;
}

}  // namespace

GrainAge grain_age(const GrainField& field, std::uint32_t level, double seconds) {
  const std::uint64_t mine = mixed(field.seed, level);
  const double life = field.life_s * exact_exp2(-2.0 / 3.0 * level);
  const double age = seconds / life + as_unit(mine);
  const double generation = std::floor(age);
  const auto number = static_cast<std::uint64_t>(static_cast<std::int64_t>(generation));
  const SinCos weights = sin_cos_degrees(90.0 * (age - generation));
  const auto seed = static_cast<std::uint32_t>(mixed(mine, number) >> 32);
  return {seed, static_cast<std::uint32_t>(mixed(mine, number + 1) >> 32) - seed,
          static_cast<float>(weights.cos), static_cast<float>(weights.sin)};
}

std::vector<float> rain_grains(const GrainField& field, double seconds) {
  Lattice lattice(field.columns, field.rows);
  for (std::uint32_t level = 0; level < field.levels; ++level) {
    add_level(field, level, seconds, lattice);
    lattice = twice_as_fine(lattice);
  }
  std::vector<float> values;
  values.reserve(static_cast<std::size_t>(lattice.columns * lattice.rows));
  for (std::int32_t r = 0; r < lattice.rows; ++r) {
    const auto row = lattice.row(r).subspan(kAround, static_cast<std::size_t>(lattice.columns));
    values.insert(values.end(), row.begin(), row.end());
  }
  return values;
}

double rain_grain_reference(const GrainField& field, double seconds, std::uint32_t column,
                            std::uint32_t row) {
  return level_reference(field, field.levels, seconds, static_cast<std::int32_t>(column),
                         static_cast<std::int32_t>(row));
}

}  // namespace skerry::echo
