#include "echo/clutter/sea_returns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "echo/kernel/azimuth_sum.hpp"
#include "echo/kernel/clutter_row.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/kernel/shelf.hpp"
#include "echo/radar/antenna_pattern.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {
namespace {

// Scatterers on the water forget their phases in 5 to 10 ms at X band, in proportion to the
// wavelength (SOURCES.md "Sea").
double speckle_lifetime(double wavelength_m) { return 7.5e-3 * wavelength_m / 0.0318589; }

// Looks are made for 128 directions.
constexpr int kDirectionBits = 7;

// Directions in the plane turn by hundredths of a degree as the ship sails and the meridians
// converge; that is no other weather.
constexpr double kSameDirection = 0.25;  // degrees

bool same_direction(double a_deg, double b_deg) {
  const double off = std::fabs(a_deg - b_deg);
  return off <= kSameDirection || off >= 360.0 - kSameDirection;
}

bool same_swell(const Swell& a, const Swell& b) {
  return a.height_m == b.height_m && a.period_s == b.period_s &&
         same_direction(a.from_deg, b.from_deg);
}

Shelf<AlignedFloats>& row_shelf() {
  static Shelf<AlignedFloats> shelf;
  return shelf;
}

}  // namespace

SeaReturns::SeaReturns(const RadarModel& model, std::uint32_t texture_spokes)
    : model_(model), clutter_width_(antenna_pattern_for(model.set)->clutter_width()) {
  const double beam_spokes = model.set.beam_width_deg / 360.0 * model.geometry.spokes_per_turn;
  texture_spokes_ = texture_spokes;
  if (texture_spokes_ == 0) {
    texture_spokes_ = 1;
    while (2.0 * texture_spokes_ <= beam_spokes / 3.0) texture_spokes_ *= 2;
  }
  nodes_per_turn_ = static_cast<std::uint32_t>(
      std::max(8.0, model.geometry.spokes_per_turn / std::max(1.0, beam_spokes)));
}

bool SeaReturns::unchanged(const Scene& scene) const {
  return weather_ && weather_->seed == scene.seed && weather_->sea.state == scene.sea.state &&
         same_direction(weather_->sea.wind_from_deg, scene.sea.wind_from_deg) &&
         same_swell(weather_->sea.swell, scene.sea.swell) &&
         weather_->atmosphere.k_factor == scene.atmosphere.k_factor;
}

void SeaReturns::prepare(const Scene& scene, const SpokeAim& first, const SpokeAim& last,
                         std::span<const std::uint8_t> wet) {
  if (!unchanged(scene)) {
    weather_ = {scene.atmosphere, scene.sea, scene.seed};
    nodes_.clear();
    looks_.clear();
    field_.emplace(scene.sea, mixed(scene.seed, 0x5EA));
    SeaProfile::Sampling sampling;
    sampling.clutter_width = clutter_width_;
    sampling.shortest_length_m = field_->shortest_length_m();
    sampling.longest_length_m = field_->longest_length_m();
    sampling.node_radians = kRadiansPerTurn / nodes_per_turn_;
    sampling.row_spokes = texture_spokes_;
    sampling.row_share = std::min(
        1.0, double{1} * texture_spokes_ * nodes_per_turn_ / model_.geometry.spokes_per_turn);
    profile_ = sea_profile_for(model_, scene.atmosphere, scene.sea, sampling);
    row_count_ = 0;
    speckle_key_ = mixed(scene.seed, model_.radar, 0x5EA5BEC);
    pitch_ = (profile_->reach() + 31u) & ~std::size_t{15};
    octaves_.resize(profile_->samples());
    raw_.resize(profile_->samples() + profile_->samples_per_pulse());
    if (any() && !speckle_) {
      const SpeckleLengths lengths =
          speckle_lengths(model_, speckle_lifetime(model_.set.wavelength_m()));
      speckle_ = speckle_for(lengths.spokes, lengths.cells);
    }
  }
  if (!any()) return;
  look_for_water(wet);
  const std::uint64_t first_row = first.spoke / texture_spokes_;
  const std::uint64_t last_row = last.spoke / texture_spokes_ + (texture_spokes_ > 1 ? 1 : 0);
  const auto count = static_cast<std::size_t>(last_row - first_row + 1);
  const bool goes_on = row_count_ > 0 && first_row == first_row_ + row_count_ - 1;
  const bool released = rows_.empty();
  if (released) rows_ = row_shelf().take();
  if (rows_.size() < count * pitch_) rows_.resize(count * pitch_);
  if (goes_on) {
    const float* const kept =
        released ? last_row_.data() : rows_.data() + (row_count_ - 1) * pitch_;
    std::copy(kept, kept + pitch_, rows_.begin());
    std::swap(laid_.front(), laid_[row_count_ - 1]);
  }
  first_row_ = first_row;
  row_count_ = count;
  laid_.resize(row_count_);
  for (std::size_t r = 0; r < row_count_; ++r) {
    if (r > 0 || !goes_on) laid_[r].reset();
    lay_row(scene, (first_row_ + r) * texture_spokes_, laid_[r],
            std::span(rows_).subspan(r * pitch_, profile_->reach()));
  }
  // The next sector continues from these.
  std::erase_if(nodes_, [&](Node& n) {
    const bool done = n.used_for != last_row * texture_spokes_;
    if (done) spare_ = std::move(n.values);
    return done;
  });
}

