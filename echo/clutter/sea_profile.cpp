#include "echo/clutter/sea_profile.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numbers>

#include "echo/clutter/gamma_law.hpp"
#include "echo/clutter/nrl_sea.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/shared_tables.hpp"
#include "echo/propagation/path_terms.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry::echo {

// Between two values of unit variance and correlation r a straight line has the variance
// 1 - 2 f (1 - f)(1 - r) at the share f of the way.  Averaged over `steps` places of which the
// first is a sample, the share of the variance that is lost.
double variance_lost(double correlation, std::uint32_t steps);

// Correlation of two gamma values of shape nu whose Gaussian origins are correlated by 1 - u, u
// small: 1 - u (1 + nu) ln(1 + 1/nu), that of the log-normal of the same variance; 0 at least.
double texture_correlation(double gaussian_correlation, double nu);

// Correlation, averaged over places, of two mixtures of unit variance (texture_octaves) of
// uncorrelated neighbours, `apart` (0 to 1) of their distance from each other.
double mixture_correlation(double apart);

double variance_lost(double correlation, std::uint32_t steps) {
  const double n = steps;
  return (1.0 - correlation) * (n * n - 1.0) / (3.0 * n * n);
}

double texture_correlation(double gaussian_correlation, double nu) {
  const double slope = (1.0 + nu) * std::numbers::ln2 * exact_log2(1.0 + 1.0 / nu);
  return std::max(0.0, 1.0 - (1.0 - gaussian_correlation) * slope);
}

double mixture_correlation(double apart) {
  constexpr int kPlaces = 64;
  double sum = 0.0;
  for (int k = 0; k < kPlaces; ++k) {
    const double a = (k + 0.5) / kPlaces, b = a + apart;
    const double c = b - 1.0;  // beyond the second neighbour
    const double shared = c <= 0.0 ? (1.0 - a) * (1.0 - b) + a * b : a * (1.0 - c);
    const double other = c <= 0.0 ? b : c;
    sum += shared / std::sqrt((a * a + (1.0 - a) * (1.0 - a)) *
                              (other * other + (1.0 - other) * (1.0 - other)));
  }
  return sum / kPlaces;
}

namespace {

constexpr double kLeastCosine = 0.05;

// Both ways, of a Gaussian vertical beam along the horizon; -40 dB at least.
double vertical_loss(double grazing_rad, double beam_deg) {
  const double share = grazing_rad * kDegreesPerRadian / beam_deg;
  return exact_exp2(std::max(-8.0 * share * share, -13.3));
}

}  // namespace

SeaProfile::SeaProfile(const RadarModel& model, const Atmosphere& atmosphere, const SeaSurface& sea,
                       const Sampling& sampling)
    : polarisation_(model.set.polarisation),
      swell_from_deg_(sea.swell.from_deg),
      swell_(sea.swell) {
  if (!(sea.state > 0.0)) return;
  const PathConditions path = path_conditions(model.set, atmosphere, 0.0);
  const double pulse_m = 0.5 * kLightSpeed * model.pulse.length_s;
  struct Water {
    double grazing_rad = 0.0, area_m2 = 0.0, spread = 0.0, mean = 0.0;
  };
  const auto water_at = [&](double range_m) {
    Water w;
    const double sine = sine_of_grazing(range_m, path.antenna_height_m, path.effective_earth_m);
    // Nearer than the antenna is high there is no water, beyond the horizon none in sight.
    if (sine <= 0.0 || range_m <= path.antenna_height_m) return w;
    const double cosine = std::max(kLeastCosine, std::sqrt(1.0 - sine * sine));
    w.grazing_rad = exact_atan2(sine, cosine);
    w.area_m2 = range_m * sampling.clutter_width * pulse_m / cosine;
    w.spread = wind_spread(path.wavelength_m, w.grazing_rad);
    const double sigma = w.area_m2 * sea_reflectivity(model.set.frequency_hz, polarisation_,
                                                      w.grazing_rad * kDegreesPerRadian, sea.state);
    const double gas = ratio_from_decibels(-2e-3 * path.gas_db_km * range_m);
    w.mean = model.unit_snr * sigma / (range_m * range_m * range_m * range_m) * gas *
             vertical_loss(w.grazing_rad, model.set.vertical_beam_deg) / bessel_i0(w.spread);
    return w;
  };

  std::vector<Water> water;
  std::size_t reach = 0;
  for (std::uint32_t i = 0; i < model.geometry.cells; ++i) {
    const double range_m = (i + 0.5) * model.cell_m;
    water.push_back(water_at(range_m));
    const Water& w = water.back();
    if (w.mean * exact_exp2(std::numbers::log2e * w.spread) >= kLeastSeaClutter) reach = i + 1;
    // Past the vertical beam's blind cone clutter only falls.
    if (w.mean > 0.0 && reach + 1 < i && w.grazing_rad * kDegreesPerRadian < 3.0) break;
  }
  if (reach == 0) return;
  water.resize(reach);

  const double apart_m = std::max(sampling.shortest_length_m, pulse_m) / 3.0;
  while (cells_per_sample_ < 16 && 2.0 * cells_per_sample_ * model.cell_m <= apart_m) {
    cells_per_sample_ *= 2;
  }
  samples_per_pulse_ = static_cast<std::uint32_t>(
      std::clamp(pulse_m / (cells_per_sample_ * model.cell_m) + 0.5, 1.0, double{kMostPerPulse}));
  for (const Water& w : water) mean_.push_back(static_cast<float>(w.mean));
  const std::size_t samples = reach / cells_per_sample_ + 2;
  for (std::size_t s = 0; s < samples; ++s) {
    const std::size_t cell = std::min(s * cells_per_sample_, reach - 1);
    const double side = (static_cast<double>(cell) + 0.5) * model.cell_m * sampling.node_radians;
    spread_.push_back(static_cast<float>(std::numbers::log2e * water[cell].spread));
    // Beyond nine lengths nothing is left of the correlation.
    apart2_.push_back(static_cast<float>(
        std::min(side * side, 80.0 * sampling.shortest_length_m * sampling.shortest_length_m)));
  }
  // 1 / L^2 averaged over directions.
  const double decay = 0.5 / (sampling.shortest_length_m * sampling.shortest_length_m) +
                       0.5 / (sampling.longest_length_m * sampling.longest_length_m);
  const auto field_correlation = [&](double apart) {
    return exact_exp2(-std::numbers::log2e * std::min(60.0, decay * apart * apart));
  };
  const double step_m = cells_per_sample_ * model.cell_m;
  double same = 0.0, next = 0.0;
  for (int k = -static_cast<int>(samples_per_pulse_); k <= static_cast<int>(samples_per_pulse_);
       ++k) {
    const double pairs = samples_per_pulse_ - std::fabs(k);
    same += pairs * field_correlation(k * step_m);
    next += pairs * field_correlation((k + 1) * step_m);
  }
  sample_correlation_ = next / same;
  row_spokes_ = sampling.row_spokes;
  const double far_rows = mixture_correlation(sampling.row_share);
  for (std::size_t s = 0; s < samples; s += kSamplesPerLaw) {
    const std::size_t cell = std::min((s + kSamplesPerLaw / 2) * cells_per_sample_, reach - 1);
    const double side = (static_cast<double>(cell) + 0.5) * model.cell_m * sampling.node_radians;
    blocks_.push_back({water[cell].grazing_rad, water[cell].area_m2,
                       1.0 - (1.0 - far_rows) * (1.0 - field_correlation(side))});
  }
}

