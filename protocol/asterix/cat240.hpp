// ASTERIX category 240 (radar video), edition 1.3: what displays and recorders of other makers
// read. Source: EUROCONTROL-SPEC-0149-240.  SPEC.md says which items are sent and how.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "protocol/asterix/report_parts.hpp"
#include "protocol/quantity/result.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/video/spoke.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry {

inline constexpr std::uint8_t kCat240 = 240;
inline constexpr std::size_t kCat240MaxSummary = 255;  // characters: REP of item 030 is one octet

using Cat240Source = AsterixSource;

// Which of the three sizes of video block carries the cells: item 050, 051 or 052.
enum class Cat240Blocks : std::uint8_t {
  smallest,  // the first that can hold them
  low,       // up to 1020 octets of cells
  medium,    // up to 16,320
  high,      // up to 65,024
};

// Choices that the standard leaves to the sender.
struct Cat240Options {
  Cat240Source source;
  // Per cell: 1, 2, 4, 8, 16 or 32; nothing: as the spoke has them, 4 or 8.  Fewer than the spoke's
  // are its highest ones; with more, the strongest echo has all bits set.
  std::optional<std::uint8_t> bits;
  bool nanoseconds = false;  // cell duration in item 040; otherwise in 041, femtoseconds
  Cat240Blocks blocks = Cat240Blocks::smallest;  // a larger size where the cells need it
  bool compressed = false;                       // cells as a zlib stream (RFC 1950)
  bool time_of_day = true;                       // item 140
  std::uint32_t start_range = 0;                 // nearest cells that are left out
  friend bool operator==(const Cat240Options&, const Cat240Options&) = default;
};

// Cells that fit into one record with those options; more are cut off.
std::uint32_t cat240_max_cells(std::uint32_t bits_per_cell);

// One data block with one video record: the spoke at its true bearing.  `message_index` grows by
// one with every video message of a stream; receivers find losses by it.  Requires a valid geometry
// and geometry.cells cells; of a 4-bit cell only the low nibble counts.  Error: azimuths half of
// 360/65536 deg (0.003 deg); cell duration half a femtosecond, or half a nanosecond (at most 0.012
// % when a cell is longer than 643 m, the only ones sent so unless `nanoseconds`; then 0.5 ns of 2
// / c times the cell); time of day up to 1/128 s early.  Thread: any.
void append_cat240_video(Bytes& out, const Spoke& spoke, Cat240Source source,
                         std::uint32_t message_index);
Bytes encode_cat240_video(const Spoke& spoke, Cat240Source source, std::uint32_t message_index);

// Several records to one data block: begin, append records, end.  A block is at most 65,535 octets.
std::size_t begin_cat240_block(Bytes& out);
void end_cat240_block(Bytes& out, std::size_t begun);
// `header` may be of any number of spokes and cells; `cells` are header.geometry.cells of them.
void append_cat240_video_record(Bytes& out, const SpokeHeader& header,
                                std::span<const std::uint8_t> cells, const Cat240Options& options,
                                std::uint32_t message_index);

// One data block with one video summary record.  Text beyond kCat240MaxSummary is cut; characters
// outside printable ASCII become '?'.
void append_cat240_summary(Bytes& out, std::string_view text, Cat240Source source, UtcTime utc);
Bytes encode_cat240_summary(std::string_view text, Cat240Source source, UtcTime utc);

enum class Cat240Kind : std::uint8_t { summary = 1, video = 2 };

// The picture of a video record.
struct Cat240Video {
  std::uint32_t message_index = 0;  // item 020
  std::uint16_t start_azimuth = 0;  // LSB 360/65536 deg from true north
  std::uint16_t end_azimuth = 0;
  std::uint32_t start_range = 0;    // cells before the first
  std::uint32_t cell_duration = 0;  // femtoseconds, or nanoseconds
  bool in_nanoseconds = false;      // item 040 instead of 041
  bool compressed = false;          // as sent
  std::uint8_t bits_per_cell = 8;   // 1, 2, 4, 8, 16 or 32
  std::uint32_t cell_count = 0;     // valid cells
  // One byte per cell if there are at most 8 bits per cell.
  std::vector<std::uint8_t> cells;
  // One number per cell if there are 16 or 32.
  std::vector<std::uint32_t> wide_cells;
  // The valid octets as they stand, if they are compressed in another way than ours (zlib): what
  // that is, the standard leaves to an agreement.  Then there are neither cells nor wide_cells.
  std::vector<std::uint8_t> foreign;

  // From one cell to the next; the far end of cell n (from 1) lies at (start_range + n) of these.
  Length cell_size() const;
};

// One record as read.  `video` is there exactly if kind is video, `summary` if it is summary.
struct Cat240Record {
  using Video = Cat240Video;

  Cat240Kind kind = Cat240Kind::video;
  Cat240Source source;
  std::optional<std::string> summary;  // item 030
  std::optional<Cat240Video> video;
  std::optional<std::uint32_t> time_of_day;  // 1/128 s since midnight UTC, item 140
};

// Reads all records of one datagram: any number of data blocks, each of any number of records.
// Blocks of other categories are skipped, and so are the RE and SP items.
// Error: truncated, oversized (a datagram above 65,535 bytes), malformed, out_of_range or
// unknown_kind, with the byte offset; nothing is believed of a datagram that lies about a length.
// The result is at most a fixed multiple of the datagram's length; of compressed cells, at
// most kCat240MaxInflated octets a datagram.
inline constexpr std::size_t kCat240MaxInflated = 512 * 1024;
// Thread: any.
Result<std::vector<Cat240Record>, WireError> decode_cat240(std::span<const std::uint8_t> datagram);

}  // namespace skerry
