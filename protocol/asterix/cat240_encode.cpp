#include <algorithm>
#include <cmath>
#include <limits>

#include "protocol/asterix/cat240.hpp"
#include "protocol/asterix/cat240_items.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry {
namespace {

using cat240::Item;
using cat240::ItemSet;

// LSB 360/65536 deg, rounded; a bearing just below north rounds to 0.
std::uint16_t azimuth(TrueBearing bearing) {
  return static_cast<std::uint16_t>((std::uint64_t{bearing.units()} + 0x8000) >> 16);
}

// Truncated, so that no time of day lies in the next day.
std::uint32_t time_of_day(UtcTime utc) {
  constexpr std::int64_t kDay = 86'400'000'000'000;
  const std::int64_t count = utc.time_since_epoch().count() % kDay;
  const std::int64_t since_midnight = count < 0 ? count + kDay : count;
  return static_cast<std::uint32_t>(since_midnight * cat240::kTimeOfDayPerSecond / 1'000'000'000);
}

const cat240::BlockSize& smallest_block(std::size_t octets) {
  return *std::find_if(
      cat240::kBlockSizes.begin(), cat240::kBlockSizes.end() - 1,
      [&](const cat240::BlockSize& size) { return octets <= size.octets * size.max_repetitions; });
}

// Writes CAT and FSPEC; the returned position goes to end_block().
std::size_t begin_block(Bytes& out, ItemSet items, Cat240Source source, Cat240Kind kind) {
  const std::size_t start = out.size();
  append_big_endian(out, kCat240, 1);
  append_big_endian(out, 0, 2);
  out.push_back(items.octet(0) | cat240::kFieldExtension);
  out.push_back(items.octet(1));
  out.push_back(source.sac);
  out.push_back(source.sic);
  out.push_back(static_cast<std::uint8_t>(kind));
  return start;
}

void end_block(Bytes& out, std::size_t start) {
  const std::size_t length = out.size() - start;
  out[start + 1] = static_cast<std::uint8_t>(length >> 8);
  out[start + 2] = static_cast<std::uint8_t>(length);
}

// First, nearest, cell in the high nibble: ASTERIX counts bits from the most significant.
void append_cells(Bytes& out, const std::vector<std::uint8_t>& cells, std::uint32_t bits) {
  if (bits == 8) {
    out.insert(out.end(), cells.begin(), cells.end());
    return;
  }
  const std::size_t start = out.size();
  out.resize(start + (cells.size() + 1) / 2);
  std::uint8_t* const octets = out.data() + start;
  const std::size_t pairs = cells.size() / 2;
  for (std::size_t i = 0; i < pairs; ++i) {
    octets[i] = static_cast<std::uint8_t>(cells[2 * i] << 4 | (cells[2 * i + 1] & 0x0F));
  }
  if (cells.size() % 2 != 0) octets[pairs] = static_cast<std::uint8_t>(cells.back() << 4);
}

}  // namespace

void append_cat240_video(Bytes& out, const Spoke& spoke, Cat240Source source,
                         std::uint32_t message_index) {
  const SpokeHeader& header = spoke.header;
  const ScanGeometry& geometry = header.geometry;
  const std::size_t octets = (std::size_t{geometry.cells} * geometry.bits + 7) / 8;
  const cat240::BlockSize& block = smallest_block(octets);

  const double cell_seconds = 2.0 * header.cell_size().in_metres() / cat240::kSpeedOfLight;
  const double femtoseconds = std::round(cell_seconds * 1e15);
  const bool femto = femtoseconds <= std::numeric_limits<std::uint32_t>::max();
  const auto duration =
      static_cast<std::uint32_t>(femto ? femtoseconds : std::round(cell_seconds * 1e9));
  const RelativeBearing next =
      RelativeBearing::of_spoke(header.index + 1, geometry.spokes_per_turn);

  const std::size_t start =
      begin_block(out,
                  ItemSet(Item::source, Item::message_type, Item::message_index,
                          femto ? Item::header_femto : Item::header_nano, Item::resolution,
                          Item::counters, block.item, Item::time_of_day),
                  source, Cat240Kind::video);
  append_big_endian(out, message_index, 4);
  append_big_endian(out, azimuth(header.bearing()), 2);
  append_big_endian(out, azimuth(to_true(next, header.heading)), 2);
  append_big_endian(out, 0, 4);
  append_big_endian(out, duration, 4);
  out.push_back(0);
  out.push_back(geometry.bits == 4 ? 3 : 4);
  append_big_endian(out, octets, 2);
  append_big_endian(out, geometry.cells, 3);
  const std::size_t repetitions = (octets + block.octets - 1) / block.octets;
  append_big_endian(out, repetitions, 1);
  append_cells(out, spoke.cells, geometry.bits);
  out.insert(out.end(), repetitions * block.octets - octets, 0);
  append_big_endian(out, time_of_day(header.utc), 3);
  end_block(out, start);
}

Bytes encode_cat240_video(const Spoke& spoke, Cat240Source source, std::uint32_t message_index) {
  Bytes out;
  append_cat240_video(out, spoke, source, message_index);
  return out;
}

void append_cat240_summary(Bytes& out, std::string_view text, Cat240Source source, UtcTime utc) {
  text = text.substr(0, kCat240MaxSummary);
  const std::size_t start =
      begin_block(out, ItemSet(Item::source, Item::message_type, Item::summary, Item::time_of_day),
                  source, Cat240Kind::summary);
  append_big_endian(out, text.size(), 1);
  for (const char each : text) {
    out.push_back(static_cast<std::uint8_t>(each >= ' ' && each <= '~' ? each : '?'));
  }
  append_big_endian(out, time_of_day(utc), 3);
  end_block(out, start);
}

Bytes encode_cat240_summary(std::string_view text, Cat240Source source, UtcTime utc) {
  Bytes out;
  append_cat240_summary(out, text, source, utc);
  return out;
}

}  // namespace skerry
