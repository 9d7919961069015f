// Items that several categories have, written and read.  Shared by them, of no use elsewhere.
// Writers append nothing if the item is absent or not good; readers return whether it is allowed.
#pragma once

#include <cstdint>
#include <optional>

#include "protocol/asterix/item_reader.hpp"
#include "protocol/asterix/quantity_coding.hpp"
#include "protocol/asterix/report_parts.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::asterix {

void write_source(Bytes& out, AsterixSource source);
AsterixSource read_source(const ItemOctets& item);

// Three octets of 1/128 s since midnight, truncated, so that no time lies in the next day.
void write_time_of_day(Bytes& out, std::optional<Duration> time);
bool read_time_of_day(const ItemOctets& item, std::optional<Duration>& time);

// Two octets, of which twelve bits count.
void write_track_number(Bytes& out, std::optional<unsigned> number);
unsigned read_track_number(const ItemOctets& item);

// Two octets of range in the given unit, and of bearing.
void write_polar(Bytes& out, const std::optional<AsterixPolar>& polar, const Quantity& range);
AsterixPolar read_polar(const ItemOctets& item, const Quantity& range);

// Two octets of speed, and of course: I048/200, I010/200.
void write_velocity(Bytes& out, const std::optional<AsterixVelocity>& velocity);
AsterixVelocity read_velocity(const ItemOctets& item);

// Two of one quantity, the eastern one first: of vectors and of places in a plane.
void write_vector(Bytes& out, const std::optional<AsterixVector>& vector, const Quantity& quantity);
AsterixVector read_vector(std::span<const std::uint8_t> octets, const Quantity& quantity);
void write_plane(Bytes& out, const std::optional<PlanePoint>& point, const Quantity& quantity);
PlanePoint read_plane(const ItemOctets& item, const Quantity& quantity);

// Four octets of latitude, and of longitude, each in 180 / 2^bits degrees.
void write_place(Bytes& out, const std::optional<GeoPoint>& place, unsigned bits);
bool read_place(const ItemOctets& item, std::optional<GeoPoint>& place, unsigned bits);

// I062/270, I010/270.
void write_size(Bytes& out, const std::optional<AsterixSize>& size);
AsterixSize read_size(const ItemOctets& item);

}  // namespace skerry::asterix
