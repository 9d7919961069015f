// Data blocks, and items of which a record may have some: shared by the encoders, of no use
// elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>

#include "protocol/asterix/item_set.hpp"
#include "protocol/wire/wire_error.hpp"

namespace skerry::asterix {

// CAT and LEN; returns where the block begins.  A block is at most 65,535 octets.
std::size_t begin_block(Bytes& out, std::uint8_t category);
void end_block(Bytes& out, std::size_t begun);

// Octets that say which of some parts there are, and these: a record with its FSPEC, or a compound
// item.
class PartWriter {
 public:
  // Part `number`, from 1; nothing if it has no octets.  Parts come in the order of their numbers.
  void add(std::size_t number, const Bytes& part) {
    if (part.empty()) return;
    there_.add(number);
    octets_.insert(octets_.end(), part.begin(), part.end());
  }
  bool is_empty() const { return octets_.empty(); }
  void append_to(Bytes& out) const {
    there_.append_to(out);
    out.insert(out.end(), octets_.begin(), octets_.end());
  }

 private:
  ItemSet<std::size_t> there_;
  Bytes octets_ = {};
};

// An item of octets that each say whether another follows: as few as hold all that is not 0, at
// least one.  The last bit of each counts as 0.
void append_extended(Bytes& out, std::initializer_list<unsigned> octets);

}  // namespace skerry::asterix
