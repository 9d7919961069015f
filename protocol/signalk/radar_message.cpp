#include "protocol/signalk/radar_message.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cstring>

#include "protocol/wire/varint.hpp"

namespace skerry::signalk {
namespace {

// Field number and wire type of protobuf's encoding.
constexpr std::uint8_t tag(unsigned field, unsigned type) {
  return static_cast<std::uint8_t>(field << 3 | type);
}
constexpr unsigned kVarint = 0, kFixed64 = 1, kBytes = 2;
constexpr std::size_t kMaxHead = 64;  // all but the cells

class HeadWriter {
 public:
  void number(unsigned field, std::uint64_t value) {
    bytes_[size_++] = tag(field, kVarint);
    varint(value);
  }
  void length(unsigned field, std::uint64_t value) {
    bytes_[size_++] = tag(field, kBytes);
    varint(value);
  }
  void real(unsigned field, double value) {
    bytes_[size_++] = tag(field, kFixed64);
    std::uint64_t bits = std::bit_cast<std::uint64_t>(value);
    for (int i = 0; i < 8; ++i, bits >>= 8) bytes_[size_++] = static_cast<std::uint8_t>(bits);
  }
  const std::uint8_t* data() const { return bytes_; }
  std::size_t size() const { return size_; }

 private:
  void varint(std::uint64_t value) {
    size_ = static_cast<std::size_t>(write_varint(bytes_ + size_, value) - bytes_);
  }
  std::uint8_t bytes_[kMaxHead];
  std::size_t size_ = 0;
};

// The upper seven bits, but never 0 of what is not.
std::uint8_t level_of(std::uint8_t cell) {
  const auto half = static_cast<std::uint8_t>(cell >> 1);
  return std::max(half, std::min(cell, std::uint8_t{1}));
}

void put_levels(const RadarSpoke& spoke, std::uint8_t* out) {
  const std::uint8_t* cells = spoke.cells.data();
  const std::size_t count = spoke.cells.size();
  if (spoke.legend.levels == 16) {
    for (std::size_t i = 0; i < count; ++i) out[i] = std::min<std::uint8_t>(cells[i], 15);
  } else {
    for (std::size_t i = 0; i < count; ++i) out[i] = level_of(cells[i]);
  }
}

// The legend has the colours behind the target's border, in the order of the classes.  Without a
// branch, so that many cells are done at once.
void put_doppler(const RadarSpoke& spoke, std::uint8_t* out) {
  static_assert(static_cast<int>(DopplerClass::approaching) == 1 &&
                static_cast<int>(DopplerClass::receding) == 2);
  const std::uint8_t before_first = spoke.legend.target_border();
  const DopplerClass* doppler = spoke.doppler.data();
  const std::size_t count = std::min(spoke.cells.size(), spoke.doppler.size());
  for (std::size_t i = 0; i < count; ++i) {
    const auto moving = static_cast<std::uint8_t>(doppler[i]);
    const auto colour = static_cast<std::uint8_t>(before_first + moving);
    out[i] = ((moving != 0) & (out[i] != 0)) ? colour : out[i];
  }
}

}  // namespace

void append_radar_spoke(Bytes& out, const RadarSpoke& spoke) {
  HeadWriter body, head;
  body.number(1, spoke.angle);
  body.number(2, spoke.bearing);
  body.number(3, spoke.range_m);
  body.number(4, spoke.time_ms);
  body.real(6, spoke.position.latitude_deg);
  body.real(7, spoke.position.longitude_deg);
  body.length(5, spoke.cells.size());
  head.length(2, body.size() + spoke.cells.size());

  const std::size_t begin = out.size();
  out.resize(begin + head.size() + body.size() + spoke.cells.size());
  std::uint8_t* at = out.data() + begin;
  std::memcpy(at, head.data(), head.size());
  std::memcpy(at + head.size(), body.data(), body.size());
  at += head.size() + body.size();
  put_levels(spoke, at);
  if (!spoke.doppler.empty()) put_doppler(spoke, at);
}

RadarSpoke radar_spoke(const SpokeHeader& header) {
  const std::uint32_t turn = header.geometry.spokes_per_turn;
  RadarSpoke spoke;
  spoke.angle = header.index;
  spoke.bearing = (header.index + header.heading.nearest_spoke(turn)) % turn;
  spoke.range_m = whole_metres(header.reach());
  const auto since = std::chrono::floor<std::chrono::milliseconds>(header.utc.time_since_epoch());
  spoke.time_ms = static_cast<std::uint64_t>(std::max<std::int64_t>(since.count(), 0));
  spoke.position = header.own_ship;
  spoke.legend = legend_of(header.geometry.bits);
  return spoke;
}

std::uint32_t whole_metres(Length range) {
  return static_cast<std::uint32_t>(std::max(range.in_metres(), 0.0) + 0.5);
}

}  // namespace skerry::signalk
