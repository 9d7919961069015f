#include "echo/rain/rain_map.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <span>

#include "echo/kernel/hash.hpp"
#include "echo/kernel/shared_tables.hpp"
#include "echo/rain/rain_grain.hpp"

namespace skerry::echo {
namespace {

constexpr double kFinestValue = 75.0;  // m
constexpr std::uint32_t kFewestColumns = 64, kMostColumns = 512;
constexpr float kMostDeviations = 4.2f;       // flattens to 2.8
constexpr std::uint32_t kFewestOfALevel = 4;  // values along the shorter side
constexpr std::uint64_t kGrainSeed = 0x6A1;
constexpr std::uint64_t kTurnSeed = 0x7A2, kStepSeed = 0x57E;
constexpr std::size_t kMostMapsKept = 128;
constexpr std::size_t kMostValuesKept = std::size_t{1} << 24;  // 64 MiB

std::uint32_t doublings_of(const RainForm& form, double radius_m) {
  std::uint32_t doublings = 0;
  const auto columns = [&] { return form.columns << doublings; };
  while (columns() < kFewestColumns ||
         (columns() < kMostColumns && 2.0 * radius_m * form.half_along > kFinestValue * columns()))
    ++doublings;
  return doublings;
}

// Larger areas live longer, as eddies do.
double longer_life(double radius_m) {
  return exact_exp2(2.0 / 3.0 * exact_log2(radius_m / kLifeRadius));
}

double step_offset(std::uint64_t identity, double step_s) {
  return step_s * as_unit(mixed(identity, kStepSeed));
}

std::vector<float> outline_of(const RainForm& form, std::uint32_t columns, std::uint32_t rows) {
  std::vector<float> out(std::size_t{columns} * rows, -200.0f);
  for (std::uint32_t r = 1; r + 1 < rows; ++r) {
    const double across = (2.0 * r + 1.0) / rows - 1.0;
    for (std::uint32_t c = 1; c + 1 < columns; ++c) {
      const double along = (2.0 * c + 1.0) / columns - 1.0;
      out[std::size_t{r} * columns + c] = static_cast<float>(rain_outline(form, along, across));
    }
  }
  return out;
}

// Outlines are few and the same for all areas of a kind: all are kept.
std::shared_ptr<const std::vector<float>> kept_outline(const RainForm& form, std::uint32_t columns,
                                                       std::uint32_t rows) {
  struct KeptOutline {
    const RainForm* form;
    std::uint32_t columns;
    std::shared_ptr<const std::vector<float>> values;
  };
  static std::mutex mutex;
  static std::vector<KeptOutline> kept;
  const std::lock_guard lock(mutex);
  for (const KeptOutline& k : kept)
    if (k.form == &form && k.columns == columns) return k.values;
  kept.push_back({&form, columns,
                  std::make_shared<const std::vector<float>>(outline_of(form, columns, rows))});
  return kept.back().values;
}

std::size_t values_of(const RainMap& map) {
  std::size_t sum = 0;
  for (std::size_t l = 0; l < map.levels(); ++l)
    sum += std::size_t{map.level(l).columns} * map.level(l).rows;
  return sum;
}

}  // namespace

double rain_step(double radius_m) { return std::clamp(5.0 * longer_life(radius_m), 1.0, 20.0); }

RainMapKey rain_map_key(const RainCell& cell, double seconds) {
  const double step_s = rain_step(cell.radius_m);
  const double steps = (seconds + step_offset(cell.identity, step_s)) / step_s;
  return {cell.identity, cell.kind, cell.radius_m, static_cast<std::int64_t>(std::floor(steps))};
}

RainMap::RainMap(const RainMapKey& key) : key_(key), form_(rain_form(key.kind)) {
  const std::uint32_t doublings = doublings_of(form_, key.radius_m);
  const std::uint32_t columns = form_.columns << doublings, rows = form_.rows << doublings;
  column_m_ = 2.0 * form_.half_along * key.radius_m / columns;
  row_m_ = 2.0 * form_.half_across * key.radius_m / rows;
  turn_ = sin_cos_degrees(form_.turn_deg * (2.0 * as_unit(mixed(key.identity, kTurnSeed)) - 1.0));
  const double step_s = rain_step(key.radius_m);
  const double seconds = static_cast<double>(key.step) * step_s - step_offset(key.identity, step_s);
  levels_.push_back({columns, rows,
                     rain_grains({mixed(key.identity, kGrainSeed), form_.columns, form_.rows,
                                  doublings, form_.hurst, form_.life_s * longer_life(key.radius_m)},
                                 seconds)});
  raise_row({static_cast<float>(form_.spread), kMostDeviations,
             static_cast<float>(exact_exp2(form_.least))},
            *kept_outline(form_, columns, rows), levels_.front().values);
  scale();
  add_coarser_levels();
}

// It rains in a square of four values if one of them is wet; so read between the values, the field
// has the mean 1 where it rains.
void RainMap::scale() {
  Level& level = levels_.front();
  double sum = 0.0;
  float greatest = 0.0f;
  for (const float v : level.values) {
    sum += static_cast<double>(v);
    greatest = std::max(greatest, v);
  }
  std::size_t wet = 0;
  for (std::uint32_t r = 0; r + 1 < level.rows; ++r) {
    const float* const low = level.values.data() + std::size_t{r} * level.columns;
    const float* const high = low + level.columns;
    for (std::uint32_t c = 0; c + 1 < level.columns; ++c)
      wet += (low[c] + low[c + 1]) + (high[c] + high[c + 1]) > 0.0f ? 1 : 0;
  }
  if (wet == 0) return;
  const double scale = static_cast<double>(wet) / sum;
  for (float& v : level.values) v *= static_cast<float>(scale);
  greatest_ = static_cast<double>(greatest) * scale;
  wet_share_ = static_cast<double>(wet) / static_cast<double>(level.values.size());
}

void RainMap::add_coarser_levels() {
  while (true) {
    const Level& fine = levels_.back();
    const std::uint32_t columns = fine.columns / 2, rows = fine.rows / 2;
    if (std::min(columns, rows) < kFewestOfALevel || ((fine.columns | fine.rows) & 1u) != 0) return;
    Level coarse{columns, rows, std::vector<float>(std::size_t{columns} * rows)};
    for (std::uint32_t r = 0; r < rows; ++r) {
      const float* const low = fine.values.data() + std::size_t{2 * r} * fine.columns;
      const float* const high = low + fine.columns;
      float* const out = coarse.values.data() + std::size_t{r} * columns;
      for (std::uint32_t c = 0; c < columns; ++c)
        out[c] = 0.25f * ((low[2 * c] + low[2 * c + 1]) + (high[2 * c] + high[2 * c + 1]));
    }
    levels_.push_back(std::move(coarse));
  }
}

GridView RainMap::level(std::size_t l) const {
  return {levels_[l].values.data(), levels_[l].columns, levels_[l].rows};
}

RainMapPtr rain_map_for(const RainMapKey& key) {
  static SharedTables<RainMapKey, RainMap> tables;
  static std::mutex mutex;
  static std::vector<RainMapPtr> kept;  // last used first
  RainMapPtr map = tables.get(key, [&] { return RainMap(key); });
  const std::lock_guard lock(mutex);
  const auto found = std::find(kept.begin(), kept.end(), map);
  if (found == kept.end()) {
    // A radar that is late may still want the step before; what is older, and what the area was
    // before it was changed, only a jump back in time would ask for again.
    std::erase_if(kept, [&](const RainMapPtr& each) {
      const RainMapKey& old = each->key();
      return old.identity == key.identity &&
             (old.kind != key.kind || old.radius_m != key.radius_m || old.step + 1 < key.step);
    });
    kept.insert(kept.begin(), map);
  } else {
    std::rotate(kept.begin(), found, found + 1);
  }
  std::size_t values = 0;
  for (const RainMapPtr& each : kept) values += values_of(*each);
  while (kept.size() > 1 && (kept.size() > kMostMapsKept || values > kMostValuesKept)) {
    values -= values_of(*kept.back());
    kept.pop_back();
  }
  return map;
}

}  // namespace skerry::echo
