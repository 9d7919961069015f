// Items of ASTERIX category 240 as they stand in a field specification (FSPEC): shared by the
// encoder and the decoder, of no use elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "protocol/asterix/item_set.hpp"

namespace skerry::cat240 {

// Field reference numbers, in the order the items stand in a record.
enum class Item : std::uint8_t {
  source = 1,         // 010
  message_type = 2,   // 000
  message_index = 3,  // 020
  summary = 4,        // 030
  header_nano = 5,    // 040
  header_femto = 6,   // 041
  resolution = 7,     // 048
  counters = 8,       // 049
  block_low = 9,      // 050
  block_medium = 10,  // 051
  block_high = 11,    // 052
  time_of_day = 12,   // 140
  reserved = 13,      // RE
  special = 14,       // SP
};

using ItemSet = asterix::ItemSet<Item>;

inline constexpr std::size_t kFieldSpecification = 2;  // octets of the longest
inline constexpr std::uint8_t kCompressed = 0x80;

// The three sizes of video block.  The length of an item is one octet REP, then REP blocks.
struct BlockSize {
  Item item;
  std::size_t octets;
  std::size_t max_repetitions;  // of 052: more would exceed the 65,535 octets of a data block
};
inline constexpr std::array<BlockSize, 3> kBlockSizes = {
    {{Item::block_low, 4, 255}, {Item::block_medium, 64, 255}, {Item::block_high, 256, 254}}};

inline constexpr double kSpeedOfLight = 299'792'458.0;  // m/s, exact (SI)

}  // namespace skerry::cat240
