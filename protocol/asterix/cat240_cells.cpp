#include "protocol/asterix/cat240_cells.hpp"

#include <zlib.h>

#include "protocol/wire/byte_order.hpp"

namespace skerry::cat240 {
namespace {

// The cell's video on eight bits, whatever it came on.
inline std::uint32_t eight_bits(std::uint8_t cell, bool from_four) {
  return from_four ? (cell & 0x0Fu) * 0x11u : cell;
}

template <std::size_t Octets>
void append_wide(std::uint8_t* out, std::span<const std::uint8_t> cells, bool from_four) {
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const auto octet = static_cast<std::uint8_t>(eight_bits(cells[i], from_four));
    for (std::size_t k = 0; k < Octets; ++k) out[Octets * i + k] = octet;
  }
}

// `per_octet` cells to an octet, the first one highest.
template <unsigned Bits>
void append_narrow(std::uint8_t* out, std::span<const std::uint8_t> cells, bool from_four) {
  constexpr std::size_t kPerOctet = 8 / Bits;
  const std::size_t whole = cells.size() / kPerOctet;
  const auto pack = [&](std::size_t first, std::size_t count) {
    std::uint32_t octet = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint32_t top = eight_bits(cells[first + i], from_four) >> (8 - Bits);
      octet |= top << (8 - Bits * (i + 1));
    }
    return static_cast<std::uint8_t>(octet);
  };
  for (std::size_t o = 0; o < whole; ++o) out[o] = pack(o * kPerOctet, kPerOctet);
  if (const std::size_t rest = cells.size() % kPerOctet; rest != 0) {
    out[whole] = pack(whole * kPerOctet, rest);
  }
}

}  // namespace

void append_cells(Bytes& out, std::span<const std::uint8_t> cells, std::uint32_t from_bits,
                  std::uint32_t bits) {
  const bool from_four = from_bits == 4;
  if (bits == 8 && !from_four) {
    out.insert(out.end(), cells.begin(), cells.end());
    return;
  }
  const std::size_t start = out.size();
  out.resize(start + (cells.size() * bits + 7) / 8);
  std::uint8_t* const octets = out.data() + start;
  switch (bits) {
    case 1:
      return append_narrow<1>(octets, cells, from_four);
    case 2:
      return append_narrow<2>(octets, cells, from_four);
    case 4:
      return append_narrow<4>(octets, cells, from_four);
    case 8:
      return append_wide<1>(octets, cells, from_four);
    case 16:
      return append_wide<2>(octets, cells, from_four);
    default:
      return append_wide<4>(octets, cells, from_four);
  }
}

Bytes deflated(std::span<const std::uint8_t> octets) {
  uLongf length = compressBound(static_cast<uLong>(octets.size()));
  Bytes out(length);
  compress2(out.data(), &length, octets.data(), static_cast<uLong>(octets.size()), Z_BEST_SPEED);
  out.resize(length);
  return out;
}

std::optional<Bytes> inflated(std::span<const std::uint8_t> octets, std::size_t length) {
  Bytes out(length);
  auto given = static_cast<uLongf>(length);
  const int result =
      uncompress(out.data(), &given, octets.data(), static_cast<uLong>(octets.size()));
  if (result != Z_OK || given != length) return std::nullopt;
  return out;
}

Bytes narrow_cells(std::span<const std::uint8_t> octets, std::uint32_t count, std::uint32_t bits) {
  Bytes cells(count);
  const std::uint32_t per_octet = 8 / bits;
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t shift = 8 - bits * (i % per_octet + 1);
    cells[i] = static_cast<std::uint8_t>(octets[i / per_octet] >> shift & ((1u << bits) - 1));
  }
  return cells;
}

std::vector<std::uint32_t> wide_cells(std::span<const std::uint8_t> octets, std::uint32_t count,
                                      std::uint32_t bits) {
  std::vector<std::uint32_t> cells(count);
  const std::size_t width = bits / 8;
  for (std::uint32_t i = 0; i < count; ++i) {
    cells[i] = big_endian_at<std::uint32_t>(octets, i * width, width);
  }
  return cells;
}

}  // namespace skerry::cat240
