#include "protocol/recording/cell_differences.hpp"

#include <algorithm>

namespace skerry::recording {
namespace {

constexpr std::size_t kTile = 64;  // octets of a cache line

// Rows of `width` octets become columns, in tiles that stay in the nearest cache.
void transpose(const std::uint8_t* rows, std::size_t count, std::size_t width, std::uint8_t* out) {
  for (std::size_t i0 = 0; i0 < count; i0 += kTile) {
    for (std::size_t j0 = 0; j0 < width; j0 += kTile) {
      const std::size_t i1 = std::min(count, i0 + kTile), j1 = std::min(width, j0 + kTile);
      for (std::size_t j = j0; j < j1; ++j) {
        for (std::size_t i = i0; i < i1; ++i) out[j * count + i] = rows[i * width + j];
      }
    }
  }
}

// Without a branch, so that the compiler takes many at once.
std::uint8_t foretold(int a, int b, int c) {
  const int low = std::min(a, b), high = std::max(a, b);
  return static_cast<std::uint8_t>(std::max(low, std::min(high, a + b - c)));
}

}  // namespace

void append_differences(std::span<const std::uint8_t> rows, std::size_t width, Bytes& out) {
  if (width == 0 || rows.empty()) return;
  const std::size_t count = rows.size() / width;
  const std::size_t begin = out.size();
  out.resize(begin + rows.size());
  std::uint8_t* const columns = out.data() + begin;
  transpose(rows.data(), count, width, columns);
  // From the last column and row backwards: what is foretold from is still what it was.
  for (std::size_t j = width; j-- > 0;) {
    std::uint8_t* const column = columns + j * count;
    const std::uint8_t* const before = j > 0 ? column - count : nullptr;
    if (before == nullptr) {
      for (std::size_t i = count; i-- > 1;)
        column[i] = static_cast<std::uint8_t>(column[i] - column[i - 1]);
      continue;
    }
    for (std::size_t i = count; i-- > 1;) {
      column[i] =
          static_cast<std::uint8_t>(column[i] - foretold(before[i], column[i - 1], before[i - 1]));
    }
    column[0] = static_cast<std::uint8_t>(column[0] - before[0]);
  }
}

Bytes rows_of(std::span<const std::uint8_t> differences, std::size_t width) {
  Bytes rows(differences.size());
  if (width == 0 || rows.empty()) return rows;
  const std::size_t count = differences.size() / width;
  Bytes columns(differences.begin(), differences.end());
  for (std::size_t j = 0; j < width; ++j) {
    std::uint8_t* const column = columns.data() + j * count;
    const std::uint8_t* const before = j > 0 ? column - count : nullptr;
    if (before == nullptr) {
      for (std::size_t i = 1; i < count; ++i)
        column[i] = static_cast<std::uint8_t>(column[i] + column[i - 1]);
      continue;
    }
    column[0] = static_cast<std::uint8_t>(column[0] + before[0]);
    for (std::size_t i = 1; i < count; ++i) {
      column[i] =
          static_cast<std::uint8_t>(column[i] + foretold(before[i], column[i - 1], before[i - 1]));
    }
  }
  transpose(columns.data(), width, count, rows.data());
  return rows;
}

}  // namespace skerry::recording
