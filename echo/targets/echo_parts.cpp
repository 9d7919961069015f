#include "echo/targets/echo_parts.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/targets/fluctuation.hpp"
#include "protocol/quantity/plane_geometry.hpp"

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

namespace {

constexpr double kLeastSpeed = 1.0, kSeconds = 60.0, kLongest = 800.0, kLifetime = 20.0;
constexpr double kReflectivity = 5e-4;  // -33 dB
constexpr double kHeight = 0.3;         // of the rough water
constexpr std::uint64_t kWakeSalt = 0x3A4E;
constexpr double kWireRadius = 0.015;
constexpr int kWires = 3;

}  // namespace

void wake_parts(const Hull& hull, double dt, std::uint64_t pass_key, std::vector<EchoPart>& out) {
  out.clear();
  const double speed = length_of(hull.velocity);
  if (!hull.wake || speed < kLeastSpeed) return;
  const double length = std::min(kLongest, kSeconds * speed);
  const double step = length / kWakeParts;
  const std::uint64_t key = mixed(hull.identity ^ kWakeSalt, pass_key);
  const SinCos bow = sin_cos_degrees(hull.heading_deg + hull.turn_rate_deg_s * dt);
  PlanePoint place =
      hull.centre + hull.velocity * dt - PlanePoint{bow.sin, bow.cos} * (0.5 * hull.length_m);
  for (std::size_t k = 0; k < kWakeParts; ++k) {
    // She came from there with the heading of then.
    const double age = step * (static_cast<double>(k) + 0.5) / speed;
    const SinCos turn = sin_cos_degrees(-hull.turn_rate_deg_s * (age - dt));
    const PlanePoint way = turned(hull.velocity, turn);
    const PlanePoint half = way * (0.5 * step / speed);
    place = place - half;
    const std::uint64_t hash = mixed(key + k);
    const double mean =
        kReflectivity * hull.beam_m * step * exact_exp2(-age / kLifetime * std::numbers::log2e);
    out.push_back({place, kHeight, mean * static_cast<double>(exponential_of(hash)), false,
                   static_cast<float>(hash & 1023u) * 0x1p-10f});
    place = place - half;
  }
}

double wire_cross_section(double radius_m, double range_m) {
  return std::numbers::pi * radius_m * range_m;
}

std::optional<EchoPart> cable_part(const OverheadCable& cable, PlanePoint own_ship) {
  const PlanePoint along = cable.to - cable.from, way = own_ship - cable.from;
  const double length2 = dot(along, along);
  if (!(length2 > 1.0)) return std::nullopt;
  const double t = dot(way, along) / length2;
  if (t < 0.0 || t > 1.0) return std::nullopt;
  const PlanePoint foot = cable.from + along * t;
  const double range = std::max(1.0, length_of(foot - own_ship));
  return EchoPart{foot, cable.height_m, kWires * wire_cross_section(kWireRadius, range), false,
                  0.0f};
}

}  // namespace skerry::echo
