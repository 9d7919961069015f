#include "server/world/environment.hpp"

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
