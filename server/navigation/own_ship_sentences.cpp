#include "server/navigation/own_ship_sentences.hpp"

#include <cmath>
#include <optional>

#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/radar_sentences.hpp"
#include "protocol/nmea/tracked_target_data.hpp"
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

nmea::TargetStatus status_of(const Track& track) {
  return track.lost ? nmea::TargetStatus::lost : nmea::TargetStatus::tracking;
}

std::string ttm_of(const Track& track, const wire::OwnShip& ship) {
  const Approach approach =
      approach_of(track.place, {track.target.course_over_ground_deg, track.target.speed_mps},
                  {ship.course_over_ground_deg(), ship.speed_over_ground_kn() * kKnot});
  return encode(nmea::Ttm{.number = track.number,
                          .range_nm = track.place.range_m / Length::kMetresPerNauticalMile,
                          .bearing_deg = track.place.bearing_deg,
                          .speed_kn = track.target.speed_mps / kKnot,
                          .course_deg = track.target.course_over_ground_deg,
                          .cpa_nm = approach.cpa_m / Length::kMetresPerNauticalMile,
                          .tcpa_min = approach.tcpa_s / 60.0,
                          .name = track.target.name,
                          .status = status_of(track),
                          .time_of_day = nmea::time_of_day(utc_of(ship))});
}

std::string tll_of(const Track& track, const wire::OwnShip& ship) {
  return encode(nmea::Tll{.number = track.number,
                          .position = track.target.position,
                          .name = track.target.name,
                          .time_of_day = nmea::time_of_day(utc_of(ship)),
                          .status = status_of(track)});
}

nmea::TtdTarget ttd_of(const Track& track) {
  return {.number = track.number,
          .bearing_deg = track.place.bearing_deg,
          .speed_kn = track.target.speed_mps / kKnot,
          .course_deg = track.target.course_over_ground_deg,
          .heading_deg = track.target.heading_deg,
          .range_nm = track.place.range_m / Length::kMetresPerNauticalMile,
          .status = track.lost ? nmea::TtdStatus::lost : nmea::TtdStatus::tracking};
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

std::vector<std::string> target_sentences(NavigationSentence sentence,
                                          const std::vector<Track>& tracks,
                                          const wire::OwnShip& ship, unsigned identifier) {
  if (sentence == NavigationSentence::ttd) {
    std::vector<nmea::TtdTarget> targets;
    for (const Track& track : tracks) targets.push_back(ttd_of(track));
    return nmea::encode_ttd(targets, identifier);
  }
  std::vector<std::string> lines;
  for (const Track& track : tracks) {
    lines.push_back(sentence == NavigationSentence::ttm ? ttm_of(track, ship)
                                                        : tll_of(track, ship));
  }
  return lines;
}

}  // namespace skerry::server