void SeaReturns::release() {
  if (rows_.empty()) return;
  if (row_count_ > 0) {
    const float* const last = rows_.data() + (row_count_ - 1) * pitch_;
    last_row_.assign(last, last + pitch_);
  }
  row_shelf().put_back(std::exchange(rows_, {}));
}

void SeaReturns::look_for_water(std::span<const std::uint8_t> wet) {
  wanted_.reset();
  const std::size_t cells_per_block = kSamplesPerLaw * profile_->cells_per_sample();
  for (std::size_t c = 0; c < profile_->reach(); c += std::min(kWetCells, cells_per_block)) {
    if (c / kWetCells >= wet.size() || wet[c / kWetCells] != 0) wanted_.set(c / cells_per_block);
  }
}

template <typename Use>
void SeaReturns::for_missing(const Blocks& wanted, Blocks& made, Use&& use) const {
  const std::size_t blocks = (profile_->samples() + kSamplesPerLaw - 1) / kSamplesPerLaw;
  for (std::size_t b = 0; b < blocks;) {
    std::size_t end = b;
    while (end < blocks && wanted[end] && !made[end]) made.set(end++);
    if (end > b)
      use(b * kSamplesPerLaw, std::min<std::size_t>(end * kSamplesPerLaw, profile_->samples()));
    b = end + 1;
  }
}

std::uint32_t SeaReturns::node_units(std::uint32_t index) const {
  return static_cast<std::uint32_t>((std::uint64_t{index} << 32) / nodes_per_turn_);
}

SeaReturns::Node& SeaReturns::node(const Scene& scene, std::uint32_t index, const SpokeAim& near) {
  // The spoke that looks along the node.
  const double ahead = static_cast<std::int32_t>(node_units(index) - near.plane_units) * 0x1p-32 *
                       model_.geometry.spokes_per_turn;
  const double at = static_cast<double>(near.spoke) + std::floor(ahead + 0.5);
  const std::uint64_t spoke = at > 0.0 ? static_cast<std::uint64_t>(at) : 0;
  auto found = std::find_if(nodes_.begin(), nodes_.end(),
                            [&](const Node& n) { return n.index == index && n.spoke == spoke; });
  if (found == nodes_.end()) {
    nodes_.push_back({index, spoke, near.spoke, {}, std::move(spare_)});
    found = nodes_.end() - 1;
    found->values.resize(profile_->samples());
  }
  found->used_for = near.spoke;
  sample_node(scene, *found);
  return *found;
}

