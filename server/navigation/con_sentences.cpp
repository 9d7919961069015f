#include "server/navigation/con_sentences.hpp"

#include <algorithm>
#include <cmath>

#include "protocol/nmea/depth_sentences.hpp"
#include "protocol/nmea/engine_sentences.hpp"
#include "protocol/nmea/log_sentences.hpp"
#include "protocol/nmea/rudder_sentences.hpp"
#include "protocol/nmea/track_sentences.hpp"
#include "protocol/nmea/wind_sentences.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/length.hpp"
#include "protocol/wire/own_ship_place.hpp"

namespace skerry::server {
namespace {

constexpr double kDeepestTransducer_m = 5.0;

std::string depth_of(const wire::ConState& con) {
  const double transducer_m = std::min(kDeepestTransducer_m, con.draught_m());
  const double below_keel_m = std::max(con.depth_below_keel_m(), 0.0);
  const double depth_m = below_keel_m + con.draught_m() - transducer_m;
  if (depth_m > 12000.0) return encode(nmea::Dpt{});
  return encode(nmea::Dpt{.depth_m = depth_m, .offset_m = transducer_m - con.draught_m()});
}

// The wind that is felt: the true one, and that of her own way over ground.
std::string felt_wind_of(const wire::OwnShip& ship) {
  const wire::ConState& con = ship.con();
  const double from = (con.wind_from_deg() - ship.heading_deg()) * kRadiansPerDegree;
  const double ahead_kn = con.wind_kn() * std::cos(from) + con.ground_ahead_kn();
  const double starboard_kn = con.wind_kn() * std::sin(from) + con.ground_starboard_kn();
  return encode(nmea::Mwv{
      .angle_deg = wrapped_degrees(std::atan2(starboard_kn, ahead_kn) * kDegreesPerRadian),
      .reference = nmea::WindReference::relative,
      .speed_kn = std::hypot(ahead_kn, starboard_kn)});
}

}  // namespace

bool is_of_con(NavigationSentence sentence) {
  return sentence >= NavigationSentence::rsa && sentence <= NavigationSentence::xte;
}

std::string con_sentence(NavigationSentence sentence, const wire::OwnShip& ship) {
  const wire::ConState& con = ship.con();
  const bool knows_way = !ship.no_motion() && !ship.no_heading();  // over ground, as a vector
  switch (sentence) {
    case NavigationSentence::rsa:
      return encode(nmea::Rsa{.starboard_deg = con.rudder_deg()});
    case NavigationSentence::rpm:
      return encode(nmea::Rpm{.source = nmea::RevolutionSource::shaft,
                              .number = 0,
                              .revolutions = con.shaft_rpm(),
                              .pitch_percent = 100.0});
    case NavigationSentence::dpt:
      return depth_of(con);
    case NavigationSentence::mwv:
      return ship.no_wind() ? encode(nmea::Mwv{}) : felt_wind_of(ship);
    case NavigationSentence::mwd:
      if (ship.no_wind() || !knows_way) return encode(nmea::Mwd{});
      return encode(nmea::Mwd{.from_deg = con.wind_from_deg(), .speed_kn = con.wind_kn()});
    case NavigationSentence::vdr:
      if (!knows_way || !wire::knows_log(ship)) return encode(nmea::Vdr{});
      return encode(nmea::Vdr{.set_deg = con.current_set_deg(), .drift_kn = con.current_kn()});
    default: {  // xte
      const bool on_track = con.waypoint() > 0 && !ship.no_position();
      const double off_nm = con.cross_track_m() / Length::kMetresPerNauticalMile;
      return encode(nmea::Xte{
          .valid = on_track,
          .off_track_nm = on_track ? std::optional(std::clamp(off_nm, -99.9, 99.9)) : std::nullopt,
          .mode = on_track ? 'A' : 'N'});
    }
  }
}

}  // namespace skerry::server
