// Which items a record has (FSPEC), or which subfields a compound item: shared by the encoders and
// decoders, of no use elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>

#include "protocol/wire/wire_error.hpp"

namespace skerry::asterix {

// The last bit of an octet that says that another follows.
inline constexpr std::uint8_t kFieldExtension = 0x01;

// Octets of seven items each, the first item highest.  `Item`: field reference numbers (FRN) from 1
// to 7 * kMostOctets, a number or an enumeration.
// Source: EUROCONTROL-SPEC-0149 (part 1), 4.3: field specification.
template <typename Item>
class ItemSet {
 public:
  static constexpr std::size_t kMostOctets = 5;

  constexpr ItemSet() = default;
  template <typename... Items>
  explicit constexpr ItemSet(Items... items) : bits_((bit(items) | ...)) {}

  constexpr bool has(Item item) const { return (bits_ & bit(item)) != 0; }
  constexpr bool has_any(ItemSet other) const { return (bits_ & other.bits_) != 0; }
  constexpr bool has_all(ItemSet other) const { return (bits_ & other.bits_) == other.bits_; }
  constexpr void add(Item item) { bits_ |= bit(item); }

  // Octet `index`, from 0, without the bit that says that another follows.
  constexpr std::uint8_t octet(std::size_t index) const {
    return static_cast<std::uint8_t>((bits_ >> (kTop - 7 * index) & 0x7F) << 1);
  }
  constexpr void set_octet(std::size_t index, std::uint8_t octet) {
    bits_ |= std::uint64_t{octet} >> 1 << (kTop - 7 * index);
  }

  // As many octets as are needed, at least one.
  void append_to(Bytes& out) const {
    std::size_t last = kMostOctets - 1;
    while (last > 0 && octet(last) == 0) --last;
    for (std::size_t i = 0; i <= last; ++i) {
      out.push_back(static_cast<std::uint8_t>(octet(i) | (i < last ? kFieldExtension : 0)));
    }
  }

 private:
  static constexpr std::size_t kTop = 7 * (kMostOctets - 1);
  static constexpr std::uint64_t bit(Item item) {
    return std::uint64_t{1} << (7 * kMostOctets - static_cast<std::size_t>(item));
  }
  std::uint64_t bits_ = 0;
};

}  // namespace skerry::asterix
