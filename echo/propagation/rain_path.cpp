#include "echo/propagation/rain_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/fast_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/time.hpp"

namespace skerry::echo {

namespace {

// a exp(-((log10 f - b) / c)^2)
struct Bump {
  double a, b, c;
};
// The sum of bumps and a line m log10 f + c in log10 of the frequency in GHz.
struct RainFit {
  std::span<const Bump> bumps;
  double slope, offset;
};

constexpr Bump kKh[] = {{-5.33980, -0.10008, 1.13098},
                        {-0.35351, 1.26970, 0.45400},
                        {-0.23789, 0.86036, 0.15354},
                        {-0.94158, 0.64552, 0.16817}};
constexpr Bump kKv[] = {{-3.80595, 0.56934, 0.81061},
                        {-3.44965, -0.22911, 0.51059},
                        {-0.39902, 0.73042, 0.11899},
                        {0.50167, 1.07319, 0.27195}};
constexpr Bump kAlphaH[] = {{-0.14318, 1.82442, -0.55187},
                            {0.29591, 0.77564, 0.19822},
                            {0.32177, 0.63773, 0.13164},
                            {-5.37610, -0.96230, 1.47828},
                            {16.1721, -3.29980, 3.43990}};
constexpr Bump kAlphaV[] = {{-0.07771, 2.33840, -0.76284},
                            {0.56727, 0.95545, 0.54039},
                            {-0.20238, 1.14520, 0.26809},
                            {-48.2991, 0.791669, 0.116226},
                            {48.5833, 0.791459, 0.116479}};
constexpr RainFit kKhFit{kKh, -0.18961, 0.71147}, kKvFit{kKv, -0.16398, 0.63297};
constexpr RainFit kAlphaHFit{kAlphaH, 0.67849, -1.95537}, kAlphaVFit{kAlphaV, -0.053739, 0.83433};

double value_of(const RainFit& fit, double log10_ghz) {
  double sum = fit.slope * log10_ghz + fit.offset;
  for (const Bump& bump : fit.bumps) {
    const double x = (log10_ghz - bump.b) / bump.c;
    sum += bump.a * exact_exp2(-x * x * std::numbers::log2e);
  }
  return sum;
}

}  // namespace

RainLaw rain_law(double frequency_hz, Polarisation polarisation) {
  const double log10_ghz = 0.1 * decibels_from_ratio(frequency_hz * 1e-9);
  const bool level = polarisation == Polarisation::hh;
  return {ratio_from_decibels(10.0 * value_of(level ? kKhFit : kKvFit, log10_ghz)),
          value_of(level ? kAlphaHFit : kAlphaVFit, log10_ghz)};
}

double rain_db_per_km(const RainLaw& law, double rate_mm_h) {
  return rate_mm_h > 1e-30 ? law.k * exact_exp2(law.alpha * exact_log2(rate_mm_h)) : 0.0;
}

namespace {

constexpr double kKnotsPerRadius = 20.0;  // of an even area
constexpr double kValuesPerKnot = 1.25;   // of a map
constexpr double kOctavesPerKnot = 0.23;  // two-way, 0.7 dB
constexpr int kMostDoublings = 4;         // of a cell from knot to knot
constexpr float kMostOctaves = 66.0f;     // 199 dB two-way: all is lost

}  // namespace

double rain_profile(double distance_squared, double radius_m) {
  const double radius = radius_m * radius_m;
  const double s = std::clamp((radius - distance_squared) / (0.75 * radius), 0.0, 1.0);
  return s * s * (3.0 - 2.0 * s);
}

// An area's map at a time.  What was used last is kept here: no lock in the rule.
const RainMap& RainPath::map_of(const RainCell& cell, double seconds) {
  const RainMapKey key = rain_map_key(cell, seconds);
  const auto of_the_area = [&](const RainMapPtr& map) {
    const RainMapKey& k = map->key();
    return k.identity == key.identity && k.kind == key.kind && k.radius_m == key.radius_m;
  };
  auto found = std::find_if(maps_.begin(), maps_.end(), of_the_area);
  if (found == maps_.end()) {
    found = maps_.insert(maps_.end(), rain_map_for(key));
  } else if ((*found)->key() != key) {
    *found = rain_map_for(key);
  }
  return **found;
}

// Areas whose circle the spoke cuts, and the stretch of the spoke that they cover.
void RainPath::find_rain(const Scene& scene, const RadarModel& model, const SpokeAim& aim) {
  clouds_.clear();
  chords_.clear();
  // Each area has one: others are of areas that have changed or gone.
  if (maps_.size() > scene.rain.size()) maps_.clear();
  from_m_ = std::numeric_limits<double>::infinity();
  spacing_m_ = from_m_;
  to_m_ = greatest_rate_ = 0.0;
  const double reach = model.cell_m * model.geometry.cells;
  const SinCos ray = sin_cos_units(aim.plane_units);
  const double seconds = in_seconds(scene.time.time_since_epoch()) + aim.dt;
  const auto covers = [this](double from, double to, double spacing, double rate) {
    from_m_ = std::min(from_m_, from);
    to_m_ = std::max(to_m_, to);
    spacing_m_ = std::min(spacing_m_, spacing);
    greatest_rate_ += rate;
  };
  for (const RainCell& cell : scene.rain) {
    const PlanePoint off = cell.centre + cell.velocity * aim.dt - aim.own_ship;
    const double along = ahead_of(ray, off);
    const double across = right_of(ray, off);
    const double squared = cell.radius_m * cell.radius_m - across * across;
    if (!(squared > 0.0) || !(cell.rate_mm_h > 0.0)) continue;
    const double half = std::sqrt(squared);
    const double from = std::max(along - half, 0.0), to = std::min(along + half, reach);
    if (from >= to) continue;
    if (cell.kind == RainKind::even) {
      clouds_.push_back({static_cast<float>(along), static_cast<float>(across * across),
                         static_cast<float>(cell.radius_m * cell.radius_m),
                         static_cast<float>(cell.rate_mm_h)});
      covers(from, to, cell.radius_m / kKnotsPerRadius, cell.rate_mm_h);
      continue;
    }
    const RainMap& map = map_of(cell, seconds);
    if (const auto chord = find_rain_chord(cell, map, off, ray, reach)) {
      chords_.push_back(*chord);
      covers(chord->from_m, chord->to_m, kValuesPerKnot * std::sqrt(map.column_m() * map.row_m()),
             cell.rate_mm_h * map.greatest());
    }
  }
}

void RainPath::take_law(const RadarModel& model) {
  if (frequency_hz_ == model.set.frequency_hz && polarisation_ == model.set.polarisation &&
      cell_m_ == model.cell_m)
    return;
  frequency_hz_ = model.set.frequency_hz;
  polarisation_ = model.set.polarisation;
  cell_m_ = model.cell_m;
  const RainLaw law = rain_law(frequency_hz_, polarisation_);
  alpha_ = static_cast<float>(law.alpha);
  log2_octaves_ = static_cast<float>(exact_log2(2e-3 * law.k * cell_m_ * kOctavesPerDb));
}

// Keeps one dry knot at each end; whether any is wet.
bool RainPath::leave_out_dry_ends() {
  const auto wet = [](float rate) { return rate > 0.0f; };
  const auto begin = knot_rates_.begin();
  const auto first = std::find_if(begin, knot_rates_.end(), wet);
  any_ = first != knot_rates_.end();
  if (!any_) return false;
  const auto behind = std::find_if(knot_rates_.rbegin(), knot_rates_.rend(), wet).base();
  const auto lead = static_cast<std::size_t>(std::max(first - begin - 1, std::ptrdiff_t{0}));
  const auto last = static_cast<std::size_t>(behind - begin);
  end_ = std::min(end_, first_ + last * step_);
  first_ += lead * step_;
  knot_rates_.resize(std::min(knot_rates_.size(), last + 1));
  knot_rates_.erase(knot_rates_.begin(), knot_rates_.begin() + static_cast<std::ptrdiff_t>(lead));
  return true;
}

// Rate at the middle of every step_-th wet cell, and what is left of the power up to there.
void RainPath::lay_knots(double beam_width) {
  const auto greatest = static_cast<float>(greatest_rate_);
  const float octaves = fast_exp2(log2_octaves_ + alpha_ * fast_log2(greatest));
  const double spacing =
      std::min(spacing_m_, cell_m_ * kOctavesPerKnot / static_cast<double>(octaves));
  int doublings = kMostDoublings;
  while (doublings > 0 && static_cast<double>(1 << doublings) * cell_m_ > spacing) --doublings;
  step_ = std::size_t{1} << doublings;
  knot_rates_.assign((end_ - first_ + step_ - 1) / step_ + 1, 0.0f);
  const double first_m = (static_cast<double>(first_) + 0.5) * cell_m_;
  const double step_m = static_cast<double>(step_) * cell_m_;
  for (const CloudChord& cloud : clouds_)
    add_cloud(cloud, static_cast<float>(first_m), static_cast<float>(step_m), knot_rates_);
  for (const RainChord& chord : chords_) add_rain(chord, beam_width, first_m, step_m, knot_rates_);
  if (!leave_out_dry_ends()) return;
  const std::size_t knots = knot_rates_.size();
  knots_.resize(knots);
  rain_losses(knot_rates_, log2_octaves_ + static_cast<float>(doublings), alpha_, knots_);
  // The first knot stands half a cell into the rain; from knot to knot, the mean of the two.
  float before = knots_.front();
  float sum = before * (0.5f / static_cast<float>(step_));
  knots_.front() = std::min(sum, kMostOctaves);
  for (std::size_t j = 1; j < knots; ++j) {
    const float loss = knots_[j];
    sum += 0.5f * (before + loss);
    before = loss;
    knots_[j] = std::min(sum, kMostOctaves);
  }
  power_left(knots_);
}

void RainPath::trace(const Scene& scene, const RadarModel& model, const SpokeAim& aim) {
  any_ = false;
  if (scene.rain.empty()) return;
  find_rain(scene, model, aim);
  if (clouds_.empty() && chords_.empty()) return;
  any_ = true;
  take_law(model);
  const std::size_t cells = model.geometry.cells;
  first_ = std::min(static_cast<std::size_t>(from_m_ / cell_m_), cells - 1);
  end_ = std::clamp(static_cast<std::size_t>(to_m_ / cell_m_) + 1, first_ + 1, cells);
  lay_knots(model.set.beam_width_deg * kRadiansPerDegree);
}

void RainPath::lay(const Scene& scene, const RadarModel& model, const SpokeAim& aim) {
  trace(scene, model, aim);
  if (!any_) return;
  rate_.assign(model.geometry.cells, 0.0f);
  transmission_.resize(model.geometry.cells);
  const std::size_t wet = end_ - first_;
  const auto row = std::span(transmission_);
  spread_knots(knot_rates_, step_, std::span(rate_).subspan(first_, wet));
  spread_knots(knots_, step_, row.subspan(first_, wet));
  fill_row(1.0f, row.first(first_));
  fill_row(knots_.back(), row.subspan(end_));
}

}  // namespace skerry::echo
