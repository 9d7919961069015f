#include "server/world/environment.hpp"

#include <cmath>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"
#include "server/world/artefact_switches.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {

Environment environment_of(const scenario::Scenario& scenario) {
  Environment environment;
  environment.atmosphere = {scenario.atmosphere().k_factor(), scenario.atmosphere().ducting()};
  const scenario::Sea& sea = scenario.sea();
  environment.sea.state = sea.state();
  environment.sea.wind_from_deg = wrapped_degrees(sea.wind_from_deg());
  environment.sea.swell = {sea.swell().height_m(), sea.swell().period_s(),
                           wrapped_degrees(sea.swell().from_deg())};
  environment.wave_height_m = sea.wave_height_m();
  if (sea.has_wind_kn()) environment.wind_kn = sea.wind_kn();
  environment.current_set_deg = wrapped_degrees(sea.current_set_deg());
  environment.current_kn = sea.current_kn();
  environment.depth_m = sea.depth_m();
  environment.visibility_nm = scenario.atmosphere().visibility_nm();
  environment.waters = std::make_shared<const Waters>(scenario);
  if (!scenario.banks().empty()) environment.banks = std::make_shared<const Banks>(scenario);
  for (const scenario::RainCell& cell : scenario.rain()) {
    RainCloud cloud;
    cloud.id = environment.next_rain_id++;
    cloud.from = geo_point(cell.position());
    cloud.course_deg = wrapped_degrees(cell.drift_deg());
    cloud.speed_mps = knots_in_mps(cell.drift_kn());
    cloud.radius_m = nautical_miles(cell.radius_nm()).in_metres();
    cloud.rate_mm_h = cell.rate_mm_h();
    cloud.kind = rain_kind(cell.kind());
    environment.rain.push_back(cloud);
  }
  change_artefacts(scenario.artefacts(), environment.artefacts);
  return environment;
}

CurrentHere current_at(const Environment& environment, GeoPoint at, Duration time) {
  const double mps = knots_in_mps(environment.current_kn);
  if (!environment.waters->has_streams()) return {environment.current_set_deg, mps};
  const Stream stream = environment.waters->stream(at, time);
  const echo::SinCos set = echo::sin_cos_degrees(environment.current_set_deg);
  const double north = stream.north_mps + mps * set.cos, east = stream.east_mps + mps * set.sin;
  return {wrapped_degrees(echo::exact_atan2(east, north) * kDegreesPerRadian),
          std::sqrt(north * north + east * east)};
}

echo::RainKind rain_kind(wire::RainKind kind) {
  static_assert(static_cast<int>(echo::RainKind::cell) == wire::RAIN_CELL);
  static_assert(static_cast<int>(echo::RainKind::even) == wire::RAIN_EVEN);
  static_assert(static_cast<int>(echo::RainKind::shower) == wire::RAIN_SHOWER);
  static_assert(static_cast<int>(echo::RainKind::squall_line) == wire::RAIN_SQUALL_LINE);
  return static_cast<echo::RainKind>(kind);
}

GeoPoint place_of(const RainCloud& cloud, Duration time) {
  return advanced(cloud.from, cloud.course_deg, cloud.speed_mps * in_seconds(time - cloud.since))
      .position;
}

}  // namespace skerry::server
