#include "echo/returns/land_returns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/returns/radar_equation.hpp"

namespace skerry::echo {
namespace {

constexpr double kGamma = 0.158;  // -8 dB
constexpr double kBankHeight = 4.0;
constexpr std::array<NoiseOctave, 2> kBroad = {{{2300.0, 0.6f}, {900.0, 0.4f}}};
constexpr std::array<NoiseOctave, 4> kFine = {
    {{330.0, 0.45f}, {130.0, 0.3f}, {52.0, 0.17f}, {21.0, 0.08f}}};
constexpr double kEarthRadius = 6371000.0;

// The finest octaves a cell can show: at least two cells to a wavelength.
std::span<const NoiseOctave> visible(std::span<const NoiseOctave> octaves, double cell_m) {
  std::size_t n = octaves.size();
  while (n > 1 && octaves[n - 1].wavelength_m < 2.0 * cell_m) --n;
  return octaves.first(n);
}

}  // namespace

double land_height(double inland_m, double broad_noise, double fine_noise) {
  const double rise = 95.0 * inland_m / (inland_m + 900.0) * (1.0 + 0.9 * broad_noise);
  const double rough = std::min(0.16 * inland_m, 26.0);
  return std::max(0.5, kBankHeight + rise + rough * fine_noise);
}

namespace {

// The most land_height() can be that far inland.
double greatest_height(double inland_m) { return land_height(inland_m, 1.0, 1.0); }

// One ray across land, nearest cell first.
class LandRay {
 public:
  LandRay(const LandModel& model, const LatticePath& path, std::span<float> power)
      : model_(model),
        path_(path),
        power_(power),
        horizon_(std::sqrt(2.0 * kEffectiveEarth * model.antenna_height_m)) {}

  // Cells first .. last of a stretch, none more than kChunk.
  void add(const LandInterval& stretch, std::size_t first, std::size_t last) {
    if (hidden(stretch, first, last)) return;
    float broad[kChunk], fine[kChunk];
    const std::size_t count = last - first + 1;
    const auto first32 = static_cast<std::uint32_t>(first);
    relief_noise(path_, visible(kBroad, model_.cell_m), model_.seed, first32, {broad, count});
    relief_noise(path_, visible(kFine, model_.cell_m), model_.seed ^ 0x51F1Eu, first32,
                 {fine, count});
    for (std::size_t k = 0; k < count; ++k) {
      add_cell(stretch, first + k, static_cast<double>(broad[k]), static_cast<double>(fine[k]));
    }
  }

  static constexpr std::size_t kChunk = 32;

 private:
  double middle_of(std::size_t cell) const {
    return (static_cast<double>(cell) + 0.5) * model_.cell_m;
  }
  static double drop_at(double range) { return range * range / (2.0 * kEffectiveEarth); }
  // The slope below which the sea's own curve or the land before hides everything at that range.
  double hidden_below(double range) const {
    const double sea_range = std::min(range, horizon_);
    const double sea = -model_.antenna_height_m / sea_range - sea_range / (2.0 * kEffectiveEarth);
    return std::max(shadow_, sea);
  }

  // Whether no cell of the chunk can show, however high its land: then nothing of it need be made.
  bool hidden(const LandInterval& stretch, std::size_t first, std::size_t last) const {
    const double near = middle_of(first), far = middle_of(last);
    const double inland =
        std::max(0.0, std::min(far - stretch.begin_m, stretch.end_m - near) + model_.cell_m);
    const double above = greatest_height(inland) - model_.antenna_height_m - drop_at(near) + 1e-3;
    return above / (above > 0.0 ? near : far) <= shadow_;
  }

  void add_cell(const LandInterval& stretch, std::size_t cell, double broad, double fine) {
    const double middle = middle_of(cell);
    const double range = std::clamp(middle, stretch.begin_m, stretch.end_m);
    const double inland = std::min(range - stretch.begin_m, stretch.end_m - range);
    const double height = land_height(std::max(0.0, inland), broad, fine);
    const double below = hidden_below(middle);
    const double slope = (height - model_.antenna_height_m - drop_at(middle)) / middle;
    if (slope <= below) return;
    const double shown = std::min(height, (slope - below) * middle);
    shadow_ = slope;
    const double cover = 1.0 + 0.8 * fine;
    power_[cell] += static_cast<float>(model_.unit_signal_to_noise * kGamma * cover *
                                       model_.ray_radians * shown / (middle * middle * middle));
  }

  const LandModel& model_;
  const LatticePath& path_;
  std::span<float> power_;
  double horizon_;
  double shadow_ = -1e9;
};

}  // namespace

void add_land(std::span<const LandInterval> land, const LandModel& model, const LatticePath& path,
              std::span<float> power) {
  LandRay ray(model, path, power);
  for (const LandInterval& stretch : land) {
    const auto first = static_cast<std::size_t>(stretch.begin_m / model.cell_m);
    if (first >= power.size()) break;
    const std::size_t last =
        std::min(power.size() - 1, static_cast<std::size_t>(stretch.end_m / model.cell_m));
    for (std::size_t cell = first; cell <= last; cell += LandRay::kChunk) {
      ray.add(stretch, cell, std::min(last, cell + LandRay::kChunk - 1));
    }
  }
}

LatticePath lattice_path(GeoPoint own_ship, PlanePoint sailed, std::uint32_t true_bearing_units,
                         double cell_m) {
  const SinCos lat = sin_cos_degrees(own_ship.latitude_deg);
  const SinCos bearing = sin_cos_units(true_bearing_units);
  constexpr double kMetresPerDegree = kEarthRadius * std::numbers::pi / 180.0;
  const double cos_lat = std::max(lat.cos, 1e-6);
  double east_scale = 1.0;
  while (east_scale > cos_lat && east_scale > 1.0 / 1024.0) east_scale *= 0.5;
  const double tan_lat = std::clamp(lat.sin / cos_lat, -1000.0, 1000.0);
  // At range s: latitude + s cos - s^2 sin^2 tan / 2R, longitude (s sin + s^2 sin cos tan / R) /
  // cos.
  const double squeeze = east_scale / cos_lat;
  LatticePath path;
  path.north1 = bearing.cos * cell_m;
  path.north2 = -0.5 * bearing.sin * bearing.sin * tan_lat / kEarthRadius * cell_m * cell_m;
  path.east1 = bearing.sin * squeeze * cell_m;
  path.east2 = bearing.sin * bearing.cos * tan_lat / kEarthRadius * squeeze * cell_m * cell_m;
  // From the own ship to the middle of cell 0.
  path.north0 = own_ship.latitude_deg * kMetresPerDegree + sailed.north_m + 0.5 * path.north1;
  path.east0 = own_ship.longitude_deg * kMetresPerDegree * east_scale + sailed.east_m * squeeze +
               0.5 * path.east1;
  return path;
}

}  // namespace skerry::echo