double SeaProfile::shape(std::size_t block, double bearing_deg) const {
  const Block& b = blocks_[block];
  const double grazing_deg = b.grazing_rad * kDegreesPerRadian;
  return swell_.any() ? k_shape_in_swell(grazing_deg, b.area_m2, polarisation_,
                                         bearing_deg - swell_from_deg_)
                      : k_shape(grazing_deg, b.area_m2, polarisation_);
}

SeaProfile::Look SeaProfile::look(double bearing_deg) const {
  Look look;
  const SinCos direction = sin_cos_degrees(bearing_deg);
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    double nu = shape(b, bearing_deg);
    if (swell_.any()) {
      const auto wave =
          swell_.modulation(blocks_[b].grazing_rad, swell_.towards(direction.sin, direction.cos));
      look.waves.push_back({static_cast<float>(wave.height), static_cast<float>(wave.mean),
                            static_cast<float>(wave.lead)});
      // (1 + 1/nu) = (1 + 1/nu of the texture alone)(1 + variance of the wave).
      const double rest = (1.0 + 1.0 / nu) / (1.0 + wave.variance) - 1.0;
      nu = rest > 1.0 / kGreatestShape ? 1.0 / rest : kGreatestShape;
    }
    const double kept =
        (1.0 - variance_lost(texture_correlation(sample_correlation_, nu), cells_per_sample_)) *
        (1.0 - variance_lost(texture_correlation(blocks_[b].row_correlation, nu), row_spokes_));
    look.laws.push_back(gamma_law(nu * kept));
  }
  return look;
}

namespace {

// All that a profile is made of.
struct SeaProfileKey {
  PathConditions path;
  std::array<double, 17> numbers;
  friend bool operator==(const SeaProfileKey&, const SeaProfileKey&) = default;
};

}  // namespace

std::shared_ptr<const SeaProfile> sea_profile_for(const RadarModel& model,
                                                  const Atmosphere& atmosphere,
                                                  const SeaSurface& sea,
                                                  const SeaProfile::Sampling& sampling) {
  static SharedTables<SeaProfileKey, SeaProfile> tables;
  const SeaProfileKey key{
      path_conditions(model.set, atmosphere, 0.0),
      {model.set.frequency_hz, static_cast<double>(model.set.polarisation),
       model.set.vertical_beam_deg, model.pulse.length_s, model.unit_snr, model.cell_m,
       static_cast<double>(model.geometry.cells), sea.state, sea.swell.height_m, sea.swell.period_s,
       sea.swell.from_deg, sampling.clutter_width, sampling.shortest_length_m,
       sampling.longest_length_m, sampling.node_radians, sampling.row_share,
       static_cast<double>(sampling.row_spokes)}};
  return tables.get(key, [&] { return SeaProfile(model, atmosphere, sea, sampling); });
}

}  // namespace skerry::echo
