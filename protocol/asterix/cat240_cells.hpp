// Cells of CAT240 video as octets, 1 to 32 bits each, plain or as a zlib stream: shared by the
// encoder and the decoder, of no use elsewhere.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "protocol/wire/wire_error.hpp"

namespace skerry::cat240 {

// The nearest cell in the highest bits: ASTERIX counts bits from the most significant.  `from_bits`
// is 4 (the low nibble of each counts) or 8, `bits` 1, 2, 4, 8, 16 or 32.  Fewer bits are the
// highest of the source's; more repeat them, so that the strongest stays the strongest.
void append_cells(Bytes& out, std::span<const std::uint8_t> cells, std::uint32_t from_bits,
                  std::uint32_t bits);

// RFC 1950, at the fastest level.
Bytes deflated(std::span<const std::uint8_t> octets);
// nullopt if it is no whole zlib stream, or does not inflate to exactly `length` octets.
std::optional<Bytes> inflated(std::span<const std::uint8_t> octets, std::size_t length);

// The opposite of append_cells() for `count` cells of at most 8 bits, a byte each; and for 16 or 32
// bits, a number each.  Require octets enough.
Bytes narrow_cells(std::span<const std::uint8_t> octets, std::uint32_t count, std::uint32_t bits);
std::vector<std::uint32_t> wide_cells(std::span<const std::uint8_t> octets, std::uint32_t count,
                                      std::uint32_t bits);

}  // namespace skerry::cat240
