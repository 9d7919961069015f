#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "protocol/asterix/cat240.hpp"
#include "protocol/asterix/cat240_cells.hpp"
#include "protocol/asterix/cat240_items.hpp"
#include "protocol/asterix/item_reader.hpp"
#include "protocol/wire/byte_order.hpp"

namespace skerry {
namespace {

using cat240::Item;
using cat240::ItemSet;

constexpr ItemSet kVideoItems(Item::message_index, Item::header_nano, Item::header_femto,
                              Item::resolution, Item::counters, Item::block_low, Item::block_medium,
                              Item::block_high);

// Reads one record from a data block.  Every function that can fail returns whether it did not, and
// leaves why in error().
class RecordReader {
 public:
  // `inflation_left`: octets that compressed cells of the datagram may still come to.
  RecordReader(ByteReader& in, std::size_t block_offset, std::size_t& inflation_left)
      : in_(in), reader_(in, block_offset, "CAT240"), inflation_left_(inflation_left) {}

  bool read(Cat240Record& record);
  const WireError& error() const { return reader_.error(); }

 private:
  bool fail(WireErrorKind kind, const std::string& text) { return reader_.fail(kind, text); }
  bool whole(const char* item) { return reader_.whole(item); }

  bool read_kind(Cat240Record& record);
  void read_video_header(Cat240Video& video, Item item);
  bool read_resolution(Cat240Video& video);
  bool read_blocks(Cat240Video& video);
  bool skip_explicit_length(const char* item);

