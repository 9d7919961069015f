#include "server/navigation/ship_sensors.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <random>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::server {
namespace {

constexpr std::uint64_t kTickNs = 100'000'000;
constexpr double kMetresPerDegree = 60.0 * 1852.0;
constexpr double kLongYaw_s = 11.0, kShortYaw_s = 7.0, kWander_s = 23.0;

// Errors of one tenth of a second: sums of twelve equal shares are nearly normal, and the same on
// every machine.
class Noise {
 public:
  explicit Noise(const wire::OwnShip& ship)
      : random_(ship.utc_ns() / kTickNs * 1'000'003u + ship.mmsi() + ship.name().size()) {}

  double next(double deviation) {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += static_cast<double>(random_() >> 11) * 0x1p-53;
    return sum * deviation;
  }

 private:
  std::mt19937_64 random_;
};

}  // namespace

wire::OwnShip sensed(const wire::OwnShip& ship, const SensorErrors& errors) {
  if (ship.driven() || errors == SensorErrors::none()) return ship;
  wire::OwnShip told = ship;
  Noise noise(ship);
  // A day is enough for a phase.
  const double now_s = static_cast<double>(ship.utc_ns() / 1000 % 86'400'000'000ull) / 1e6;
  const auto wave = [&](double period_s) { return std::sin(kRadiansPerTurn * now_s / period_s); };
  if (!ship.no_heading()) {
    const double yaw = errors.yaw_deg * (0.6 * wave(kLongYaw_s) + 0.4 * wave(kShortYaw_s));
    told.set_heading_deg(
        wrapped_degrees(ship.heading_deg() + yaw + noise.next(errors.heading_deg)));
  }
  if (!ship.no_motion()) {
    const double off = errors.course_deg * wave(kWander_s) + noise.next(0.3 * errors.course_deg);
    told.set_course_over_ground_deg(wrapped_degrees(ship.course_over_ground_deg() + off));
    told.set_speed_over_ground_kn(
        std::max(0.0, ship.speed_over_ground_kn() + noise.next(errors.speed_kn)));
  }
  if (!ship.no_position()) {
    const double parallel = std::max(0.01, std::cos(degrees(ship.latitude_deg()).in_radians()));
    const double north_m = noise.next(errors.position_m), east_m = noise.next(errors.position_m);
    told.set_latitude_deg(
        std::clamp(ship.latitude_deg() + north_m / kMetresPerDegree, -90.0, 90.0));
    told.set_longitude_deg(
        wrapped_longitude(ship.longitude_deg() + east_m / (kMetresPerDegree * parallel)));
  }
  return told;
}

}  // namespace skerry::server
