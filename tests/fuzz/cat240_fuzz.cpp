// A reader of ASTERIX CAT240, and the way there and back of spokes made from the input.
#include <algorithm>

#include "protocol/asterix/cat240.hpp"
#include "tests/fuzz/fuzz_require.hpp"

namespace {

using namespace skerry;

bool same_video(const std::optional<Cat240Video>& a, const std::optional<Cat240Video>& b) {
  if (a.has_value() != b.has_value()) return false;
  return !a || (a->message_index == b->message_index && a->start_azimuth == b->start_azimuth &&
                a->cell_count == b->cell_count && a->cells == b->cells &&
                a->wide_cells == b->wide_cells && a->foreign == b->foreign);
}

void check_decoding(std::span<const std::uint8_t> input) {
  const auto records = decode_cat240(input);
  if (!records.ok()) {
    fuzz::require(!records.error().text.empty(), "a refusal says why");
    fuzz::require(records.error().offset <= input.size(), "a refusal's place is in the datagram");
    return;
  }
  std::size_t cells = 0, claimed = 0;  // what was made; octets that compressed cells are said to be
  for (const Cat240Record& record : *records) {
    const bool is_video = record.kind == Cat240Kind::video;
    fuzz::require(record.video.has_value() == is_video, "video has a picture");
    fuzz::require(record.summary.has_value() != is_video, "a summary has a text");
    if (!is_video) continue;
    const Cat240Video& video = *record.video;
    if (video.compressed) claimed += (std::size_t{video.cell_count} * video.bits_per_cell + 7) / 8;
    cells += video.cells.size() + 4 * video.wide_cells.size() + video.foreign.size();
    if (!video.foreign.empty()) {
      fuzz::require(video.compressed && video.cells.empty(), "octets nobody can read");
    } else if (video.cell_count > 0) {
      const bool narrow = video.bits_per_cell <= 8;
      fuzz::require((narrow ? video.cells.size() : video.wide_cells.size()) == video.cell_count,
                    "a number per cell");
    }
  }
  fuzz::require(cells <= 8 * input.size() + 8 * kCat240MaxInflated,
                "the output is bounded by the input");
  fuzz::require(records->size() <= input.size(), "so is the number of records");

  // Twice as much may be said to inflate to more than a datagram may, even what nobody can read.
  if (2 * input.size() > 65535 || 2 * claimed > kCat240MaxInflated) return;
  Bytes twice(input.begin(), input.end());
  twice.insert(twice.end(), input.begin(), input.end());
  const auto both = decode_cat240(twice);
  fuzz::require(both.ok() && both->size() == 2 * records->size(), "blocks stand on their own");
  for (std::size_t i = 0; i < records->size(); ++i) {
    fuzz::require(same_video((*both)[records->size() + i].video, (*records)[i].video),
                  "a block reads the same wherever it stands");
  }
}

// A spoke whose geometry, bearing and cells are the input's.
Spoke spoke_from(std::span<const std::uint8_t> input) {
  fuzz::Choices choices(input);
  Spoke spoke;
  ScanGeometry& geometry = spoke.header.geometry;
  geometry.spokes_per_turn = static_cast<std::uint32_t>(256 + choices.below(8192 - 256 + 1));
  geometry.cells = static_cast<std::uint32_t>(256 + choices.below(4096 - 256 + 1));
  geometry.bits = choices.below(2) == 0 ? 4 : 8;
  spoke.header.index = static_cast<std::uint32_t>(choices.below(geometry.spokes_per_turn));
  spoke.header.range_scale = *RangeScale::from_index(choices.below(RangeScale::kCount));
  spoke.header.heading =
      TrueBearing::from_units(static_cast<std::uint32_t>(choices.below(0x80000000) * 2));
  spoke.header.utc = UtcTime(Duration(static_cast<std::int64_t>(choices.below(1u << 31) << 30)));
  spoke.cells.resize(geometry.cells);
  for (std::size_t i = 0; i < spoke.cells.size(); ++i) {
    const std::uint8_t byte = input.empty() ? 0 : input[i % input.size()];
    spoke.cells[i] = static_cast<std::uint8_t>(geometry.bits == 4 ? byte & 0x0F : byte);
  }
  return spoke;
}

void check_round_trip(const Spoke& spoke) {
  const auto records = decode_cat240(encode_cat240_video(spoke, {1, 2}, spoke.header.index));
  fuzz::require(records.ok() && records->size() == 1, "our own video is read");
  const auto& video = records->front().video;
  fuzz::require(video.has_value() && video->cells == spoke.cells, "its cells come back the same");
  fuzz::require(video->message_index == spoke.header.index, "and so does its index");
  fuzz::require(records->front().time_of_day.has_value(), "and it has a time of day");
  const double ratio = video->cell_size() / spoke.header.cell_size();
  fuzz::require(ratio > 1 - 1.2e-4 && ratio < 1 + 1.2e-4, "its cells are of the same size");
}

// Any way of sending them: what comes back is what the spoke has on so many bits.
void check_variant(const Spoke& spoke, std::span<const std::uint8_t> input) {
  fuzz::Choices choices(input);
  Cat240Options options;
  options.bits = static_cast<std::uint8_t>(1u << choices.below(6));
  options.blocks = static_cast<Cat240Blocks>(choices.below(4));
  options.compressed = choices.below(2) == 1;
  options.nanoseconds = choices.below(2) == 1;
  options.time_of_day = choices.below(2) == 1;
  options.start_range = static_cast<std::uint32_t>(choices.below(5000));
  Bytes out;
  const std::size_t begun = begin_cat240_block(out);
  append_cat240_video_record(out, spoke.header, spoke.cells, options, 7);
  end_cat240_block(out, begun);
  const auto records = decode_cat240(out);
  fuzz::require(records.ok() && records->size() == 1, "every variant is read");
  const Cat240Video& video = *records->front().video;
  fuzz::require(video.start_range + video.cell_count == spoke.cells.size(), "all cells are there");
  for (std::uint32_t i = 0; i < video.cell_count; ++i) {
    const std::uint32_t cell = spoke.cells[video.start_range + i];
    const std::uint32_t eight = spoke.header.geometry.bits == 4 ? cell * 17 : cell;
    const std::uint32_t read =
        video.bits_per_cell <= 8 ? video.cells[i] : video.wide_cells[i] & 0xFF;
    fuzz::require(read == eight >> (8 - std::min<std::uint32_t>(video.bits_per_cell, 8)),
                  "and each has its video");
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  check_decoding({data, size});
  const Spoke spoke = spoke_from({data, size});
  check_round_trip(spoke);
  check_variant(spoke, {data, size});
  return 0;
}
