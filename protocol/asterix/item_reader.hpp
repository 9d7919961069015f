// Items out of the data blocks of a datagram, with every bound checked: shared by the decoders, of
// no use elsewhere.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "protocol/asterix/item_set.hpp"
#include "protocol/wire/byte_order.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::asterix {

inline constexpr std::size_t kBlockHeader = 3;  // CAT, LEN
inline constexpr std::uint32_t kTimeOfDayPerSecond = 128;
inline constexpr std::uint32_t kTimeOfDayPerDay = 86'400 * kTimeOfDayPerSecond;

// How long an item is.
struct Shape {
  enum class Kind : std::uint8_t {
    unknown,   // a spare number: no edition says
    fixed,     // `octets`
    extended,  // `octets` again and again while the last bit of the last one is set
    repeated,  // an octet that says how often `octets` come
    compound,  // octets that say which of `parts` come, and these
    lengthy,   // an octet that says how many come, itself included: RE and SP
  };
  Kind kind = Kind::unknown;
  std::uint8_t octets = 0;
  std::span<const Shape> parts = {};
};
constexpr Shape fixed(std::uint8_t octets) { return {Shape::Kind::fixed, octets, {}}; }
constexpr Shape extended(std::uint8_t octets = 1) { return {Shape::Kind::extended, octets, {}}; }
constexpr Shape repeated(std::uint8_t octets) { return {Shape::Kind::repeated, octets, {}}; }
constexpr Shape compound(std::span<const Shape> parts) { return {Shape::Kind::compound, 0, parts}; }
constexpr Shape lengthy() { return {Shape::Kind::lengthy, 0, {}}; }

// The octets of one item, views into the datagram.
struct ItemOctets {
  std::span<const std::uint8_t> octets = {};  // all of them
  // Of a compound item each subfield, by its number from 0; none if it is not there.
  std::array<std::span<const std::uint8_t>, 7 * ItemSet<unsigned>::kMostOctets> parts = {};

  // Octet `index` of an extended item, 0 if it does not reach so far.
  std::uint8_t octet(std::size_t index) const {
    return index < octets.size() ? octets[index] : std::uint8_t{0};
  }
};

// Reads items from one data block.  Every function that can fail returns whether it did not, and
// leaves why in error().
class ItemReader {
 public:
  // `category`: "CAT048".  `in` and `category` must outlive the reader.
  ItemReader(ByteReader& in, std::size_t block_offset, std::string_view category)
      : in_(in), block_offset_(block_offset), category_(category) {}

  ByteReader& in() { return in_; }
  const WireError& error() const { return error_; }

  bool fail(WireErrorKind kind, const std::string& text);
  // Whether the block did not end before the end of `item`.
  bool whole(std::string_view item);
  // A field specification of `octets` octets at most; more may follow that name nothing.
  template <typename Item>
  bool read(ItemSet<Item>& items, std::size_t octets, std::string_view what = "FSPEC") {
    std::uint8_t octet = kFieldExtension;
    for (std::size_t index = 0; (octet & kFieldExtension) != 0; ++index) {
      octet = in_.octet();
      if (!whole(what)) return false;
      if (index < octets) {
        items.set_octet(index, octet);
      } else if ((octet & ~kFieldExtension) != 0) {
        return fail_beyond(what, index, 7 * octets);
      }
    }
    return true;
  }
  bool read(ItemOctets& item, const Shape& shape, std::string_view name);

 private:
  bool fail_beyond(std::string_view what, std::size_t index, std::size_t most);
  bool skip(const Shape& shape, std::string_view name);
  bool read_parts(ItemOctets& item, std::span<const Shape> parts, std::string_view name);

  ByteReader& in_;
  std::size_t block_offset_;
  std::string_view category_;
  WireError error_ = {};
};

// Hands the inside of each data block of `category` to `read`, with its offset in the datagram;
// blocks of others are passed over.  Error: that of `read`, which ends it; truncated, malformed or
// oversized where the datagram lies about a length.
std::optional<WireError> for_each_block(
    std::span<const std::uint8_t> datagram, std::uint8_t category, std::string_view name,
    const std::function<std::optional<WireError>(ByteReader& block, std::size_t offset)>& read);

}  // namespace skerry::asterix
