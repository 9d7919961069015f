// Every way in which a CAT240 record can be sent, and what must then stand in it, found by other
// means than the encoder's.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/asterix/cat240.hpp"
#include "protocol/video/spoke.hpp"

namespace skerry {

inline std::vector<Cat240Options> every_cat240_variant() {
  std::vector<Cat240Options> all;
  for (const unsigned bits : {1u, 2u, 4u, 8u, 16u, 32u}) {
    for (const Cat240Blocks blocks :
         {Cat240Blocks::smallest, Cat240Blocks::low, Cat240Blocks::medium, Cat240Blocks::high}) {
      for (unsigned flags = 0; flags < 16; ++flags) {
        Cat240Options options;
        options.source = {25, 7};
        options.bits = static_cast<std::uint8_t>(bits);
        options.blocks = blocks;
        options.nanoseconds = (flags & 1) != 0;
        options.compressed = (flags & 2) != 0;
        options.time_of_day = (flags & 4) != 0;
        options.start_range = (flags & 8) != 0 ? 100 : 0;
        all.push_back(options);
      }
    }
  }
  return all;
}

// A cell's number on `bits` bits: the highest of its eight, or the eight over and over.
inline std::uint32_t cell_on(std::uint8_t cell, unsigned bits) {
  std::uint32_t value = 0;
  for (unsigned bit = 0; bit < bits; ++bit) {
    value = value << 1 | (cell >> (7 - bit % 8) & 1u);
  }
  return value;
}

// The octets of the uncompressed cells of an 8-bit spoke, written bit by bit.
inline Bytes octets_bit_by_bit(const Spoke& spoke, const Cat240Options& options) {
  Bytes octets;
  std::size_t bit = 0;
  for (std::size_t i = options.start_range; i < spoke.cells.size(); ++i) {
    const std::uint32_t value = cell_on(spoke.cells[i], *options.bits);
    for (unsigned b = *options.bits; b-- > 0; ++bit) {
      if (bit % 8 == 0) octets.push_back(0);
      octets.back() = static_cast<std::uint8_t>(octets.back() | (value >> b & 1u) << (7 - bit % 8));
    }
  }
  return octets;
}

}  // namespace skerry