  ByteReader& in_;
  asterix::ItemReader reader_;
  std::size_t& inflation_left_;
  ItemSet items_;
};

bool RecordReader::read_kind(Cat240Record& record) {
  if (!items_.has_all(ItemSet(Item::source, Item::message_type))) {
    return fail(WireErrorKind::malformed, "record without item 010 or 000");
  }
  record.source.sac = in_.octet();
  record.source.sic = in_.octet();
  const std::uint8_t kind = in_.octet();
  if (!whole("010 or 000")) return false;
  if (kind == static_cast<std::uint8_t>(Cat240Kind::summary)) {
    record.kind = Cat240Kind::summary;
    return (items_.has(Item::summary) && !items_.has_any(kVideoItems)) ||
           fail(WireErrorKind::malformed, "summary without item 030, or with an item of video");
  }
  if (kind != static_cast<std::uint8_t>(Cat240Kind::video)) {
    return fail(WireErrorKind::unknown_kind,
                fmt::format("message type {}, expected 1 (summary) or 2 (video)", kind));
  }
  record.kind = Cat240Kind::video;
  if (!items_.has_all(ItemSet(Item::message_index, Item::resolution, Item::counters)) ||
      items_.has(Item::summary)) {
    return fail(WireErrorKind::malformed, "video without items 020, 048 and 049, or with 030");
  }
  const bool nano = items_.has(Item::header_nano), femto = items_.has(Item::header_femto);
  const int blocks =
      items_.has(Item::block_low) + items_.has(Item::block_medium) + items_.has(Item::block_high);
  return (nano != femto && blocks == 1) ||
         fail(WireErrorKind::malformed,
              "video must have one of items 040 and 041 and one of items 050, 051 and 052");
}

void RecordReader::read_video_header(Cat240Video& video, Item item) {
  video.start_azimuth = in_.big_endian<std::uint16_t>();
  video.end_azimuth = in_.big_endian<std::uint16_t>();
  video.start_range = in_.big_endian<std::uint32_t>();
  video.cell_duration = in_.big_endian<std::uint32_t>();
  video.in_nanoseconds = item == Item::header_nano;
}

bool RecordReader::read_resolution(Cat240Video& video) {
  video.compressed = (in_.octet() & cat240::kCompressed) != 0;
  const std::uint8_t resolution = in_.octet();
  if (!whole("048")) return false;
  if (resolution < 1 || resolution > 6) {
    return fail(WireErrorKind::out_of_range,
                fmt::format("resolution {} in item 048, expected 1 .. 6", resolution));
  }
  video.bits_per_cell = static_cast<std::uint8_t>(1u << (resolution - 1));
  return true;
}

bool RecordReader::read_blocks(Cat240Video& video) {
  const auto valid_octets = in_.big_endian<std::uint16_t>();
  video.cell_count = in_.big_endian<std::uint32_t>(3);
  std::span<const std::uint8_t> octets;
  for (const cat240::BlockSize& size : cat240::kBlockSizes) {
    if (items_.has(size.item)) octets = in_.take(in_.octet() * size.octets);
  }
  if (!whole("049 or the video block")) return false;
  const std::uint64_t cell_octets = (std::uint64_t{video.cell_count} * video.bits_per_cell + 7) / 8;
  const std::uint64_t least =
      video.compressed ? std::min<std::uint64_t>(cell_octets, 1) : cell_octets;
  if (valid_octets > octets.size() || valid_octets < least) {
    return fail(WireErrorKind::malformed,
                fmt::format("item 049 says {} cells of {} bits in {} octets, the video block has "
                            "{} octets",
                            video.cell_count, video.bits_per_cell, valid_octets, octets.size()));
  }
  octets = octets.first(valid_octets);
  Bytes plain;
  if (video.compressed) {
    if (cell_octets > inflation_left_) {
      return fail(WireErrorKind::oversized,
                  fmt::format("compressed cells of {} octets, expected at most {} in a datagram",
                              cell_octets, kCat240MaxInflated));
    }
    inflation_left_ -= static_cast<std::size_t>(cell_octets);
    auto inflated = cat240::inflated(octets, static_cast<std::size_t>(cell_octets));
    if (!inflated) {
      video.foreign.assign(octets.begin(), octets.end());
      return true;
    }
    plain = std::move(*inflated);
    octets = plain;
  }
  if (video.bits_per_cell <= 8) {
    video.cells = cat240::narrow_cells(octets, video.cell_count, video.bits_per_cell);
  } else {
    video.wide_cells = cat240::wide_cells(octets, video.cell_count, video.bits_per_cell);
  }
  return true;
}

bool RecordReader::skip_explicit_length(const char* item) {
  asterix::ItemOctets octets;
  return reader_.read(octets, asterix::lengthy(), item);
}

bool RecordReader::read(Cat240Record& record) {
  if (!reader_.read(items_, cat240::kFieldSpecification) || !read_kind(record)) return false;
  if (record.kind == Cat240Kind::summary) {
    const auto text = in_.take(in_.octet());
    if (!whole("030")) return false;
    record.summary.emplace(text.begin(), text.end());
  } else {
    Cat240Video& video = record.video.emplace();
    video.message_index = in_.big_endian<std::uint32_t>();
    read_video_header(video,
                      items_.has(Item::header_nano) ? Item::header_nano : Item::header_femto);
    if (!whole("020, 040 or 041") || !read_resolution(video) || !read_blocks(video)) return false;
  }
  if (items_.has(Item::time_of_day)) {
    record.time_of_day = in_.big_endian<std::uint32_t>(3);
    if (!whole("140")) return false;
    if (*record.time_of_day >= asterix::kTimeOfDayPerDay) {
      return fail(WireErrorKind::out_of_range,
                  fmt::format("time of day {} in item 140, expected less than {}",
                              *record.time_of_day, asterix::kTimeOfDayPerDay));
    }
  }
  return (!items_.has(Item::reserved) || skip_explicit_length("RE")) &&
         (!items_.has(Item::special) || skip_explicit_length("SP"));
}

}  // namespace

Length Cat240Video::cell_size() const {
  const double seconds = cell_duration * (in_nanoseconds ? 1e-9 : 1e-15);
  return metres(seconds * cat240::kSpeedOfLight / 2.0);
}

Result<std::vector<Cat240Record>, WireError> decode_cat240(std::span<const std::uint8_t> datagram) {
  std::vector<Cat240Record> records;
  std::size_t inflation_left = kCat240MaxInflated;
  const auto error = asterix::for_each_block(
      datagram, kCat240, "CAT240",
      [&](ByteReader& block, std::size_t offset) -> std::optional<WireError> {
        while (block.left() > 0) {
          RecordReader reader(block, offset, inflation_left);
          if (!reader.read(records.emplace_back())) return reader.error();
        }
        return std::nullopt;
      });
  if (error) return Failure{*error};
  return records;
}

}  // namespace skerry
