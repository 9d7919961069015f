// Items of ASTERIX category 240 as they stand in a field specification (FSPEC): shared by the
// encoder and the decoder, of no use elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

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

// The items of one record: two FSPEC octets of seven items each.
class ItemSet {
 public:
  constexpr ItemSet() = default;
  template <typename... Items>
  explicit constexpr ItemSet(Items... items) : bits_((bit(items) | ...)) {}

  constexpr bool has(Item item) const { return (bits_ & bit(item)) != 0; }
  constexpr bool has_any(ItemSet other) const { return (bits_ & other.bits_) != 0; }
  constexpr bool has_all(ItemSet other) const { return (bits_ & other.bits_) == other.bits_; }
  constexpr void add(Item item) { bits_ |= bit(item); }
  // FSPEC octet 0 or 1 without its FX bit.
  constexpr std::uint8_t octet(std::size_t index) const {
    return static_cast<std::uint8_t>(bits_ >> (7 - 7 * index) << 1);
  }
  constexpr void set_octet(std::size_t index, std::uint8_t octet) {
    bits_ |= (octet >> 1) << (7 - 7 * index);
  }

 private:
  // FRN 1 is bit 13, FRN 14 bit 0.
  static constexpr std::uint32_t bit(Item item) {
    return 1u << (14 - static_cast<std::uint32_t>(item));
  }
  std::uint32_t bits_ = 0;
};

inline constexpr std::uint8_t kFieldExtension = 0x01;
inline constexpr std::size_t kBlockHeader = 3;  // CAT, LEN
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
inline constexpr std::uint32_t kTimeOfDayPerSecond = 128;
inline constexpr std::uint32_t kTimeOfDayPerDay = 86'400 * kTimeOfDayPerSecond;

}  // namespace skerry::cat240
