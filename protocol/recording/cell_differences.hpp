// Differences of cells between neighbours in azimuth and range, which compress better than they do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "protocol/wire/wire_error.hpp"

namespace skerry::recording {

// `rows` (spokes) of `width` octets, one after the other, become as many octets: of each the
// difference (modulo 256) to what its neighbours foretell, all rows' of the first place first.
// Foretold from the octet before it in its row (a), the one above (b) and the one above a (c): the
// median of a, b and a + b - c.  Beyond the edges is 0.
// Source: Weinberger, Seroussi, Sapiro, LOCO-I, IEEE Trans. Image Processing 9 (2000).
void append_differences(std::span<const std::uint8_t> rows, std::size_t width, Bytes& out);
// The other way, exactly.  Requires differences.size() to be a multiple of `width`.
Bytes rows_of(std::span<const std::uint8_t> differences, std::size_t width);

}  // namespace skerry::recording
