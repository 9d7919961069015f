#include "echo/targets/wake_echoes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/scene/plane_geometry.hpp"
#include "echo/targets/fluctuation.hpp"
#include "echo/targets/reflectors.hpp"

namespace skerry::echo {
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
