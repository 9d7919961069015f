#include "protocol/nmea/ais_messages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace skerry::nmea {
namespace {

constexpr std::int32_t kNoLatitude = 91 * 600'000, kNoLongitude = 181 * 600'000;
constexpr std::uint32_t kNoSpeed = 1023, kMostSpeed = 1022, kNoCourse = 3600, kNoHeading = 511;
constexpr std::int32_t kNoTurn = -128;
constexpr double kTurnScale = 4.733;  // AIS rate = 4.733 sqrt(deg/min)

std::uint32_t speed_bits(std::optional<double> knots) {
  if (!knots || !(*knots >= 0.0)) return kNoSpeed;
  return static_cast<std::uint32_t>(std::min(std::round(*knots * 10.0), double{kMostSpeed}));
}

std::uint32_t angle_bits(std::optional<double> degrees, double scale, std::uint32_t none) {
  if (!degrees || !std::isfinite(*degrees)) return none;
  const double turn = 360.0 * scale;
  double units = std::fmod(std::round(*degrees * scale), turn);
  if (units < 0) units += turn;
  return static_cast<std::uint32_t>(units);
}

std::int32_t turn_bits(std::optional<double> rate) {
  if (!rate || !std::isfinite(*rate)) return kNoTurn;
  const double size = std::min(std::round(kTurnScale * std::sqrt(std::abs(*rate))), 126.0);
  return static_cast<std::int32_t>(*rate < 0 ? -size : size);
}

void add_position(SixBitWriter& out, const std::optional<GeoPoint>& point) {
  std::int32_t latitude = kNoLatitude, longitude = kNoLongitude;
  if (point && std::isfinite(point->latitude_deg) && std::isfinite(point->longitude_deg)) {
    latitude = static_cast<std::int32_t>(
        std::lround(std::clamp(point->latitude_deg, -90.0, 90.0) * 600'000));
    longitude =
        static_cast<std::int32_t>(std::lround(std::remainder(point->longitude_deg, 360) * 600'000));
  }
  out.add_signed(longitude, 28);
  out.add_signed(latitude, 27);
}

std::optional<GeoPoint> take_position(SixBitReader& in) {
  const std::int32_t longitude = in.take_signed(28), latitude = in.take_signed(27);
  if (std::abs(latitude) > 90 * 600'000 || std::abs(longitude) > 180 * 600'000) return std::nullopt;
  return GeoPoint{latitude / 600'000.0, wrapped_longitude(longitude / 600'000.0)};
}

void add_size(SixBitWriter& out, const AisSize& size) {
  out.add(std::min(size.to_bow_m, 511u), 9);
  out.add(std::min(size.to_stern_m, 511u), 9);
  out.add(std::min(size.to_port_m, 63u), 6);
  out.add(std::min(size.to_starboard_m, 63u), 6);
}

AisSize take_size(SixBitReader& in) {
  AisSize size;
  size.to_bow_m = in.take(9);
  size.to_stern_m = in.take(9);
  size.to_port_m = in.take(6);
  size.to_starboard_m = in.take(6);
  return size;
}

SixBitWriter begin(unsigned type, std::uint32_t mmsi) {
  SixBitWriter out;
  out.add(type, 6);
  out.add(0, 2);  // not repeated
  out.add(mmsi, 30);
  return out;
}

// What messages 1, 18 and 19 have alike, from the speed to the second.
void add_motion(SixBitWriter& out, const AisPosition& message) {
  out.add(speed_bits(message.speed_kn), 10);
  out.add(1, 1);  // better than 10 m
  add_position(out, message.position);
  out.add(angle_bits(message.course_deg, 10.0, kNoCourse), 12);
  out.add(angle_bits(message.heading_deg, 1.0, kNoHeading), 9);
  out.add(message.utc_second, 6);
}

void take_motion(SixBitReader& in, AisPosition& message) {
  const std::uint32_t speed = in.take(10);
  if (speed != kNoSpeed) message.speed_kn = speed / 10.0;
  in.skip(1);
  message.position = take_position(in);
  const std::uint32_t course = in.take(12), heading = in.take(9);
  if (course < kNoCourse) message.course_deg = course / 10.0;
  if (heading < 360) message.heading_deg = heading;
  message.utc_second = in.take(6);
}

SixBitWriter bits_of(const AisPosition& message) {
  SixBitWriter out = begin(message.class_b ? 18 : 1, message.mmsi);
  if (message.class_b) {
    out.add(0, 8);
  } else {
    out.add(message.status, 4);
    out.add_signed(turn_bits(message.rate_of_turn_deg_min), 8);
  }
  add_motion(out, message);
  if (message.class_b) {
    out.add(0, 2);
    out.add(1, 1);  // a "CS" unit
    out.add(0, 2);  // no display, no DSC
    out.add(1, 1);  // the whole marine band
    out.add(0, 3);  // no message 22, autonomous, no RAIM
    out.add(1, 1);  // ITDMA communication state, as of a "CS" unit:
    out.add(0b110'0000'0000'0000'0110, 19);
  } else {
    out.add(0, 2);  // no special manoeuvre indicator
    out.add(0, 3);
    out.add(0, 1);   // no RAIM
    out.add(0, 19);  // SOTDMA: directly synchronised
  }
  return out;
}

SixBitWriter bits_of(const AisExtended& message) {
  SixBitWriter out = begin(19, message.position.mmsi);
  out.add(0, 8);
  add_motion(out, message.position);
  out.add(0, 4);
  out.add_text(message.name, 20);
  out.add(message.ship_type, 8);
  add_size(out, message.size);
  out.add(1, 4);  // GPS
  out.add(0, 1);  // no RAIM
  out.add(0, 2);  // data terminal ready, autonomous
  out.add(0, 4);
  return out;
}

SixBitWriter bits_of(const AisVoyage& message) {
  SixBitWriter out = begin(5, message.mmsi);
  out.add(2, 2);  // ITU-R M.1371-5
  out.add(message.imo, 30);
  out.add_text(message.call_sign, 7);
  out.add_text(message.name, 20);
  out.add(message.ship_type, 8);
  add_size(out, message.size);
  out.add(1, 4);  // GPS
  out.add(0, 4);  // time of arrival: month 0, day 0, 24:60 are not available
  out.add(0, 5);
  out.add(24, 5);
  out.add(60, 6);
  const double decimetres = std::isfinite(message.draught_m) ? message.draught_m * 10.0 : 0.0;
  out.add(static_cast<std::uint32_t>(std::lround(std::clamp(decimetres, 0.0, 255.0))), 8);
  out.add_text(message.destination, 20);
  out.add(0, 2);  // data terminal ready; spare
  return out;
}

SixBitWriter bits_of(const AisStatic& message) {
  SixBitWriter out = begin(24, message.mmsi);
  out.add(message.part_b ? 1 : 0, 2);
  if (!message.part_b) {
    out.add_text(message.name, 20);
    return out;
  }
  out.add(message.ship_type, 8);
  out.add(0, 32);  // vendor
  out.add(0, 10);
  out.add_text(message.call_sign, 7);
  add_size(out, message.size);
  out.add(0, 6);
  return out;
}

SixBitWriter bits_of(const AisAid& message) {
  SixBitWriter out = begin(21, message.mmsi);
  out.add(message.type, 5);
  out.add_text(message.name, 20);
  out.add(1, 1);
  add_position(out, message.position);
  add_size(out, message.size);
  out.add(message.is_virtual ? 0 : 7, 4);  // surveyed
  out.add(message.utc_second, 6);
  out.add(message.off_position ? 1 : 0, 1);
  out.add(0, 8);
  out.add(0, 1);  // no RAIM
  out.add(message.is_virtual ? 1 : 0, 1);
  out.add(0, 2);  // autonomous; spare
  if (message.name.size() > 20) {
    const std::size_t more = std::min<std::size_t>(message.name.size() - 20, 14);
    out.add_text(std::string_view(message.name).substr(20), more);
    while (out.bits() % 8 != 0) out.add(0, 1);
  }
  return out;
}

AisMessage take_position_report(SixBitReader& in, std::uint32_t mmsi, bool class_b) {
  AisPosition message{.mmsi = mmsi, .class_b = class_b};
  if (class_b) {
    in.skip(8);
  } else {
    message.status = in.take(4);
    const std::int32_t turn = in.take_signed(8);
    if (turn != kNoTurn) {
      const double root = turn / kTurnScale;
      message.rate_of_turn_deg_min = std::copysign(root * root, root);
    }
  }
  take_motion(in, message);
  return message;
}

AisMessage take_extended(SixBitReader& in, std::uint32_t mmsi) {
  AisExtended message;
  message.position.mmsi = mmsi;
  in.skip(8);
  take_motion(in, message.position);
  in.skip(4);
  message.name = in.take_text(20);
  message.ship_type = in.take(8);
  message.size = take_size(in);
  return message;
}

AisMessage take_voyage(SixBitReader& in, std::uint32_t mmsi) {
  AisVoyage message{.mmsi = mmsi};
  in.skip(2);
  message.imo = in.take(30);
  message.call_sign = in.take_text(7);
  message.name = in.take_text(20);
  message.ship_type = in.take(8);
  message.size = take_size(in);
  in.skip(24);
  message.draught_m = in.take(8) / 10.0;
  message.destination = in.take_text(20);
  return message;
}

AisMessage take_static(SixBitReader& in, std::uint32_t mmsi) {
  AisStatic message{.mmsi = mmsi};
  message.part_b = in.take(2) == 1;
  if (!message.part_b) {
    message.name = in.take_text(20);
    return message;
  }
  message.ship_type = in.take(8);
  in.skip(42);
  message.call_sign = in.take_text(7);
  message.size = take_size(in);
  return message;
}

AisMessage take_aid(SixBitReader& in, std::uint32_t mmsi) {
  AisAid message{.mmsi = mmsi};
  message.type = in.take(5);
  message.name = in.take_text(20);
  in.skip(1);
  message.position = take_position(in);
  message.size = take_size(in);
  in.skip(4);
  message.utc_second = in.take(6);
  message.off_position = in.take(1) == 1;
  in.skip(9);
  message.is_virtual = in.take(1) == 1;
  in.skip(2);
  const std::string extension = in.take_text(std::min<std::size_t>(14, in.left() / 6));
  if (!extension.empty()) {
    message.name.resize(20, ' ');
    message.name += extension;
  }
  return message;
}

}  // namespace

AisSize ais_size(double length_m, double beam_m) {
  const auto whole = [](double metres, double most) {
    return std::isfinite(metres) ? static_cast<unsigned>(std::clamp(std::ceil(metres), 0.0, most))
                                 : 0u;
  };
  const unsigned length = whole(length_m, 1022), beam = whole(beam_m, 126);
  return {length - length / 2, length / 2, beam / 2, beam - beam / 2};
}

SixBitWriter encode(const AisMessage& message) {
  return std::visit([](const auto& kind) { return bits_of(kind); }, message);
}

Result<AisMessage, WireError> decode_ais(SixBitReader bits) {
  const std::uint32_t type = bits.take(6);
  bits.skip(2);
  const std::uint32_t mmsi = bits.take(30);
  std::size_t needed = 0;
  switch (type) {
    case 1:
    case 2:
    case 3:
    case 18:
      needed = 168;
      break;
    case 5:
      needed = 420;  // some send 420 or 422 bits of the 424
      break;
    case 19:
      needed = 301;  // up to the size: some cut the spare end
      break;
    case 21:
      needed = 272;
      break;
    case 24:
      needed = 160;
      break;
    default:
      return Failure{WireError{WireErrorKind::unknown_kind, 0,
                               fmt::format("AIS message {} is not read here", type)}};
  }
  if (bits.bits() < needed) {
    return Failure{
        WireError{WireErrorKind::truncated, 0,
                  fmt::format("AIS message {} of {} bits; it has {}", type, bits.bits(), needed)}};
  }
  if (type == 5) return take_voyage(bits, mmsi);
  if (type == 19) return take_extended(bits, mmsi);
  if (type == 21) return take_aid(bits, mmsi);
  if (type == 24) return take_static(bits, mmsi);
  return take_position_report(bits, mmsi, type == 18);
}

}  // namespace skerry::nmea
