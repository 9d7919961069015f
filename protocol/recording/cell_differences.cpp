#include "protocol/recording/cell_differences.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "protocol/recording/octet_lanes.hpp"

namespace skerry::recording {
namespace {

constexpr std::size_t kTile = 64;  // octets of a cache line

struct Rows {
  const std::uint8_t* octets;
  std::size_t count, width;
};

// The rows from i0 and columns from j0 on, at most kLanes of each.
void transpose_at(const Rows& rows, std::size_t i0, std::size_t j0, std::uint8_t* out) {
  const std::size_t height = std::min(rows.count - i0, kLanes);
  const std::size_t across = std::min(rows.width - j0, kLanes);
  const std::uint8_t* const from = rows.octets + i0 * rows.width + j0;
  std::uint8_t* const to = out + j0 * rows.count + i0;
  if (height < kLanes || across < kLanes) {
    for (std::size_t j = 0; j < across; ++j) {
      for (std::size_t i = 0; i < height; ++i) to[j * rows.count + i] = from[i * rows.width + j];
    }
    return;
  }
  std::array<Lanes, kLanes> square;
  for (std::size_t i = 0; i < kLanes; ++i) square[i] = load_lanes(from + i * rows.width);
  transpose_square(square);
  for (std::size_t j = 0; j < kLanes; ++j) store_lanes(square[j], to + j * rows.count);
}

// Rows become columns, tile by tile.
void transpose(const Rows& rows, std::uint8_t* out) {
  for (std::size_t i0 = 0; i0 < rows.count; i0 += kTile) {
    for (std::size_t j0 = 0; j0 < rows.width; j0 += kTile) {
      const std::size_t end = std::min(i0 + kTile, rows.count);
      const std::size_t end_across = std::min(j0 + kTile, rows.width);
      for (std::size_t j = j0; j < end_across; j += kLanes) {
        for (std::size_t i = i0; i < end; i += kLanes) transpose_at(rows, i, j, out);
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
// The same: a + b is low + high, and a c beyond one of them takes it away.
Lanes foretold(Lanes a, Lanes b, Lanes c) {
  const Lanes low = least(a, b), high = greatest(a, b);
  return low + high - least(greatest(c, low), high);
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

// Columns of differences that become octets, a tile of them at a time, and the column before them.
// Each octet needs the one above it, which makes one column slow: so sixteen go on together, each
// a row behind the one before it.  Rows before the first are 0; those behind the last are anything.
class ColumnTile {
 public:
  explicit ColumnTile(std::size_t count)
      : count_(count),
        stride_(2 * kLanes + (count + 2 * kLanes - 2) / kLanes * kLanes),
        octets_((kTile + 1) * stride_) {}

  // `width` columns at most kTile.
  void add_foretold(const std::uint8_t* differences, std::size_t width) {
    std::copy_n(column(kTile) - kLanes, stride_, column(0) - kLanes);
    for (std::size_t k = 0; k < width; ++k) {
      std::copy_n(differences + k * count_, count_, column(k + 1));
    }
    for (std::size_t k = 0; k < width; k += kLanes) add_foretold_to_strip(k + 1);
  }

  void put_rows(std::uint8_t* rows, std::size_t row_bytes, std::size_t width) {
    std::array<Lanes, kLanes> square;
    for (std::size_t i0 = 0; i0 < count_; i0 += kLanes) {
      const std::size_t height = std::min(count_ - i0, kLanes);
      for (std::size_t j0 = 0; j0 < width; j0 += kLanes) {
        for (std::size_t j = 0; j < kLanes; ++j) square[j] = load_lanes(column(j0 + j + 1) + i0);
        transpose_square(square);
        std::uint8_t* const to = rows + i0 * row_bytes + j0;
        const std::size_t across = std::min(width - j0, kLanes);
        for (std::size_t i = 0; i < height; ++i) {
          std::memcpy(to + i * row_bytes, &square[i], across);
        }
      }
    }
  }

 private:
  // Its first row; 0 is the column before the tile.
  std::uint8_t* column(std::size_t k) { return octets_.data() + k * stride_ + kLanes; }

  void add_foretold_to_strip(std::size_t first) {
    const std::uint8_t* const before = column(first - 1);
    std::array<Lanes, kLanes> square;
    Lanes up{}, up_before{};
    for (std::size_t step = 0; step < count_ + kLanes - 1; step += kLanes) {
      const auto place = [&](std::size_t k) { return column(first + k) + step - k; };
      for (std::size_t k = 0; k < kLanes; ++k) square[k] = load_lanes(place(k));
      transpose_square(square);
      for (std::size_t s = 0; s < kLanes; ++s) {
        const Lanes left = moved_on(up, load_lanes(before + step + s));
        up = square[s] + foretold(left, up, up_before);
        up_before = left;
        square[s] = up;
      }
      transpose_square(square);
      for (std::size_t k = 0; k < kLanes; ++k) store_lanes(square[k], place(k));
    }
  }

  std::size_t count_, stride_;
  Bytes octets_;
};

// A tile of more rows would be large: nobody writes so many, but a file may say so.
constexpr std::size_t kMostTileRows = 16'384;

void add_foretold_slowly(std::span<const std::uint8_t> differences, std::size_t count,
                         std::size_t width, std::uint8_t* rows) {
  const std::uint8_t* difference = differences.data();
  for (std::size_t j = 0; j < width; ++j) {
    std::uint8_t up = 0, up_before = 0;
    for (std::size_t i = 0; i < count; ++i) {
      const std::uint8_t left = j > 0 ? rows[i * width + j - 1] : std::uint8_t{0};
      up = static_cast<std::uint8_t>(*difference++ + foretold(left, up, up_before));
      up_before = left;
      rows[i * width + j] = up;
    }
  }
}

}  // namespace

void append_differences(std::span<const std::uint8_t> rows, std::size_t width, Bytes& out) {
  if (width == 0 || rows.empty()) return;
  const std::size_t count = rows.size() / width;
  const std::size_t begin = out.size();
  out.resize(begin + rows.size());
  Bytes columns((width + 1) * count);  // the first one is of zeros
  transpose(Rows{rows.data(), count, width}, columns.data() + count);
  for (std::size_t j = 0; j < width; ++j) {
    const std::uint8_t* const before = columns.data() + j * count;
    subtract_foretold(before + count, before, count, out.data() + begin + j * count);
  }
}

Bytes rows_of(std::span<const std::uint8_t> differences, std::size_t width) {
  Bytes rows(differences.size());
  if (width == 0 || rows.empty()) return rows;
  const std::size_t count = differences.size() / width;
  if (count > kMostTileRows) {
    add_foretold_slowly(differences, count, width, rows.data());
    return rows;
  }
  ColumnTile tile(count);
  for (std::size_t j = 0; j < width; j += kTile) {
    const std::size_t across = std::min(width - j, kTile);
    tile.add_foretold(differences.data() + j * count, across);
    tile.put_rows(rows.data() + j, width, across);
  }
  return rows;
}

}  // namespace skerry::recording
