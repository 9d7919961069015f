#include "server/navigation/ais_reports.hpp"

#include <chrono>
#include <cmath>

#include "protocol/quantity/speed.hpp"
#include "protocol/wire/own_ship_place.hpp"

namespace skerry::server {
namespace {

using namespace std::chrono_literals;

constexpr double kStillKn = 0.1;
constexpr unsigned kUnderWay = 0, kAnchored = 1;

unsigned second_of(UtcTime utc) {
  return static_cast<unsigned>(
      std::chrono::duration_cast<std::chrono::seconds>(utc.time_since_epoch()).count() % 60);
}

}  // namespace

std::optional<nmea::AisMessage> position_report(const TrafficItem& item, UtcTime utc) {
  if (item.mmsi == 0 || item.kind == TrafficKind::other) return std::nullopt;
  if (item.kind == TrafficKind::aid_to_navigation) {
    return nmea::AisAid{.mmsi = item.mmsi,
                        .type = item.aid_type,
                        .name = item.name,
                        .position = item.position,
                        .size = nmea::ais_size(item.length_m, item.beam_m),
                        .utc_second = second_of(utc)};
  }
  const AisSaid said = said_by_ais(item);
  if (said.silent) return std::nullopt;
  nmea::AisPosition report{.mmsi = item.mmsi,
                           .class_b = item.kind == TrafficKind::boat,
                           .rate_of_turn_deg_min = said.rate_of_turn_deg_min,
                           .position = said.position,
                           .course_deg = said.course_over_ground_deg,
                           .heading_deg = said.heading_deg,
                           .utc_second = second_of(utc)};
  if (!said.speed_mps) return report;
  report.speed_kn = *said.speed_mps / kKnot;
  report.status = *report.speed_kn < kStillKn ? kAnchored : kUnderWay;
  return report;
}

std::vector<nmea::AisMessage> static_reports(const TrafficItem& item) {
  const nmea::AisSize size = nmea::ais_size(item.length_m, item.beam_m);
  if (item.mmsi == 0 || (item.ais && item.ais->silent)) return {};
  if (item.kind == TrafficKind::ship) {
    return {nmea::AisVoyage{
        .mmsi = item.mmsi, .name = item.name, .ship_type = item.ship_type, .size = size}};
  }
  if (item.kind == TrafficKind::boat) {
    return {nmea::AisStatic{.mmsi = item.mmsi, .part_b = false, .name = item.name},
            nmea::AisStatic{
                .mmsi = item.mmsi, .part_b = true, .ship_type = item.ship_type, .size = size}};
  }
  return {};
}

nmea::AisMessage own_position_report(const wire::OwnShip& ship, std::uint32_t mmsi) {
  const UtcTime utc{Duration(static_cast<std::int64_t>(ship.utc_ns()))};
  nmea::AisPosition report{
      .mmsi = mmsi, .position = wire::place_known_of(ship), .utc_second = second_of(utc)};
  if (!ship.no_heading()) report.heading_deg = ship.heading_deg();
  if (wire::knows_turn(ship)) report.rate_of_turn_deg_min = ship.rate_of_turn_deg_min();
  if (ship.no_motion()) return report;
  report.status = ship.speed_over_ground_kn() < kStillKn ? kAnchored : kUnderWay;
  report.speed_kn = ship.speed_over_ground_kn();
  report.course_deg = ship.course_over_ground_deg();
  return report;
}

nmea::AisMessage own_static_report(const wire::OwnShip& ship, std::uint32_t mmsi) {
  return nmea::AisVoyage{
      .mmsi = mmsi, .name = ship.name(), .size = nmea::ais_size(ship.length_m(), ship.beam_m())};
}

Duration position_interval(TrafficKind kind, double speed_mps, double rate_of_turn_deg_min) {
  const double knots = speed_mps / kKnot;
  const bool turns = std::abs(rate_of_turn_deg_min) > 20.0;
  if (kind == TrafficKind::boat) return knots <= 2.0 ? Duration(3min) : Duration(30s);
  if (kind != TrafficKind::ship || knots < kStillKn) return 3min;
  if (knots > 23.0) return 2s;
  if (knots > 14.0) return turns ? 2s : 6s;
  return turns ? Duration(10s) / 3 : Duration(10s);
}

}  // namespace skerry::server
