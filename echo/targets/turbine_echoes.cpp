#include "echo/targets/turbine_echoes.hpp"

#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/scene/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kNacelle = 500.0, kBlade = 150.0, kFlash = 20.0;
constexpr int kBlades = 3, kPerBlade = 5;
static_assert(kTurbineParts == 2 + kBlades * kPerBlade);

float phase_of(std::uint64_t hash) { return static_cast<float>(hash & 1023u) * 0x1p-10f; }

}  // namespace

void turbine_parts(const WindTurbine& turbine, PlanePoint own_ship, double seconds,
                   std::uint64_t pass_key, std::vector<EchoPart>& out) {
  out.clear();
  const std::uint64_t key = mixed(turbine.identity, pass_key);
  out.push_back(
      {turbine.place, turbine.hub_height_m, kTowerSection, true, phase_of(mixed(key, 100))});
  const SinCos facing = sin_cos_degrees(turbine.facing_deg);
  const PlanePoint hub = turbine.place + PlanePoint{facing.sin, facing.cos} * 3.0;
  out.push_back({hub, turbine.hub_height_m, kNacelle, false, phase_of(mixed(key, 101))});

  const PlanePoint across{facing.cos, -facing.sin};
  const PlanePoint sight = turbine.place - own_ship;
  const double range = length_of(sight);
  const double across_sight = range > 0.0 ? dot(across, sight) / range : 0.0;
  // Whole turns fall away before the angle grows too large for its sine.
  const double turns = turbine.rotor_rpm / 60.0 * seconds + as_unit(mixed(turbine.identity, 0x407));
  const double begun = 360.0 * (turns - std::floor(turns));
  for (int blade = 0; blade < kBlades; ++blade) {
    const SinCos at = sin_cos_degrees(begun + 120.0 * blade);  // from the zenith
    const double along = at.sin * across_sight;  // cosine between blade and line of sight
    const double square2 = 1.0 - along * along;
    const double square8 = square2 * square2 * square2 * square2;
    const double square32 = square8 * square8 * square8 * square8;
    const double lobe = square32 * square32 * square32 * square32;
    const double section = kBlade / kPerBlade * (1.0 + (kFlash - 1.0) * lobe);
    for (int k = 0; k < kPerBlade; ++k) {
      const double out_to = 0.5 * turbine.rotor_diameter_m * (k + 0.5) / kPerBlade;
      out.push_back({hub + across * (out_to * at.sin), turbine.hub_height_m + out_to * at.cos,
                     section, false,
                     phase_of(mixed(key, static_cast<std::uint64_t>(blade * kPerBlade + k)))});
    }
  }
}

}  // namespace skerry::echo
