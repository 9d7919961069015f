#include "server/app/con_message.hpp"

#include <cmath>
#include <string>

#include "protocol/quantity/angle.hpp"
#include "server/world/ship_units.hpp"

namespace skerry::server {

void tell_con(const ShipState& ship, const ShipPlace& place, wire::ConState& message) {
  constexpr double kKnots = 1.0 / knots_in_mps(1.0);
  const ConState& con = *ship.con;
  const ShipClass& type = *con.ship_class;
  message.set_ship_class(std::string(type.key));
  message.set_steering(static_cast<wire::Steering>(con.steering));
  message.set_rudder_deg(con.rudder_deg);
  message.set_rudder_order_deg(con.rudder_order_deg);
  message.set_engine_percent(con.engine_percent);
  message.set_keeps_speed(con.keeps_speed);
  message.set_shaft_rpm(60.0 * con.shaft_rps);
  message.set_bow_thruster_percent(con.bow_percent);
  message.set_stern_thruster_percent(con.stern_percent);
  message.set_heading_order_deg(con.heading_order_deg);
  message.set_water_ahead_kn(con.motion.u * kKnots);
  message.set_water_starboard_kn(con.motion.v * kKnots);
  const double drift = (place.course_over_ground_deg - place.heading_deg) * kRadiansPerDegree;
  message.set_ground_ahead_kn(ship.speed_mps * std::cos(drift) * kKnots);
  message.set_ground_starboard_kn(ship.speed_mps * std::sin(drift) * kKnots);
  message.set_roll_deg(con.motion.roll * kDegreesPerRadian);
  message.set_depth_below_keel_m(con.depth_below_keel_m);
  message.set_draught_m(type.hull->draught_m());
  message.set_wind_from_deg(con.wind_from_deg);
  message.set_wind_kn(con.wind_mps * kKnots);
  message.set_current_set_deg(con.current_set_deg);
  message.set_current_kn(con.current_mps * kKnots);
  message.set_turn_rate_deg_min(con.turn_rate_deg_min);
  message.set_has_bow_thruster(type.bow.force_n > 0.0);
  message.set_has_stern_thruster(type.stern.force_n > 0.0);
  message.set_full_ahead_rpm(60.0 * type.ahead_rps);
  message.set_full_astern_rpm(60.0 * type.astern_rps);
  message.set_service_speed_kn(type.service_speed_mps * kKnots);
  message.set_rudder_limit_deg(type.gear.limit_deg);
  message.set_waypoint(con.waypoint);
  message.set_waypoints(con.waypoints);
  message.set_waypoint_m(con.waypoint_m);
  message.set_cross_track_m(con.cross_track_m);
}

}  // namespace skerry::server
