#include "protocol/asterix/common_items.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "protocol/asterix/item_writer.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry {

Duration asterix_time_of_day(UtcTime utc) {
  constexpr Duration kDay = std::chrono::hours(24);
  const Duration rest = utc.time_since_epoch() % kDay;
  return rest < Duration{0} ? rest + kDay : rest;
}

}  // namespace skerry

namespace skerry::asterix {
namespace {

constexpr Duration kTimeUnit{7'812'500};  // 1/128 s
constexpr unsigned kMostTrackNumber = 4095;
constexpr double kMostSize = 127.0, kSizeTurn = 128.0;  // m; units of a turn

// Seven bits above the one that says whether another octet follows.
unsigned seven_bits(double units) { return static_cast<unsigned>(units) << 1; }

unsigned size_octet(double metres) {
  return seven_bits(std::clamp(std::round(metres), 0.0, kMostSize));
}

}  // namespace

void write_source(Bytes& out, AsterixSource source) {
  out.push_back(source.sac);
  out.push_back(source.sic);
}

AsterixSource read_source(const ItemOctets& item) { return {item.octets[0], item.octets[1]}; }

void write_time_of_day(Bytes& out, std::optional<Duration> time) {
  if (!time || *time < Duration{0} || *time / kTimeUnit >= kTimeOfDayPerDay) return;
  append_big_endian(out, static_cast<std::uint64_t>(*time / kTimeUnit), 3);
}

bool read_time_of_day(const ItemOctets& item, std::optional<Duration>& time) {
  const auto units = big_endian_at<std::uint32_t>(item.octets, 0, 3);
  time = units * kTimeUnit;
  return units < kTimeOfDayPerDay;
}

void write_track_number(Bytes& out, std::optional<unsigned> number) {
  if (number && *number <= kMostTrackNumber) append_big_endian(out, *number, 2);
}

unsigned read_track_number(const ItemOctets& item) {
  return big_endian_at<std::uint32_t>(item.octets, 0, 2) & kMostTrackNumber;
}

void write_polar(Bytes& out, const std::optional<AsterixPolar>& polar, const Quantity& range) {
  if (polar) append_quantities(out, {{range, polar->range_m}, {kAngle, polar->bearing_deg}});
}

AsterixPolar read_polar(const ItemOctets& item, const Quantity& range) {
  return {quantity_at(item.octets, 0, range), quantity_at(item.octets, 2, kAngle)};
}

void write_velocity(Bytes& out, const std::optional<AsterixVelocity>& velocity) {
  if (!velocity) return;
  append_quantities(out, {{kSpeed, velocity->speed_mps}, {kAngle, velocity->course_deg}});
}

AsterixVelocity read_velocity(const ItemOctets& item) {
  return {quantity_at(item.octets, 0, kSpeed), quantity_at(item.octets, 2, kAngle)};
}

void write_vector(Bytes& out, const std::optional<AsterixVector>& vector,
                  const Quantity& quantity) {
  if (vector) append_quantities(out, {{quantity, vector->east}, {quantity, vector->north}});
}

AsterixVector read_vector(std::span<const std::uint8_t> octets, const Quantity& quantity) {
  return {quantity_at(octets, 0, quantity), quantity_at(octets, quantity.octets, quantity)};
}

void write_plane(Bytes& out, const std::optional<PlanePoint>& point, const Quantity& quantity) {
  if (point) append_quantities(out, {{quantity, point->east_m}, {quantity, point->north_m}});
}

PlanePoint read_plane(const ItemOctets& item, const Quantity& quantity) {
  const AsterixVector read = read_vector(item.octets, quantity);
  return {read.east, read.north};
}

void write_place(Bytes& out, const std::optional<GeoPoint>& place, unsigned bits) {
  if (!place || !(std::abs(place->latitude_deg) <= 90.0)) return;
  if (!std::isfinite(place->longitude_deg)) return;
  const Quantity quantity{4, 180.0 / static_cast<double>(1u << bits), true};
  double longitude = std::remainder(place->longitude_deg, 360.0);
  // So near to 180 degrees east that it becomes 180 west.
  if (std::round(longitude / quantity.unit) * quantity.unit >= 180.0) longitude = -180.0;
  append_quantities(out, {{quantity, place->latitude_deg}, {quantity, longitude}});
}

bool read_place(const ItemOctets& item, std::optional<GeoPoint>& place, unsigned bits) {
  const Quantity quantity{4, 180.0 / static_cast<double>(1u << bits), true};
  const double latitude = quantity_at(item.octets, 0, quantity);
  const double longitude = quantity_at(item.octets, 4, quantity);
  if (std::abs(latitude) > 90.0 || std::abs(longitude) > 180.0) return false;
  place = GeoPoint{latitude, wrapped_longitude(longitude)};
  return true;
}

void write_size(Bytes& out, const std::optional<AsterixSize>& size) {
  if (!size || !std::isfinite(size->length_m)) return;
  Bytes octets{static_cast<std::uint8_t>(size_octet(size->length_m))};
  if (size->orientation_deg && std::isfinite(*size->orientation_deg)) {
    const double units =
        std::round(std::remainder(*size->orientation_deg, 360.0) * kSizeTurn / 360.0);
    octets.push_back(
        static_cast<std::uint8_t>(seven_bits(units < 0.0 ? units + kSizeTurn : units)));
    if (size->width_m && std::isfinite(*size->width_m)) {
      octets.push_back(static_cast<std::uint8_t>(size_octet(*size->width_m)));
    }
  }
  for (std::size_t i = 0; i + 1 < octets.size(); ++i) octets[i] |= kFieldExtension;
  out.insert(out.end(), octets.begin(), octets.end());
}

AsterixSize read_size(const ItemOctets& item) {
  AsterixSize size{static_cast<double>(item.octets[0] >> 1)};
  if (item.octets.size() > 1) size.orientation_deg = (item.octets[1] >> 1) * 360.0 / kSizeTurn;
  if (item.octets.size() > 2) size.width_m = item.octets[2] >> 1;
  return size;
}

}  // namespace skerry::asterix
