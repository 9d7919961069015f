#include "server/navigation/navigation_listener.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/quantity/angle.hpp"
#include "protocol/quantity/speed.hpp"
#include "server/navigation/alert_talker.hpp"
#include "server/navigation/target_geometry.hpp"

namespace skerry::server {
namespace {

// Before the first speed is known.
constexpr double kAssumedSpeedMps = 20.0;

// The value, or nothing and why not.
template <typename T>
std::optional<T> read_as(Result<T, WireError> result, std::string& fault) {
  if (result) return std::move(result).value();
  fault = result.error().text;
  return std::nullopt;
}

std::optional<wire::TargetOrder> read_alert_order(const nmea::Sentence& sentence,
                                                  std::string& fault) {
  if (sentence.formatter == "ACN") {
    const auto command = read_as(nmea::decode_acn(sentence), fault);
    return command ? order_of(*command) : std::nullopt;
  }
  const auto command = read_as(nmea::decode_ack(sentence), fault);
  return command ? order_of(*command) : std::nullopt;
}

bool is_usable(char mode) { return mode != 'N' && mode != 'V'; }

bool says_something(const OwnShipFix& fix) {
  return fix.position || fix.heading_deg || fix.course_over_ground_deg || fix.speed_mps ||
         fix.rate_of_turn_deg_min;
}

OwnShipFix at(std::optional<GeoPoint> position) {
  OwnShipFix fix;
  fix.position = position;
  return fix;
}

}  // namespace

HeardLine NavigationListener::hear(std::string_view line, ScenarioTime now) {
  HeardLine heard;
  const auto sentence = nmea::parse_sentence(line);
  if (!sentence) {
    heard.fault = sentence.error().text;
    return heard;
  }
  const auto command = nmea::decode_con_command(*sentence);
  if (!command) {
    heard.fault = command.error().text;
    return heard;
  }
  if (nmea::says_something(*command)) {
    heard.command = *command;
    return heard;
  }
  if (sentence->formatter == "ACN" || sentence->formatter == "ACK") {
    heard.alert_order = read_alert_order(*sentence, heard.fault);
    return heard;
  }
  Fix fix = read(*sentence, now, heard.fault);
  if (!fix || !says_something(*fix) || !heard.fault.empty()) return heard;
  if (fix->speed_mps && *fix->speed_mps > kMostSpeedMps) {
    heard.fault = fmt::format("{} says {:.0f} kn; own ship is driven at 194 kn at most",
                              sentence->formatter, *fix->speed_mps / kKnot);
    return heard;
  }
  if (!last_fix_ || now - *last_fix_ > silence_) position_at_ = std::nullopt;
  if (fix->heading_deg) heading_deg_ = fix->heading_deg = wrapped_degrees(*fix->heading_deg);
  if (fix->course_over_ground_deg) {
    fix->course_over_ground_deg = wrapped_degrees(*fix->course_over_ground_deg);
  }
  if (fix->position) {
    // The faster of two speeds explains the distance made.
    const auto before = speed_mps_;
    if (fix->speed_mps) speed_mps_ = std::max(*fix->speed_mps, speed_mps_.value_or(0.0));
    heard.jump_m = jump(*fix->position, now);
    speed_mps_ = before;
    position_ = *fix->position;
    position_at_ = now;
  }
  if (fix->speed_mps) speed_mps_ = fix->speed_mps;
  last_fix_ = now;
  heard.fix = std::move(fix);
  return heard;
}

NavigationListener::Fix NavigationListener::read(const nmea::Sentence& sentence, ScenarioTime now,
                                                 std::string& fault) {
  const std::string_view kind = sentence.formatter;
  if (sentence.start != '$') return std::nullopt;
  if (kind == "RMC") {
    const auto rmc = read_as(nmea::decode_rmc(sentence), fault);
    if (!rmc || !(rmc->valid || rmc->mode == 'S') || !is_usable(rmc->mode)) return std::nullopt;
    OwnShipFix fix = at(rmc->position);
    over_ground(fix, rmc->speed_kn, rmc->course_deg, now);
    return fix;
  }
  if (kind == "GGA") {
    const auto gga = read_as(nmea::decode_gga(sentence), fault);
    if (!gga || gga->quality == 0) return std::nullopt;
    return at(gga->position);
  }
  if (kind == "GLL") {
    const auto gll = read_as(nmea::decode_gll(sentence), fault);
    if (!gll || !gll->valid) return std::nullopt;
    return at(gll->position);
  }
  if (kind == "VTG") {
    const auto vtg = read_as(nmea::decode_vtg(sentence), fault);
    if (!vtg || !is_usable(vtg->mode)) return std::nullopt;
    OwnShipFix fix;
    over_ground(fix, vtg->speed_kn, vtg->course_deg, now);
    return fix;
  }
  OwnShipFix fix;
  if (kind == "HDT") {
    const auto hdt = read_as(nmea::decode_hdt(sentence), fault);
    if (hdt) fix.heading_deg = hdt->heading_deg;
    return fix;
  }
  if (kind == "THS") {
    const auto ths = read_as(nmea::decode_ths(sentence), fault);
    if (ths && is_usable(ths->mode)) fix.heading_deg = ths->heading_deg;
    return fix;
  }
  if (kind == "ROT") {
    const auto rot = read_as(nmea::decode_rot(sentence), fault);
    if (rot && rot->valid) fix.rate_of_turn_deg_min = rot->rate_deg_min;
    return fix;
  }
  return read_log(sentence, now, fault);
}

NavigationListener::Fix NavigationListener::read_log(const nmea::Sentence& sentence,
                                                     ScenarioTime now, std::string& fault) {
  OwnShipFix fix;
  std::optional<double> ahead_kn;  // through the water
  double starboard_kn = 0.0;
  bool by_ground = false;
  if (sentence.formatter == "VHW") {
    const auto vhw = read_as(nmea::decode_vhw(sentence), fault);
    if (!vhw) return std::nullopt;
    fix.heading_deg = vhw->heading_deg;
    ahead_kn = vhw->speed_kn;
  } else if (sentence.formatter == "VBW") {
    const auto vbw = read_as(nmea::decode_vbw(sentence), fault);
    if (!vbw) return std::nullopt;
    by_ground = vbw->ground_ahead_kn.has_value();
    ahead_kn = by_ground ? vbw->ground_ahead_kn : vbw->water_ahead_kn;
    starboard_kn = (by_ground ? vbw->ground_starboard_kn : vbw->water_starboard_kn).value_or(0.0);
  } else {
    return std::nullopt;
  }
  if (!ahead_kn || (!by_ground && !lacks_ground_speed(now))) return fix;
  const std::optional<double> heading = fix.heading_deg ? fix.heading_deg : heading_deg_;
  const double speed_kn = std::hypot(*ahead_kn, starboard_kn);
  std::optional<double> course;
  if (heading && speed_kn > 0.0) {
    course = *heading + radians(std::atan2(starboard_kn, *ahead_kn)).in_degrees();
  }
  if (by_ground) {
    over_ground(fix, speed_kn, course, now);
  } else {
    fix.speed_mps = speed_kn * kKnot;
    fix.course_over_ground_deg = course;
  }
  return fix;
}

void NavigationListener::over_ground(OwnShipFix& fix, std::optional<double> speed_kn,
                                     std::optional<double> course_deg, ScenarioTime now) {
  if (speed_kn) {
    fix.speed_mps = *speed_kn * kKnot;
    ground_speed_at_ = now;
  }
  fix.course_over_ground_deg = course_deg;
}

bool NavigationListener::lacks_ground_speed(ScenarioTime now) const {
  return !ground_speed_at_ || now - *ground_speed_at_ > kGroundSpeedLasts;
}

std::optional<double> NavigationListener::jump(GeoPoint to, ScenarioTime now) const {
  if (!position_at_) return std::nullopt;
  const double moved_m = place_of(to, position_).range_m;
  const double speed = speed_mps_.value_or(kAssumedSpeedMps);
  const double explained_m = kJumpSlack + 2.0 * speed * in_seconds(now - *position_at_);
  if (moved_m <= explained_m) return std::nullopt;
  return moved_m;
}

}  // namespace skerry::server
