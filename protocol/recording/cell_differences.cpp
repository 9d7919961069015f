#include "protocol/recording/cell_differences.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace skerry::recording {
namespace {

constexpr std::size_t kTile = 64;  // octets of a cache line

// Rows of `width` octets become columns, tile by tile.  Rows of a power of two apart fall on few
// lines of the nearest cache: so each tile is copied first, to where they do not.
void transpose(const std::uint8_t* rows, std::size_t count, std::size_t width, std::uint8_t* out) {
  std::array<std::array<std::uint8_t, kTile + 1>, kTile> tile{};
  for (std::size_t i0 = 0; i0 < count; i0 += kTile) {
    for (std::size_t j0 = 0; j0 < width; j0 += kTile) {
      const std::size_t height = std::min(count - i0, kTile), across = std::min(width - j0, kTile);
      for (std::size_t i = 0; i < height; ++i) {
        std::memcpy(tile[i].data(), rows + (i0 + i) * width + j0, across);
      }
      for (std::size_t j = 0; j < across; ++j) {
        std::uint8_t* const column = out + (j0 + j) * count + i0;
        for (std::size_t i = 0; i < height; ++i) column[i] = tile[i][j];
      }
    }
  }
}

// The median of a, b and a + b - c.  Without a branch and in 16 bits, so that every processor takes
// many at once.
std::uint8_t foretold(std::int16_t a, std::int16_t b, std::int16_t c) {
  const std::int16_t low = std::min(a, b), high = std::max(a, b);
  const auto sum = static_cast<std::int16_t>(a + b - c);
  return static_cast<std::uint8_t>(std::max(low, std::min(high, sum)));
}

// `out` and the columns do not overlap.
void subtract_foretold(const std::uint8_t* __restrict column, const std::uint8_t* __restrict before,
                       std::size_t count, std::uint8_t* __restrict out) {
  out[0] = static_cast<std::uint8_t>(column[0] - before[0]);
  for (std::size_t i = 1; i < count; ++i) {
    out[i] =
        static_cast<std::uint8_t>(column[i] - foretold(before[i], column[i - 1], before[i - 1]));
  }
}

void add_foretold(std::uint8_t* column, const std::uint8_t* before, std::size_t i) {
  const std::uint8_t up = i > 0 ? column[i - 1] : 0, up_before = i > 0 ? before[i - 1] : 0;
  column[i] = static_cast<std::uint8_t>(column[i] + foretold(before[i], up, up_before));
}

constexpr std::size_t kAtOnce = 8;

// kAtOnce columns, one after the other in memory.  Each octet needs the one above it, which makes
// one column slow: so each column follows the one before it by a row, and all go on together.
void add_foretold_to_all(std::uint8_t* columns, const std::uint8_t* before, std::size_t count) {
  const auto column = [&](std::size_t k) { return columns + k * count; };
  const auto before_of = [&](std::size_t k) { return k > 0 ? column(k - 1) : before; };
  if (count < 2 * kAtOnce) {
    for (std::size_t k = 0; k < kAtOnce; ++k) {
      for (std::size_t i = 0; i < count; ++i) add_foretold(column(k), before_of(k), i);
    }
    return;
  }
  // The rows that are not of all columns' common run: column k begins k rows later ...
  for (std::size_t k = 0; k < kAtOnce; ++k) {
    for (std::size_t i = 0; i < kAtOnce - k; ++i) add_foretold(column(k), before_of(k), i);
  }
  std::array<std::uint8_t, kAtOnce> up{}, up_before{};
  for (std::size_t k = 0; k < kAtOnce; ++k) {
    up[k] = column(k)[kAtOnce - k - 1];
    up_before[k] = before_of(k)[kAtOnce - k - 1];
  }
  for (std::size_t s = kAtOnce; s < count; ++s) {
    for (std::size_t k = kAtOnce; k-- > 0;) {
      const std::uint8_t left = k > 0 ? up[k - 1] : before[s];
      std::uint8_t& octet = columns[k * count + s - k];
      octet = static_cast<std::uint8_t>(octet + foretold(left, up[k], up_before[k]));
      up_before[k] = left;
      up[k] = octet;
    }
  }
  // ... and ends as many later.
  for (std::size_t k = 1; k < kAtOnce; ++k) {
    for (std::size_t i = count - k; i < count; ++i) add_foretold(column(k), before_of(k), i);
  }
}

}  // namespace

void append_differences(std::span<const std::uint8_t> rows, std::size_t width, Bytes& out) {
  if (width == 0 || rows.empty()) return;
  const std::size_t count = rows.size() / width;
  const std::size_t begin = out.size();
  out.resize(begin + rows.size());
  Bytes columns((width + 1) * count);  // the first one is of zeros
  transpose(rows.data(), count, width, columns.data() + count);
  for (std::size_t j = 0; j < width; ++j) {
    const std::uint8_t* const before = columns.data() + j * count;
    subtract_foretold(before + count, before, count, out.data() + begin + j * count);
  }
}

Bytes rows_of(std::span<const std::uint8_t> differences, std::size_t width) {
  Bytes rows(differences.size());
  if (width == 0 || rows.empty()) return rows;
  const std::size_t count = differences.size() / width;
  Bytes columns(count);  // the first one is of zeros
  columns.insert(columns.end(), differences.begin(), differences.end());
  std::size_t j = 0;
  for (; j + kAtOnce <= width; j += kAtOnce) {
    std::uint8_t* const before = columns.data() + j * count;
    add_foretold_to_all(before + count, before, count);
  }
  for (; j < width; ++j) {
    std::uint8_t* const before = columns.data() + j * count;
    for (std::size_t i = 0; i < count; ++i) add_foretold(before + count, before, i);
  }
  transpose(columns.data() + count, width, count, rows.data());
  return rows;
}

}  // namespace skerry::recording
