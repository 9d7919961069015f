#include "server/world/handling/bank_load.hpp"

#include <array>
#include <numbers>

#include "server/world/handling/hull_math.hpp"

namespace skerry::server {
namespace {

constexpr int kPanels = 24;  // of her length
constexpr int kMirrors = 2;  // of the bottom, one by one; the others as an integral
constexpr double kFadesFromBeams = 6.0;
constexpr double kLeastDraughts = 1.1, kMostDraughts = 20.0;
constexpr double kLeastPrismatic = 2.0 / 3.0;  // of a hull without a parallel middle

// How much her section grows aft of a place over each panel, m^2: positive at the stern.
std::array<double, kPanels> growth(const BankShape& shape) {
  const double prismatic = std::max(shape.block, kLeastPrismatic);
  const double most = shape.block / prismatic * shape.beam_m * shape.draught_m;
  const double parallel = std::min(3.0 * prismatic - 2.0, 0.99);  // half of it, in half lengths
  const auto area = [&](int edge) {
    const double place = std::fabs(2.0 * edge / kPanels - 1.0);
    const double beyond = std::max(place - parallel, 0.0) / (1.0 - parallel);
    return most * (1.0 - squared(beyond));
  };
  std::array<double, kPanels> grows{};
  for (int i = 0; i < kPanels; ++i) {
    grows[static_cast<std::size_t>(i)] = area(i + 1) - area(i);
  }
  return grows;
}

// What sources of a unit at `along_m` send through the ship's own line by their images.
class Mirrors {
 public:
  Mirrors(double distance_m, double depth_m)
      : twice_m_(2.0 * distance_m), depth_m_(depth_m), beyond_m_(depth_m * (2 * kMirrors + 1)) {}

  double across(double along_m) const {
    const double beside = squared(along_m) + squared(twice_m_);
    double sum = 1.0 / (beside * std::sqrt(beside));
    for (int k = 1; k <= kMirrors; ++k) {
      const double far = beside + squared(2.0 * k * depth_m_);
      sum += 2.0 / (far * std::sqrt(far));
    }
    const double rest = std::sqrt(beside + squared(beyond_m_));
    sum += 1.0 / (depth_m_ * rest * (rest + beyond_m_));
    return twice_m_ * sum;
  }

 private:
  double twice_m_, depth_m_, beyond_m_;
};

double plate_mass(double draught_m, double depth_m) {
  const double cosine = sin_cos(0.5 * std::numbers::pi * draught_m / depth_m).cos;
  return -4.0 * kSeaWater_kg_m3 * squared(depth_m) / std::numbers::pi * std::numbers::ln2 *
         echo::exact_log2(cosine);
}

}  // namespace

BankPull wall_pull(const BankShape& shape, double distance_m, double depth_m) {
  if (distance_m >= bank_reach_m(shape)) return {};
  const double nearest = bank_nearest_m(shape);
  const double depth =
      std::clamp(depth_m, kLeastDraughts * shape.draught_m, kMostDraughts * shape.draught_m);
  const Mirrors mirrors(std::max(distance_m, nearest), depth);
  const std::array<double, kPanels> grows = growth(shape);
  const double panel = shape.length_m / kPanels;

  double suction = 0.0, at_stern = 0.0;
  for (std::size_t apart = 0; apart < kPanels; ++apart) {
    double pairs = 0.0;
    for (std::size_t i = 0; i + apart < kPanels; ++i) pairs += grows[i] * grows[i + apart];
    const double along = static_cast<double>(apart);
    suction += (apart == 0 ? 1.0 : 2.0) * pairs * mirrors.across(along * panel);
    at_stern += grows[apart] * mirrors.across((along + 0.5) * panel);
  }
  const double shed = plate_mass(shape.draught_m, depth) * at_stern / (2.0 * std::numbers::pi);
  const double fade =
      std::min(distance_m / nearest, 1.0) *
      (1.0 - smooth_step(distance_m, kFadesFromBeams * shape.beam_m, bank_reach_m(shape)));
  return {.sway = fade * (kSeaWater_kg_m3 / (2.0 * std::numbers::pi) * suction + shed),
          .yaw = -0.5 * shape.length_m * fade * shed};
}

Loads bank_load(const BankPull& pull, double u) {
  return {.y = pull.sway * squared(u), .n = pull.yaw * u * std::fabs(u)};
}

}  // namespace skerry::server
