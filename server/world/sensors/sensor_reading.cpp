#include "server/world/sensors/sensor_reading.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "protocol/quantity/speed.hpp"

namespace skerry::server {
namespace {

constexpr Duration kNoiseStep = std::chrono::milliseconds(100);
constexpr double kMetresPerDegreeOfArc = 60.0 * 1852.0;
constexpr double kLeastParallel = 0.01;

enum class NoiseOf : std::uint64_t { gyro = 1, log, gnss_north, gnss_east };

// Of unit deviation, within 6.
double noise_at(std::uint64_t seed, NoiseOf sensor, Duration now) {
  const std::int64_t step = now.count() / kNoiseStep.count();
  const std::uint64_t key =
      echo::mixed(seed, static_cast<std::uint64_t>(sensor), static_cast<std::uint64_t>(step));
  double sum = -6.0;
  for (std::uint64_t i = 0; i < 12; ++i) sum += echo::as_unit(echo::mixed(key, i));
  return sum;
}

double seconds_since(Duration since, Duration now) {
  return now > since ? in_seconds(now - since) : 0.0;
}

}  // namespace

SensorReading reading_of(const FaultState* state, Duration now, std::uint64_t seed) {
  SensorReading reading;
  if (state == nullptr) return reading;
  const wire::Faults& faults = state->faults;
  reading.no_heading = faults.gyro_lost() || faults.blackout();
  reading.no_position = faults.gnss_lost() || faults.blackout();
  reading.no_log = faults.log_lost() || faults.blackout();
  reading.no_wind = faults.wind_lost() || faults.blackout();
  reading.no_ais = faults.ais_lost() || faults.blackout();
  if (!reading.no_heading) {
    const double drift_min = seconds_since(state->gyro_drifts_since, now) / 60.0;
    double error = faults.gyro_bias_deg() + faults.gyro_drift_deg_min() * drift_min;
    if (faults.gyro_noise_deg() != 0.0) {
      error += faults.gyro_noise_deg() * noise_at(seed, NoiseOf::gyro, now);
    }
    reading.heading_deg = std::remainder(error, 360.0);
    if (reading.heading_deg == -180.0) reading.heading_deg = 180.0;
    reading.rate_of_turn_deg_min = faults.gyro_drift_deg_min();
  }
  if (!reading.no_log) {
    reading.log_kn = faults.log_bias_kn();
    if (faults.log_noise_kn() != 0.0) {
      reading.log_kn += faults.log_noise_kn() * noise_at(seed, NoiseOf::log, now);
    }
  }
  if (!reading.no_position) {
    const echo::SinCos whither = echo::sin_cos_degrees(faults.gnss_drift_deg());
    const double drift_mps = faults.gnss_drift_kn() * kKnot;
    const double run_m = drift_mps * seconds_since(state->gnss_drifts_since, now);
    const auto off = [&](double jump_m, double way, NoiseOf axis) {
      double error = jump_m + run_m * way;
      if (faults.gnss_noise_m() != 0.0) error += faults.gnss_noise_m() * noise_at(seed, axis, now);
      return std::clamp(error, -kFarthestOffM, kFarthestOffM);
    };
    reading.north_m = off(faults.gnss_north_m(), whither.cos, NoiseOf::gnss_north);
    reading.east_m = off(faults.gnss_east_m(), whither.sin, NoiseOf::gnss_east);
    const bool runs = run_m < kFarthestOffM;
    reading.drift_north_mps = runs ? drift_mps * whither.cos : 0.0;
    reading.drift_east_mps = runs ? drift_mps * whither.sin : 0.0;
  }
  if (!reading.no_wind) {
    reading.wind_kn = faults.wind_speed_bias_kn();
    reading.wind_deg = faults.wind_bias_deg();
  }
  return reading;
}

GeoPoint moved_by(GeoPoint position, const SensorReading& reading) {
  if (!reading.moves_position()) return position;
  const double parallel =
      std::max(kLeastParallel, echo::sin_cos_degrees(position.latitude_deg).cos);
  const double latitude = position.latitude_deg + reading.north_m / kMetresPerDegreeOfArc;
  return {std::clamp(latitude, -90.0, 90.0),
          wrapped_longitude(position.longitude_deg +
                            reading.east_m / (kMetresPerDegreeOfArc * parallel))};
}

}  // namespace skerry::server