void SeaReturns::sample_node(const Scene& scene, Node& node) {
  // A row needs a sample or two behind its last block.
  const Blocks wanted = wanted_ | wanted_ << 1;
  if ((wanted & ~node.sampled).none()) return;
  const SpokeAim aim = aim_of(scene, model_.clock, node.spoke);
  const SinCos look = sin_cos_units(node_units(node.index));
  const std::uint32_t taps = profile_->samples_per_pulse();
  const double step_m = profile_->cells_per_sample() * model_.cell_m;
  const double first_m = 0.5 * model_.cell_m - 0.5 * (taps - 1) * step_m;
  // The mean over the pulse, back to unit variance.
  const double decay = field_->inverse_length2(look.sin, look.cos) * step_m * step_m;
  double variance = taps;
  for (std::uint32_t k = 1; k < taps; ++k) {
    variance += 2.0 * (taps - k) * exact_exp2(-std::numbers::log2e * std::min(decay * k * k, 60.0));
  }
  const auto weight = static_cast<float>(1.0 / std::sqrt(variance));
  std::array<WeightedRay, SeaProfile::kMostPerPulse> rays;
  for_missing(wanted, node.sampled, [&](std::size_t begin, std::size_t end) {
    const std::span raw = std::span(raw_).first(end - begin + taps - 1);
    field_->sample(aim.own_ship, look.sin, look.cos, first_m, step_m,
                   in_seconds(scene.time.time_since_epoch()) + aim.dt,
                   static_cast<std::uint32_t>(begin), raw);
    for (std::uint32_t k = 0; k < taps; ++k) rays[k] = {raw.data() + k, weight};
    sum_rays(std::span(rays).first(taps), std::span(node.values).subspan(begin, end - begin));
  });
}

const SeaProfile::Look& SeaReturns::look_towards(std::uint32_t plane_units) {
  const bool swell = weather_->sea.swell.height_m > 0.0;
  const std::uint32_t direction = swell ? plane_units >> (32 - kDirectionBits) : 0;
  for (const Kept& k : looks_) {
    if (k.direction == direction) return k.look;
  }
  if (looks_.size() >= 4) looks_.erase(looks_.begin());
  looks_.push_back({direction, profile_->look((direction + 0.5) * (360.0 / 128.0))});
  return looks_.back().look;
}

SeaReturns::RowParts SeaReturns::parts_of_row(const Scene& scene, const SpokeAim& aim) {
  const auto before =
      static_cast<std::uint32_t>((std::uint64_t{aim.plane_units} * nodes_per_turn_) >> 32);
  const std::uint32_t after = before + 1 == nodes_per_turn_ ? 0 : before + 1;
  const std::uint32_t from = node_units(before);
  const double share =
      static_cast<double>(aim.plane_units - from) / static_cast<double>(node_units(after) - from);
  // In this order: making the second may move the first.
  node(scene, before, aim);
  const Node& second = node(scene, after, aim);
  const Node& first = node(scene, before, aim);
  const SinCos look = sin_cos_units(aim.plane_units);
  const SinCos wind = sin_cos_degrees(scene.sea.wind_from_deg);
  RowParts parts;
  parts.mix.first = first.values;
  parts.mix.second = second.values;
  parts.mix.share = static_cast<float>(std::clamp(share, 0.0, 1.0));
  parts.mix.apart2 = profile_->apart2();
  parts.mix.decay =
      static_cast<float>(std::numbers::log2e * field_->inverse_length2(look.cos, -look.sin));
  parts.mix.spread = profile_->spread();
  parts.mix.spread_share = static_cast<float>(look.sin * wind.sin + look.cos * wind.cos);
  parts.look = &look_towards(aim.plane_units);
  if (!parts.look->waves.empty()) {
    const SwellWave swell(scene.sea.swell);
    const double turns = swell.turns_per_metre(swell.towards(look.sin, look.cos));
    const double seconds = in_seconds(scene.time.time_since_epoch()) + aim.dt;
    parts.wave_phase = swell.phase_at(aim.own_ship, seconds) + 0.5 * model_.cell_m * turns;
    parts.wave_step = turns * profile_->cells_per_sample() * model_.cell_m;
  }
  return parts;
}

