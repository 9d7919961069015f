#include "echo/targets/ship_figure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "echo/kernel/hash.hpp"
#include "echo/targets/fluctuation.hpp"

namespace skerry::echo {
namespace {

constexpr std::uint32_t kStations = 64, kZones = 16;
constexpr double kGivenAt = 9.41e9;  // Hz: Hull::cross_section_m2 is of X band
constexpr std::uint64_t kPeakSalt = 0xBEA1, kStationSalt = 0x57A7, kZoneSalt = 0xA59E,
                        kPassSalt = 0x5CA7;

using Density = std::array<float, kStations>;

float unit_of(std::uint64_t hash) { return static_cast<float>(hash >> 40) * 0x1p-24f; }

// Slow change with the aspect: values at 32 knots of the circle, joined by smoothstep.
float wander(std::uint64_t key, std::uint32_t aspect_units) {
  const std::uint32_t knot = aspect_units >> 27;
  const float t = static_cast<float>(aspect_units & 0x07FFFFFFu) * 0x1p-27f;
  const float s = t * t * (3.0f - 2.0f * t);
  const float a = unit_of(mixed(key ^ knot)), b = unit_of(mixed(key ^ ((knot + 1) & 31u)));
  return 0.3f + 1.4f * (a + (b - a) * s);
}

Density density_of(std::uint64_t identity, std::uint32_t aspect_units) {
  Density density;
  const std::uint64_t zone_key = mixed(identity, kZoneSalt);
  const std::uint64_t station_key = mixed(identity, kStationSalt);
  float sum = 0.0f;
  for (std::uint32_t zone = 0; zone < kZones; ++zone) {
    const float slow = wander(zone_key + (std::uint64_t{zone} << 8), aspect_units);
    for (std::uint32_t k = 0; k < kStations / kZones; ++k) {
      const std::uint32_t station = zone * (kStations / kZones) + k;
      // The house stands over -0.35 to -0.2 of the length.
      const float house = station >= 10 && station < 19 ? 3.0f : 1.0f;
      density[station] = slow * house * (0.4f + 1.2f * unit_of(mixed(station_key + station)));
      sum += density[station];
    }
  }
  for (float& d : density) d /= sum;
  return density;
}

// The rails run together over the foremost quarter.
float half_breadth(float forward) { return 1.0f - std::max(0.0f, 4.0f * forward - 1.0f); }

}  // namespace

double ship_cross_section(double length_m, double beam_m, double frequency_hz) {
  const double tonnes = 1.025 * 0.7 * length_m * beam_m * (0.4 * beam_m);
  const double kilotonnes = tonnes * 1e-3;
  return 52.0 * std::sqrt(frequency_hz * 1e-6) * kilotonnes * std::sqrt(kilotonnes);
}

double ship_mean_cross_section(const Hull& hull, double frequency_hz, double side) {
  const double median = hull.cross_section_m2 > 0.0
                            ? hull.cross_section_m2 * std::sqrt(frequency_hz / kGivenAt)
                            : ship_cross_section(hull.length_m, hull.beam_m, frequency_hz);
  const double by_ship = as_unit(mixed(hull.identity, kPeakSalt));
  const double peak = 10.0 + 90.0 * by_ship * by_ship;
  const double lobe2 = side * side, lobe4 = lobe2 * lobe2, lobe8 = lobe4 * lobe4;
  const double lobe32 = lobe8 * lobe8 * lobe8 * lobe8;
  return median / std::numbers::ln2 * (1.0 + (peak - 1.0) * lobe32);
}

ShipDetail ship_detail(const Hull& hull, double side, double ahead, ShipResolution resolution,
                       double per_resolution) {
  const double in_range = hull.length_m * ahead + hull.beam_m * side;
  const double across = hull.length_m * side + hull.beam_m * ahead;
  const double need =
      per_resolution * std::max(in_range / resolution.range_m, across / resolution.across_m);
  ShipDetail detail;
  detail.along = hull.length_m < 20.0 ? 2 : 4;
  while (detail.along < need && detail.along < kMaxAlong) detail.along *= 2;
  const bool broad = per_resolution * hull.beam_m *
                         std::max(side / resolution.range_m, ahead / resolution.across_m) >
                     1.0;
  detail.rows = broad ? kMaxRows : 1;
  return detail;
}

void ship_shares(std::uint64_t identity, ShipDetail detail, std::uint32_t aspect_units,
                 std::vector<ShipScatterer>& out) {
  const Density density = density_of(identity, aspect_units);
  out.clear();
  for (std::uint32_t i = 0; i < detail.along; ++i) {
    float share = 0.0f, moment = 0.0f;
    if (detail.along <= kStations) {
      const std::uint32_t group = kStations / detail.along;
      for (std::uint32_t s = i * group; s < (i + 1) * group; ++s) {
        share += density[s];
        moment += density[s] * ((static_cast<float>(s) + 0.5f) / kStations - 0.5f);
      }
    } else {
      const std::uint32_t station =
          static_cast<std::uint32_t>(std::uint64_t{i} * kStations / detail.along);
      share = density[station] * kStations / static_cast<float>(detail.along);
      moment = share * ((static_cast<float>(i) + 0.5f) / static_cast<float>(detail.along) - 0.5f);
    }
    const float forward = moment / share;
    const float breadth = half_breadth(forward);
    for (std::uint32_t j = 0; j < detail.rows; ++j) {
      const float row = (static_cast<float>(j) + 0.5f) / static_cast<float>(detail.rows) - 0.5f;
      out.push_back({forward, row * breadth, share / static_cast<float>(detail.rows), 0.0f});
    }
  }
}

void fluctuate(std::uint64_t identity, std::uint64_t pass_key, std::vector<ShipScatterer>& figure) {
  const std::uint64_t key = mixed(identity ^ kPassSalt, pass_key);
  for (std::size_t i = 0; i < figure.size(); ++i) {
    const std::uint64_t hash = mixed(key + i);
    figure[i].share *= exponential_of(hash);
    figure[i].phase = static_cast<float>(hash & 1023u) * 0x1p-10f;
  }
}

}  // namespace skerry::echo
