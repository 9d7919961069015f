// Reports with every item, at either end of what the items hold, and between.
#pragma once

#include "protocol/asterix/cat010.hpp"
#include "protocol/asterix/cat048.hpp"
#include "protocol/asterix/cat062.hpp"

namespace skerry {

inline constexpr double kNauticalMile = 1852.0;
inline constexpr Duration kLastTime = Duration(7'812'500) * (86'400 * 128 - 1);

// Every value as far as it goes, up or down.
inline Cat048Report full_cat048(bool most) {
  const auto at = [most](double least, double greatest) { return most ? greatest : least; };
  return {
      .source = {25, 7},
      .time_of_day = most ? kLastTime : Duration{0},
      .detection = most ? Cat048Detection::roll_call_and_primary : Cat048Detection::none,
      .is_simulated = most,
      .is_test = most,
      .measured = AsterixPolar{at(0, 65'535 * kNauticalMile / 256), at(0, 65'535 * 360.0 / 65'536)},
      .run_length_deg = at(0, 255 * 360.0 / 8192),
      .amplitude_dbm = at(-128, 127),
      .track_number = most ? 4095 : 0,
      .position = PlanePoint{at(-256, 256 - 1.0 / 128) * kNauticalMile,
                             at(-256, 256 - 1.0 / 128) * kNauticalMile},
      .velocity = AsterixVelocity{at(0, 65'535 * kNauticalMile / 16'384), at(0, 90)},
      .status =
          Cat048TrackStatus{.is_tentative = most,
                            .sensors = most ? Cat048Sensors::invalid : Cat048Sensors::combined,
                            .is_doubtful = most,
                            .is_manoeuvring = most,
                            .is_ended = most,
                            .is_ghost = most},
      .quality = Cat048Quality{at(0, 255 * kNauticalMile / 128), at(0, kNauticalMile / 128),
                               at(0, 255 * kNauticalMile / 16'384), at(0, 255 * 360.0 / 4096)}};
}

inline Cat062Report full_cat062(bool most) {
  const auto at = [most](double least, double greatest) { return most ? greatest : least; };
  return {
      .source = {25, 8},
      .service = most ? std::uint8_t{255} : std::uint8_t{0},
      .time_of_day = most ? kLastTime : Duration{0},
      .place = GeoPoint{at(-90, 90), at(-180, 180 - 180.0 / (1 << 25))},
      .position = PlanePoint{at(-4'194'304, 4'194'303.5), at(-4'194'304, 4'194'303.5)},
      .velocity = AsterixVector{at(-8192, 8191.75), at(-8192, 8191.75)},
      .acceleration = AsterixVector{at(-32, 31.75), at(-32, 31.75)},
      .track_number = most ? std::uint16_t{65'535} : std::uint16_t{0},
      .status = {.is_monosensor = most,
                 .is_tentative = most,
                 .is_simulated = most,
                 .is_ended = most,
                 .is_new = most,
                 .is_amalgamated = most,
                 .is_coasting = most},
      .track_age_s = at(0, 63.75),
      .primary_age_s = at(0, 63.75),
      .movement = most ? Cat062Movement{Cat062Turn::undetermined, Cat062SpeedChange::undetermined}
                       : Cat062Movement{},
      .size = AsterixSize{at(0, 127), at(0, 127 * 360.0 / 128), at(0, 127)},
      .position_deviation = AsterixVector{at(0, 32'767.5), at(0, 32'767.5)},
      .position_covariance_m = at(-16'384, 16'383.5),
      .velocity_deviation = AsterixVector{at(0, 63.75), at(0, 63.75)}};
}

inline Cat010Report full_cat010(bool most) {
  const auto at = [most](double least, double greatest) { return most ? greatest : least; };
  return {.source = {25, 9},
          .sensor = most ? Cat010Sensor::other : Cat010Sensor::secondary_multilateration,
          .is_simulated = most,
          .is_test = most,
          .time_of_day = most ? kLastTime : Duration{0},
          .place = GeoPoint{at(-90, 90), at(-180, 180 - 180.0 / (1u << 31))},
          .measured = AsterixPolar{at(0, 65'535), at(0, 65'535 * 360.0 / 65'536)},
          .position = PlanePoint{at(-32'768, 32'767), at(-32'768, 32'767)},
          .velocity = AsterixVelocity{at(0, 65'535 * kNauticalMile / 16'384), at(0, 270)},
          .plane_velocity = AsterixVector{at(-8192, 8191.75), at(-8192, 8191.75)},
          .track_number = most ? 4095 : 0,
          .status = Cat010TrackStatus{.is_tentative = most,
                                      .is_ended = most,
                                      .extrapolation = most ? Cat010Extrapolation::missed
                                                            : Cat010Extrapolation::none,
                                      .is_manoeuvring = most,
                                      .is_smoothed = most,
                                      .is_ghost = most},
          .size = AsterixSize{at(0, 127), at(0, 127 * 360.0 / 128), at(0, 127)},
          .deviation = Cat010Deviation{at(0, 63.75), at(0, 63.75), at(-8192, 8191.75)},
          .amplitude = most ? std::uint8_t{255} : std::uint8_t{0},
          .acceleration = AsterixVector{at(-32, 31.75), at(-32, 31.75)}};
}

// Records with items of every shape that are passed over.
inline Bytes cat048_of_others() {
  return {48,   0,    30,                         // category, octets
          0x81, 0x21, 0x45, 0x02,                 // FSPEC
          25,   7,                                // 010
          1,    1,    2,    3,    4, 5, 6, 7, 8,  // 250: one register
          0x03, 0x06,                             // 030: two codes
          0x40, 1,    1,    2,    3, 4, 5, 6,     // 120: raw Doppler speed
          2,    0xAA};                            // RE
}
inline Bytes cat062_of_others() {
  return {62,   0,    40,    // category, octets
          0x81, 0x1D, 0x42,  // FSPEC
          25,   8,           // 010
          0x01, 0x40, 1,    1,  2,  3,  4,  5,  6,
          7,    8,    9,    10, 11, 12, 13, 14, 15,  // 380: an intended point
          0,    7,                                   // 040
          0x80,                                      // 080
          0x81, 0x80, 1,    2,                       // 295: subfields 1 and 8
          0x01, 0x08, 1,    1,  2,  3,  4};          // 390: a time of departure
}

// One interface for the three.
inline std::vector<Bytes> encoded(std::span<const Cat048Report> reports, std::size_t most) {
  return encode_cat048(reports, most);
}
inline std::vector<Bytes> encoded(std::span<const Cat062Report> reports, std::size_t most) {
  return encode_cat062(reports, most);
}
inline std::vector<Bytes> encoded(std::span<const Cat010Report> reports, std::size_t most) {
  return encode_cat010(reports, most);
}
template <typename Report>
Result<std::vector<Report>, WireError> decoded_as(std::span<const std::uint8_t> datagram);
template <>
inline Result<std::vector<Cat048Report>, WireError> decoded_as(
    std::span<const std::uint8_t> datagram) {
  return decode_cat048(datagram);
}
template <>
inline Result<std::vector<Cat062Report>, WireError> decoded_as(
    std::span<const std::uint8_t> datagram) {
  return decode_cat062(datagram);
}
template <>
inline Result<std::vector<Cat010Report>, WireError> decoded_as(
    std::span<const std::uint8_t> datagram) {
  return decode_cat010(datagram);
}

}  // namespace skerry
