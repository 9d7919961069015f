#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>

#include "protocol/asterix/cat240.hpp"
#include "protocol/asterix/cat240_cells.hpp"
#include "protocol/asterix/cat240_items.hpp"
#include "protocol/asterix/common_items.hpp"
#include "protocol/asterix/item_writer.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry {
namespace {

using cat240::Item;
using cat240::ItemSet;

// LSB 360/65536 deg, rounded; a bearing just below north rounds to 0.
std::uint16_t azimuth(TrueBearing bearing) {
  return static_cast<std::uint16_t>((std::uint64_t{bearing.units()} + 0x8000) >> 16);
}

const cat240::BlockSize& block_for(std::size_t octets, Cat240Blocks wish) {
  const std::size_t first = wish == Cat240Blocks::smallest ? 0 : static_cast<std::size_t>(wish) - 1;
  return *std::find_if(cat240::kBlockSizes.begin() + static_cast<std::ptrdiff_t>(first),
                       cat240::kBlockSizes.end() - 1, [&](const cat240::BlockSize& size) {
                         return octets <= size.octets * size.max_repetitions;
                       });
}

// Writes FSPEC and the items that every record has.
void begin_record(Bytes& out, ItemSet items, Cat240Source source, Cat240Kind kind) {
  items.append_to(out);
  out.push_back(source.sac);
  out.push_back(source.sic);
  out.push_back(static_cast<std::uint8_t>(kind));
}

// Item 048's name of a number of bits.
std::uint8_t resolution_of(std::uint32_t bits) {
  return static_cast<std::uint8_t>(std::countr_zero(bits) + 1);
}

struct Header {
  std::uint16_t start_azimuth, end_azimuth;
  bool femto;
  std::uint32_t duration;
};

Header header_of(const SpokeHeader& header, bool nanoseconds) {
  const double cell_seconds = 2.0 * header.cell_size().in_metres() / cat240::kSpeedOfLight;
  const double femtoseconds = std::round(cell_seconds * 1e15);
  const bool femto = !nanoseconds && femtoseconds <= std::numeric_limits<std::uint32_t>::max();
  const RelativeBearing next =
      RelativeBearing::of_spoke(header.index + 1, header.geometry.spokes_per_turn);
  return {azimuth(header.bearing()), azimuth(to_true(next, header.heading)), femto,
          static_cast<std::uint32_t>(femto ? femtoseconds : std::round(cell_seconds * 1e9))};
}

}  // namespace

std::uint32_t cat240_max_cells(std::uint32_t bits_per_cell) {
  constexpr std::uint32_t kOctets =
      cat240::kBlockSizes.back().octets * cat240::kBlockSizes.back().max_repetitions;
  return kOctets * 8 / bits_per_cell;
}

std::size_t begin_cat240_block(Bytes& out) { return asterix::begin_block(out, kCat240); }

void end_cat240_block(Bytes& out, std::size_t begun) { asterix::end_block(out, begun); }

void append_cat240_video_record(Bytes& out, const SpokeHeader& header,
                                std::span<const std::uint8_t> cells, const Cat240Options& options,
                                std::uint32_t message_index) {
  const std::uint32_t source_bits = header.geometry.bits;
  const std::uint32_t bits = options.bits.value_or(static_cast<std::uint8_t>(source_bits));
  const std::uint32_t start_range =
      std::min(options.start_range, static_cast<std::uint32_t>(cells.size()) - 1);
  cells = cells.subspan(start_range);
  cells = cells.first(std::min<std::size_t>(cells.size(), cat240_max_cells(bits)));
  const Header place = header_of(header, options.nanoseconds);

  Bytes deflated;
  if (options.compressed) {
    Bytes plain;
    cat240::append_cells(plain, cells, source_bits, bits);
    deflated = cat240::deflated(plain);
  }
  const std::size_t octets = options.compressed ? deflated.size() : (cells.size() * bits + 7) / 8;
  const cat240::BlockSize& block = block_for(octets, options.blocks);
  ItemSet items(Item::source, Item::message_type, Item::message_index,
                place.femto ? Item::header_femto : Item::header_nano, Item::resolution,
                Item::counters, block.item);
  if (options.time_of_day) items.add(Item::time_of_day);
  begin_record(out, items, options.source, Cat240Kind::video);
  append_big_endian(out, message_index, 4);
  append_big_endian(out, place.start_azimuth, 2);
  append_big_endian(out, place.end_azimuth, 2);
  append_big_endian(out, start_range, 4);
  append_big_endian(out, place.duration, 4);
  out.push_back(options.compressed ? cat240::kCompressed : 0);
  out.push_back(resolution_of(bits));
  append_big_endian(out, octets, 2);
  append_big_endian(out, cells.size(), 3);
  const std::size_t repetitions = (octets + block.octets - 1) / block.octets;
  append_big_endian(out, repetitions, 1);
  if (options.compressed) {
    out.insert(out.end(), deflated.begin(), deflated.end());
  } else {
    cat240::append_cells(out, cells, source_bits, bits);
  }
  out.insert(out.end(), repetitions * block.octets - octets, 0);
  if (options.time_of_day) asterix::write_time_of_day(out, asterix_time_of_day(header.utc));
}

void append_cat240_video(Bytes& out, const Spoke& spoke, Cat240Source source,
                         std::uint32_t message_index) {
  const std::size_t begun = begin_cat240_block(out);
  append_cat240_video_record(out, spoke.header, spoke.cells, {.source = source, .bits = {}},
                             message_index);
  end_cat240_block(out, begun);
}

Bytes encode_cat240_video(const Spoke& spoke, Cat240Source source, std::uint32_t message_index) {
  Bytes out;
  append_cat240_video(out, spoke, source, message_index);
  return out;
}

void append_cat240_summary(Bytes& out, std::string_view text, Cat240Source source, UtcTime utc) {
  text = text.substr(0, kCat240MaxSummary);
  const std::size_t start = begin_cat240_block(out);
  begin_record(out, ItemSet(Item::source, Item::message_type, Item::summary, Item::time_of_day),
               source, Cat240Kind::summary);
  append_big_endian(out, text.size(), 1);
  for (const char each : text) {
    out.push_back(static_cast<std::uint8_t>(each >= ' ' && each <= '~' ? each : '?'));
  }
  asterix::write_time_of_day(out, asterix_time_of_day(utc));
  end_cat240_block(out, start);
}

Bytes encode_cat240_summary(std::string_view text, Cat240Source source, UtcTime utc) {
  Bytes out;
  append_cat240_summary(out, text, source, utc);
  return out;
}

}  // namespace skerry
