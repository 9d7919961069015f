#include "server/world/world_change.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

#include "protocol/quantity/angle.hpp"
#include "server/world/artefact_switches.hpp"
#include "server/world/rhumb_step.hpp"
#include "server/world/scenario.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {
namespace {

constexpr double kNewRadiusNm = 2.0, kNewRateMmH = 4.0;  // as in scenario.proto

wire::Reply refused(wire::Reply::Code code, std::string text) {
  wire::Reply reply;
  reply.set_code(code);
  reply.set_text(std::move(text));
  return reply;
}

std::optional<wire::Reply> remove_rain(const wire::WorldChange& change, Environment& environment) {
  if (change.remove_all_rain()) environment.rain.clear();
  for (const std::uint32_t id : change.remove_rain()) {
    if (std::erase_if(environment.rain, [&](const RainCloud& c) { return c.id == id; }) == 0) {
      return refused(wire::Reply::UNKNOWN,
                     fmt::format("remove rain: there is no rain cell {}", id));
    }
  }
  return std::nullopt;
}

std::optional<wire::Reply> change_rain(const wire::RainChange& change, Duration now,
                                       Environment& environment) {
  if (change.has_latitude_deg() != change.has_longitude_deg()) {
    return refused(wire::Reply::OUT_OF_RANGE,
                   "rain: a position is latitude and longitude; one of them is missing");
  }
  auto cloud = std::find_if(environment.rain.begin(), environment.rain.end(),
                            [&](const RainCloud& c) { return c.id == change.id(); });
  if (change.id() == 0) {
    if (!change.has_latitude_deg()) {
      return refused(wire::Reply::OUT_OF_RANGE, "rain: a new rain cell needs a position");
    }
    if (environment.rain.size() >= kMaxRainCells) {
      return refused(wire::Reply::OUT_OF_RANGE,
                     fmt::format("rain: there are {} rain cells; allowed: at most {}",
                                 environment.rain.size(), kMaxRainCells));
    }
    RainCloud fresh;
    fresh.id = environment.next_rain_id++;
    fresh.radius_m = nautical_miles(kNewRadiusNm).in_metres();
    fresh.rate_mm_h = kNewRateMmH;
    cloud = environment.rain.insert(environment.rain.end(), fresh);
  } else if (cloud == environment.rain.end()) {
    return refused(wire::Reply::UNKNOWN,
                   fmt::format("rain: there is no rain cell {}", change.id()));
  }
  cloud->from = change.has_latitude_deg()
                    ? GeoPoint{change.latitude_deg(), wrapped_longitude(change.longitude_deg())}
                    : place_of(*cloud, now);
  cloud->since = now;
  if (change.has_radius_nm()) cloud->radius_m = nautical_miles(change.radius_nm()).in_metres();
  if (change.has_rate_mm_h()) cloud->rate_mm_h = change.rate_mm_h();
  if (change.has_kind()) cloud->kind = rain_kind(change.kind());
  if (change.has_drift_deg()) cloud->course_deg = wrapped_degrees(change.drift_deg());
  if (change.has_drift_kn()) cloud->speed_mps = knots_in_mps(change.drift_kn());
  return std::nullopt;
}

}  // namespace

std::optional<wire::Reply> change_environment(const wire::WorldChange& change, Duration now,
                                              Environment& environment) {
  echo::SeaSurface& sea = environment.sea;
  if (change.has_sea_state()) sea.state = change.sea_state();
  if (change.has_wind_from_deg()) sea.wind_from_deg = wrapped_degrees(change.wind_from_deg());
  if (change.has_swell_height_m()) sea.swell.height_m = change.swell_height_m();
  if (change.has_swell_period_s()) sea.swell.period_s = change.swell_period_s();
  if (change.has_swell_from_deg()) sea.swell.from_deg = wrapped_degrees(change.swell_from_deg());
  if (change.has_wave_height_m()) environment.wave_height_m = change.wave_height_m();
  if (change.has_wind_kn()) environment.wind_kn = change.wind_kn();
  if (change.has_current_set_deg()) {
    environment.current_set_deg = wrapped_degrees(change.current_set_deg());
  }
  if (change.has_current_kn()) environment.current_kn = change.current_kn();
  if (change.has_depth_m()) environment.depth_m = change.depth_m();
  if (change.has_k_factor()) environment.atmosphere.k_factor = change.k_factor();
  if (change.has_visibility_nm()) environment.visibility_nm = change.visibility_nm();
  if (change.has_ducting()) environment.atmosphere.ducting = change.ducting();
  change_artefacts(change, environment.artefacts);
  if (auto wrong = remove_rain(change, environment)) return wrong;
  for (const wire::RainChange& rain : change.rain()) {
    if (auto wrong = change_rain(rain, now, environment)) return wrong;
  }
  return std::nullopt;
}

wire::World world_message(const Environment& environment, Duration now) {
  wire::World world;
  world.set_scenario_s(in_seconds(now));
  world.set_sea_state(environment.sea.state);
  world.set_wind_from_deg(environment.sea.wind_from_deg);
  world.set_swell_height_m(environment.sea.swell.height_m);
  world.set_swell_period_s(environment.sea.swell.period_s);
  world.set_swell_from_deg(environment.sea.swell.from_deg);
  world.set_wave_height_m(environment.wave_height_m);
  if (environment.wind_kn) world.set_wind_kn(*environment.wind_kn);
  world.set_current_set_deg(environment.current_set_deg);
  world.set_current_kn(environment.current_kn);
  world.set_depth_m(environment.depth_m);
  world.set_k_factor(environment.atmosphere.k_factor);
  world.set_ducting(environment.atmosphere.ducting);
  if (environment.visibility_nm < kClearVisibility_nm) {
    world.set_visibility_nm(environment.visibility_nm);
  }
  for (const RainCloud& cloud : environment.rain) {
    const GeoPoint centre = place_of(cloud, now);
    wire::RainCell& cell = *world.add_rain();
    cell.set_id(cloud.id);
    cell.set_latitude_deg(centre.latitude_deg);
    cell.set_longitude_deg(centre.longitude_deg);
    cell.set_radius_nm(metres(cloud.radius_m).in_nautical_miles());
    cell.set_rate_mm_h(cloud.rate_mm_h);
    cell.set_kind(static_cast<wire::RainKind>(cloud.kind));
    cell.set_drift_deg(cloud.course_deg);
    cell.set_drift_kn(cloud.speed_mps / knots_in_mps(1.0));
  }
  tell_artefacts(environment.artefacts, world);
  return world;
}

}  // namespace skerry::server
