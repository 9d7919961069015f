#include "server/navigation/own_ship_sentences.hpp"

#include <cmath>
#include <optional>

#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "protocol/wire/own_ship_place.hpp"

namespace skerry::server {
namespace {

constexpr unsigned kQualityNone = 0, kQualityGps = 1, kQualitySimulated = 8;

UtcTime utc_of(const wire::OwnShip& ship) {
  return UtcTime(Duration(static_cast<std::int64_t>(ship.utc_ns())));
}

std::optional<double> known(double value, bool is_known) {
  return is_known ? std::optional(value) : std::nullopt;
}

// Over ground it needs a heading too.
nmea::Vbw log_of(const wire::OwnShip& ship) {
  nmea::Vbw log;
  if (wire::knows_log(ship)) {
    log.water_ahead_kn = ship.has_con() ? ship.con().water_ahead_kn() : ship.speed_kn();
    log.water_starboard_kn = ship.has_con() ? ship.con().water_starboard_kn() : 0.0;
  }
  if (ship.no_motion() || ship.no_heading()) return log;
  const double drift = degrees(ship.course_over_ground_deg() - ship.heading_deg()).in_radians();
  log.ground_ahead_kn =
      ship.has_con() ? ship.con().ground_ahead_kn() : ship.speed_over_ground_kn() * std::cos(drift);
  log.ground_starboard_kn = ship.has_con() ? ship.con().ground_starboard_kn()
                                           : ship.speed_over_ground_kn() * std::sin(drift);
  return log;
}

}  // namespace

std::string own_ship_sentence(NavigationSentence sentence, const wire::OwnShip& ship,
                              const wire::Settings& settings, bool says_simulated) {
  const UtcTime utc = utc_of(ship);
  const std::optional<GeoPoint> position = wire::place_known_of(ship);
  const auto heading_deg = known(ship.heading_deg(), !ship.no_heading());
  const auto course_deg = known(ship.course_over_ground_deg(), !ship.no_motion());
  const auto speed_kn = known(ship.speed_over_ground_kn(), !ship.no_motion());
  const char mode = says_simulated ? 'S' : 'A';
  switch (sentence) {
    case NavigationSentence::rmc:
      return encode(nmea::Rmc{.utc = utc,
                              .position = position,
                              .speed_kn = speed_kn,
                              .course_deg = course_deg,
                              .mode = position ? mode : 'N'});
    case NavigationSentence::gga:
      return encode(nmea::Gga{.time_of_day = nmea::time_of_day(utc),
                              .position = position,
                              .quality = !position        ? kQualityNone
                                         : says_simulated ? kQualitySimulated
                                                          : kQualityGps,
                              .satellites = position ? nmea::Gga{}.satellites : 0});
    case NavigationSentence::vtg:
      return encode(
          nmea::Vtg{.course_deg = course_deg, .speed_kn = speed_kn, .mode = speed_kn ? mode : 'N'});
    case NavigationSentence::zda:
      return encode(nmea::Zda{.utc = utc});
    case NavigationSentence::hdt:
      return encode(nmea::Hdt{.heading_deg = heading_deg});
    case NavigationSentence::ths:
      return encode(nmea::Ths{.heading_deg = heading_deg, .mode = heading_deg ? mode : 'V'});
    case NavigationSentence::rot:
      return encode(
          nmea::Rot{.rate_deg_min = known(ship.rate_of_turn_deg_min(), wire::knows_turn(ship)),
                    .valid = wire::knows_turn(ship)});
    case NavigationSentence::vhw:
      return encode(nmea::Vhw{.heading_deg = heading_deg,
                              .speed_kn = known(ship.speed_kn(), wire::knows_log(ship))});
    case NavigationSentence::vbw:
      return encode(log_of(ship));
    case NavigationSentence::rsd:
      return encode(nmea::Rsd{.range_nm = settings.range_nm()});
    default:  // osd
      return encode(nmea::Osd{.heading_deg = heading_deg,
                              .heading_valid = heading_deg.has_value(),
                              .course_deg = course_deg,
                              .speed_kn = speed_kn});
  }
}

}  // namespace skerry::server