void SeaReturns::lay_row(const Scene& scene, std::uint64_t spoke, Blocks& laid,
                         std::span<float> row) {
  if ((wanted_ & ~laid).none()) return;
  const RowParts parts = parts_of_row(scene, aim_of(scene, model_.clock, spoke));
  const std::size_t cells = profile_->cells_per_sample();
  for_missing(wanted_, laid, [&](std::size_t begin, std::size_t end) {
    const std::size_t cell = begin * cells, count = std::min(row.size(), end * cells) - cell;
    const std::size_t samples = std::min<std::size_t>(end + 2, profile_->samples()) - begin;
    const auto octaves = std::span(octaves_).first(samples);
    const std::size_t law = begin / kSamplesPerLaw;
    TextureMix mix = parts.mix;
    for (auto* values : {&mix.first, &mix.second, &mix.apart2, &mix.spread})
      *values = values->subspan(begin, samples);
    texture_octaves(mix, std::span(parts.look->laws).subspan(law), octaves);
    if (!parts.look->waves.empty()) {
      add_wave(std::span(parts.look->waves).subspan(law), static_cast<float>(parts.wave_phase),
               static_cast<float>(parts.wave_step), static_cast<std::uint32_t>(begin), octaves);
    }
    lay_texture(octaves, profile_->cells_per_sample(), std::span(profile_->mean()).subspan(cell),
                row.subspan(cell, count));
  });
}

void SeaReturns::local_mean_reference(const Scene& scene, const SpokeAim& aim,
                                      std::span<double> row) {
  const RowParts parts = parts_of_row(scene, aim);
  std::vector<double> octaves(profile_->samples());
  texture_octaves_reference(parts.mix, parts.look->laws, octaves);
  if (!parts.look->waves.empty()) {
    add_wave_reference(parts.look->waves, parts.wave_phase, parts.wave_step, octaves);
  }
  std::copy(octaves.begin(), octaves.end(), octaves_.begin());
  lay_texture_reference(octaves_, profile_->cells_per_sample(), profile_->mean(),
                        row.first(profile_->reach()));
}

void SeaReturns::local_mean(const SpokeAim& aim, std::span<float> row) const {
  const auto rows = rows_about(aim);
  for (std::size_t i = 0; i < rows.first.size(); ++i) {
    row[i] = rows.first[i] + rows.share * (rows.second[i] - rows.first[i]);
  }
}

SeaReturns::RowPair SeaReturns::rows_about(const SpokeAim& aim) const {
  const auto k = static_cast<std::size_t>(aim.spoke / texture_spokes_ - first_row_);
  const std::span rows(rows_);
  RowPair pair;
  pair.share =
      static_cast<float>(aim.spoke % texture_spokes_) / static_cast<float>(texture_spokes_);
  pair.first = rows.subspan(k * pitch_, profile_->reach());
  pair.second =
      texture_spokes_ > 1 ? rows.subspan((k + 1) * pitch_, profile_->reach()) : pair.first;
  return pair;
}

void SeaReturns::add(const SpokeAim& aim, std::span<float> power, std::uint32_t first_cell,
                     std::uint32_t end_cell) const {
  const std::uint32_t reach = profile_->reach();
  const std::uint32_t end = std::min(end_cell, reach);
  if (first_cell >= end) return;
  const RowPair rows = rows_about(aim);
  add_speckled(
      rows.first, rows.second, rows.share,
      speckle_->packed_row({speckle_key_, aim.scan, aim.index, model_.geometry.spokes_per_turn},
                           end, first_cell),
      power.first(reach), first_cell, end);
}

void SeaReturns::add(const SpokeAim& aim, std::span<float> power) const {
  add(aim, power, 0, static_cast<std::uint32_t>(power.size()));
}

}  // namespace skerry::echo
