#include "protocol/captures/ship_track.hpp"

#include <cmath>
#include <variant>

#include "protocol/navico/ship_data.hpp"
#include "protocol/nmea/motion_sentences.hpp"
#include "protocol/nmea/position_sentences.hpp"
#include "protocol/nmea/udp450.hpp"

namespace skerry::captures {
namespace {

constexpr double kKnotsPerMps = 3600.0 / 1852.0;

// Takes what is there; whether it was.
template <typename T>
bool keep(const std::optional<T>& said, std::optional<T>& kept) {
  if (said) kept = said;
  return said.has_value();
}

bool on_earth(const GeoPoint& point) {
  return std::abs(point.latitude_deg) <= 90.0 && std::abs(point.longitude_deg) <= 180.0;
}

bool keep_position(const std::optional<GeoPoint>& said, std::optional<GeoPoint>& kept) {
  return said && on_earth(*said) && keep(said, kept);
}

}  // namespace

bool ShipTrack::hear(const pcap::Datagram& datagram) {
  const auto payload = datagram.payload;
  if (payload.empty()) return false;
  bool said = false;
  if (nmea::is_udp450(payload)) {
    if (const auto lines = nmea::decode_udp450(payload)) {
      for (const nmea::TaggedLine& line : *lines) said |= read_line(line.sentence);
    }
    return said;
  }
  if (payload[0] == '$' || payload[0] == '!') {
    std::string_view rest(reinterpret_cast<const char*>(payload.data()), payload.size());
    while (!rest.empty()) {
      const std::size_t end = rest.find('\n');
      said |= read_line(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
    }
    return said;
  }
  const auto packet = navico::decode_ship_packet(payload);
  if (!packet) return false;
  if (const auto* heading = std::get_if<navico::HeadingPacket>(&*packet)) {
    heading_deg_ = heading->heading_deg;
  } else if (const auto* ground = std::get_if<navico::NavigationPacket>(&*packet)) {
    course_deg_ = ground->course_deg;
    speed_kn_ = ground->speed_mps * kKnotsPerMps;
  } else if (const auto* speed = std::get_if<navico::SpeedPacket>(&*packet)) {
    course_deg_ = speed->course_deg;
    speed_kn_ = speed->speed_mps * kKnotsPerMps;
  }
  return true;
}

void ShipTrack::put(const ShipFix& fix) {
  keep_position(fix.position, position_);
  keep(fix.heading_deg, heading_deg_);
  keep(fix.course_deg, course_deg_);
  keep(fix.speed_kn, speed_kn_);
  keep(fix.rate_deg_min, rate_deg_min_);
}

bool ShipTrack::read_line(std::string_view line) {
  const auto sentence = nmea::parse_sentence(line);
  if (!sentence) return false;
  const std::string_view kind = sentence->formatter;
  if (kind == "RMC") {
    const auto rmc = nmea::decode_rmc(*sentence);
    if (!rmc || !rmc->valid) return false;
    keep(rmc->speed_kn, speed_kn_);
    keep(rmc->course_deg, course_deg_);
    return keep_position(rmc->position, position_);
  }
  if (kind == "GGA") {
    const auto gga = nmea::decode_gga(*sentence);
    return gga && gga->quality > 0 && keep_position(gga->position, position_);
  }
  if (kind == "GLL") {
    const auto gll = nmea::decode_gll(*sentence);
    return gll && gll->valid && keep_position(gll->position, position_);
  }
  if (kind == "VTG") {
    const auto vtg = nmea::decode_vtg(*sentence);
    if (!vtg || vtg->mode == 'N') return false;
    const bool course = keep(vtg->course_deg, course_deg_);
    return keep(vtg->speed_kn, speed_kn_) || course;
  }
  if (kind == "HDT") {
    const auto hdt = nmea::decode_hdt(*sentence);
    return hdt && keep(hdt->heading_deg, heading_deg_);
  }
  if (kind == "THS") {
    const auto ths = nmea::decode_ths(*sentence);
    return ths && ths->mode != 'V' && keep(ths->heading_deg, heading_deg_);
  }
  if (kind == "ROT") {
    const auto rot = nmea::decode_rot(*sentence);
    return rot && rot->valid && keep(rot->rate_deg_min, rate_deg_min_);
  }
  return false;
}

std::optional<TrueBearing> ShipTrack::heading() const {
  if (!heading_deg_) return std::nullopt;
  return TrueBearing::from(degrees(*heading_deg_));
}

wire::OwnShip ShipTrack::own_ship(std::uint32_t radar, UtcTime time) const {
  wire::OwnShip ship;
  ship.set_radar(radar);
  ship.set_name("own ship");
  if (position_) {
    ship.set_latitude_deg(position_->latitude_deg);
    ship.set_longitude_deg(wrapped_longitude(position_->longitude_deg));
  }
  ship.set_no_position(!position_);
  ship.set_no_motion(!speed_kn_ || !course_deg_);
  ship.set_no_heading(!heading_deg_);
  ship.set_heading_deg(heading() ? heading()->in_degrees() : 0.0);
  if (!ship.no_motion()) {
    ship.set_course_over_ground_deg(*course_deg_);
    ship.set_speed_over_ground_kn(*speed_kn_);
    ship.set_speed_kn(*speed_kn_);
    ship.set_rate_of_turn_deg_min(rate_deg_min_.value_or(0.0));
  }
  ship.set_ordered_course_deg(ship.heading_deg());
  ship.set_ordered_speed_kn(ship.speed_kn());
  ship.set_utc_ns(static_cast<std::uint64_t>(time.time_since_epoch().count()));
  ship.set_driven(true);
  return ship;
}

}  // namespace skerry::captures
