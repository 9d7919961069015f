// A turn of rows of power, each packed to the stretches that echo.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/kernel/moved_row.hpp"
#include "echo/returns/moved_rows.hpp"

namespace skerry::echo {

// Memory: two bytes for each cell between the ends of a row's echoes; stretches kGap cells and more
// apart are kept on their own.  Thread: pack() of different rows at once; everything else one at a
// time; reading any, between changes.
class PackedRows {
 public:
  // Sets the number of rows; none is made then.
  void reset(std::uint32_t rows);

  bool made(std::uint32_t row) const { return rows_[row].made; }
  std::uint32_t made_count() const { return made_; }

  // Packs the power of cells first, first + 1, ... into `cells`, and notes where the row's
  // stretches lie there. Power below kLeast is dropped; none at all is a row without echoes.
  // Requires first to be a multiple of kPackBlock.
  void pack(std::uint32_t row, std::uint32_t first, std::span<const float> power,
            std::vector<PackedPower>& cells);
  // Takes a copy of what pack() made of the row, which is made then.
  void keep(std::uint32_t row, std::span<const PackedPower> cells);

  // Appends the echoes of cells part.first .. part.last - 1 of a spoke, from where they lie in the
  // part's row. The row was seen from another range: its power is scaled by the cube of range, on a
  // straight line between the ends of each stretch.
  void find(const RowPart& part, std::vector<MovedRun>& runs) const;

  // Fetches what find() first looks at of a row.
  void fetch(std::uint32_t row) const {
    __builtin_prefetch(&rows_[row]);
    __builtin_prefetch(reinterpret_cast<const char*>(&rows_[row] + 1) - 1);
  }

  std::size_t bytes() const;

 private:
  struct Stretch {
    std::uint16_t first = 0, last = 0;  // cells first .. last - 1
    std::uint32_t at = 0;               // in the row's cells, of the zero before cell `first`
  };
  struct Row {
    static constexpr std::size_t kMostStretches = 8;  // more are joined to the last
    bool made = false;
    std::uint8_t count = 0;
    const PackedPower* cells = nullptr;
    std::array<Stretch, kMostStretches> stretches;
  };
  static constexpr std::uint32_t kGap = 48;
  // Power over noise: 0.001 dB of the noise it stands in.
  static constexpr float kLeast = 2e-4f;
  // Cells are given out from blocks, and taken back all at once by reset().
  static constexpr std::size_t kBlock = 1u << 17;

  PackedPower* take(std::size_t count);

  std::vector<Row> rows_;
  std::uint32_t made_ = 0;
  std::vector<std::unique_ptr<PackedPower[]>> blocks_;
  std::size_t block_ = 0, used_ = 0;
};

}  // namespace skerry::echo
