#include "server/app/told_ship.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/app/con_message.hpp"

namespace skerry::server {
namespace {

// Kept by relays and messages (values_in_range.cpp).
constexpr double kMostSpeed_kn = 100.0, kMostWind_kn = 100.0, kMostCurrent_kn = 12.0;
constexpr double kMostTurn_deg_min = 1200.0;

// Knots towards north and east.
struct Way {
  double north = 0.0, east = 0.0;

  Way operator+(Way other) const { return {north + other.north, east + other.east}; }
  Way operator-(Way other) const { return {north - other.north, east - other.east}; }
  double length() const { return std::hypot(north, east); }
  double whither_deg() const {
    return wrapped_degrees(std::atan2(east, north) * kDegreesPerRadian);
  }
};

Way way_of(double towards_deg, double knots) {
  const double radians = towards_deg * kRadiansPerDegree;
  return {knots * std::cos(radians), knots * std::sin(radians)};
}
// Of a way ahead and to starboard.
Way way_of(double heading_deg, double ahead_kn, double starboard_kn) {
  return way_of(heading_deg, ahead_kn) + way_of(heading_deg + 90.0, starboard_kn);
}

void tell_truth(const ShipState& ship, const ShipPlace& place, wire::OwnShip& out) {
  const double speed_kn = ship.speed_mps / kKnot;
  out.set_name(ship.name);
  out.set_latitude_deg(place.position.latitude_deg);
  out.set_longitude_deg(place.position.longitude_deg);
  out.set_heading_deg(place.heading_deg);
  out.set_speed_kn(speed_kn);
  out.set_course_over_ground_deg(
      wrapped_degrees(place.course_over_ground_deg + (speed_kn < 0.0 ? 180.0 : 0.0)));
  out.set_speed_over_ground_kn(std::abs(speed_kn));
  out.set_length_m(ship.length_m);
  out.set_beam_m(ship.beam_m);
  out.set_mmsi(ship.mmsi);
  out.set_driven(ship.driven);
  out.set_rate_of_turn_deg_min(ship.rate_of_turn_deg_s * 60.0);
  out.set_ordered_course_deg(ship.ordered_course_deg);
  out.set_ordered_speed_kn(ship.ordered_speed_mps / kKnot);
  if (ship.con) {
    tell_con(ship, place, *out.mutable_con());
    out.set_speed_kn(out.con().water_ahead_kn());
  }
}

void tell_compass(const SensorReading& reading, wire::OwnShip& out) {
  out.set_no_heading(reading.no_heading);
  if (reading.no_heading) {
    out.set_heading_deg(0.0);
    out.set_rate_of_turn_deg_min(0.0);
    return;
  }
  out.set_heading_deg(wrapped_degrees(out.heading_deg() + reading.heading_deg));
  out.set_rate_of_turn_deg_min(std::clamp(out.rate_of_turn_deg_min() + reading.rate_of_turn_deg_min,
                                          -kMostTurn_deg_min, kMostTurn_deg_min));
}

void tell_receiver(const SensorReading& reading, wire::OwnShip& out) {
  out.set_no_position(reading.no_position);
  out.set_no_motion(reading.no_position);
  if (reading.no_position) {
    out.set_latitude_deg(0.0);
    out.set_longitude_deg(0.0);
    out.set_course_over_ground_deg(0.0);
    out.set_speed_over_ground_kn(0.0);
    return;
  }
  const GeoPoint position = moved_by({out.latitude_deg(), out.longitude_deg()}, reading);
  out.set_latitude_deg(position.latitude_deg);
  out.set_longitude_deg(position.longitude_deg);
  const Way drift{reading.drift_north_mps / kKnot, reading.drift_east_mps / kKnot};
  if (drift.length() == 0.0) return;
  const Way way = way_of(out.course_over_ground_deg(), out.speed_over_ground_kn()) + drift;
  out.set_course_over_ground_deg(way.whither_deg());
  out.set_speed_over_ground_kn(std::min(way.length(), kMostSpeed_kn));
}

void tell_log(const SensorReading& reading, wire::OwnShip& out) {
  out.set_no_log(reading.no_log);
  const double speed =
      reading.no_log ? 0.0
                     : std::clamp(out.speed_kn() + reading.log_kn, -kMostSpeed_kn, kMostSpeed_kn);
  out.set_speed_kn(speed);
  if (!out.has_con()) return;
  out.mutable_con()->set_water_ahead_kn(speed);
  if (reading.no_log) out.mutable_con()->set_water_starboard_kn(0.0);
}

// Of `truth`, whose con is there.
void tell_ground_and_wind(const wire::OwnShip& truth, const SensorReading& reading,
                          wire::OwnShip& out) {
  wire::ConState& con = *out.mutable_con();
  const bool resolves = !out.no_motion() && !out.no_heading();
  const Way ground = way_of(out.course_over_ground_deg(), out.speed_over_ground_kn());
  const double drift = (out.course_over_ground_deg() - out.heading_deg()) * kRadiansPerDegree;
  con.set_ground_ahead_kn(resolves ? out.speed_over_ground_kn() * std::cos(drift) : 0.0);
  con.set_ground_starboard_kn(resolves ? out.speed_over_ground_kn() * std::sin(drift) : 0.0);

  out.set_no_wind(reading.no_wind);
  if (reading.no_wind) {
    con.set_wind_from_deg(0.0);
    con.set_wind_kn(0.0);
  } else {
    // As felt: whence it comes off the bow, and how fast.
    const Way felt = way_of(truth.con().wind_from_deg(), truth.con().wind_kn()) +
                     way_of(truth.heading_deg(), truth.con().ground_ahead_kn(),
                            truth.con().ground_starboard_kn());
    const double said_kn = std::max(0.0, felt.length() + reading.wind_kn);
    const double off_bow = felt.whither_deg() - truth.heading_deg() + reading.wind_deg;
    const Way said =
        resolves ? way_of(out.heading_deg() + off_bow, said_kn) - ground : way_of(off_bow, said_kn);
    con.set_wind_from_deg(said.whither_deg());
    con.set_wind_kn(std::min(said.length(), kMostWind_kn));
  }
  const Way current =
      ground - way_of(out.heading_deg(), con.water_ahead_kn(), con.water_starboard_kn());
  const bool known = resolves && !out.no_log();
  con.set_current_set_deg(known ? current.whither_deg() : 0.0);
  con.set_current_kn(known ? std::min(current.length(), kMostCurrent_kn) : 0.0);
}

}  // namespace

wire::OwnShip told_ship(const ShipState& ship, const ShipPlace& place,
                        const SensorReading& reading) {
  wire::OwnShip out;
  tell_truth(ship, place, out);
  if (reading == SensorReading{}) return out;
  const wire::OwnShip truth = out;
  tell_compass(reading, out);
  tell_receiver(reading, out);
  tell_log(reading, out);
  out.set_no_wind(reading.no_wind);
  out.set_no_ais(reading.no_ais);
  if (ship.con) tell_ground_and_wind(truth, reading, out);
  return out;
}

}  // namespace skerry::server
