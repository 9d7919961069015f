// Which cells of which rows a spoke is, when the rows were made from another place.
#pragma once

#include <cmath>
#include <cstdint>

#include "echo/kernel/exact_math.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// The greatest whole number that is not above x, |x| < 2^31.
inline std::int32_t whole_cells(double x) {
  const auto whole = static_cast<std::int32_t>(x);
  return whole - static_cast<std::int32_t>(static_cast<double>(whole) > x);
}

// Cells first .. last - 1 of a spoke: cell i lies at i + shift of that row.
struct RowPart {
  std::uint32_t row = 0;
  std::uint32_t first = 0, last = 0;
  double shift = 0.0;
};

// The same of whatever bearing, near the one it was laid for: `off` is how far the row lies to the
// right of it, rows.
struct PlacedPart {
  std::uint32_t first = 0, last = 0;
  double off = 0.0, shift = 0.0;

  RowPart at(std::uint32_t bearing_units, std::uint32_t rows) const {
    const double row = static_cast<double>(bearing_units) * (static_cast<double>(rows) * 0x1p-32) +
                       0.5 + off + static_cast<double>(rows);
    return {static_cast<std::uint32_t>(static_cast<std::int64_t>(row)) & (rows - 1), first, last,
            shift};
  }
};

// Rows as they were made, and where the antenna is now.
struct MovedView {
  PlanePoint moved;           // the antenna now, from where the rows were made
  std::uint32_t rows = 4096;  // a power of two
  double cell_m = 1.0;
};

// A place at range R and bearing b of the antenna now, was seen from where the rows were made at
// range |moved + R u(b)|, at a bearing that is off by atan(across / (R + ahead)).  So each part of
// a spoke has one row, the farther out the longer.  Ranges shift by fractions of a cell. Error:
// kMostOff rows in bearing, or what bearing changes by over half of kLeastPart cells, the larger;
// in range what it shifts by over half a part, a hundredth of the way across.  Not so within twice
// the way across, where parts turn by less than they should.  Held by
// MovedRows.FindEachPlaceWhereItWasSeen.
inline constexpr double kPartRows = 2.4;                   // bearing changes by within a part
inline constexpr double kMostOff = 0.5 * kPartRows + 0.5;  // rows
inline constexpr double kLeastPart = 2.0;                  // cells

// Parts laid for a bearing serve others as far off as this, radians: what is seen shifts by as much
// of the way moved, and turns by as much of its share in the range.
inline constexpr double kPartsServe = 0.0035;

// Calls visit(PlacedPart) for cells from the one that holds `from_m` to `cells`, nearest first.
template <typename Visit>
void lay_parts(const MovedView& view, std::uint32_t bearing_units, double from_m,
               std::uint32_t cells, Visit&& visit) {
  const double rows_per_unit = static_cast<double>(view.rows) * 0x1p-32;
  const double rows_per_radian = kUnitsPerRadian * rows_per_unit;
  const SinCos u = sin_cos_units(bearing_units);
  const double ahead = ahead_of(u, view.moved);
  const double right = right_of(u, view.moved);
  const double across = std::fabs(right), across2 = right * right;
  const double side = right > 0.0 ? rows_per_radian : -rows_per_radian;
  const double per_cell = 1.0 / view.cell_m;
  // tan(x) of a part's turn, of atan(x) in rows.
  const double step = kPartRows / rows_per_radian;
  const double turn = step * (1.0 + step * step * (1.0 / 3.0));
  const auto larger = [](double a, double b) { return a > b ? a : b; };
  const auto rows_off = [&](double x) {
    const double x2 = x * x;
    return side * x * (1.0 - x2 * (1.0 / 3.0 - x2 * (1.0 / 5.0 - x2 * (1.0 / 7.0))));
  };
  const double least_along = 2.0 * across + view.cell_m;
  const double end = static_cast<double>(cells) * view.cell_m;
  auto cell = static_cast<std::uint32_t>(from_m > 0.0 ? from_m * per_cell : 0.0);
  double range = static_cast<double>(cell) * view.cell_m;
  while (cell < cells) {
    const double along = larger(range + ahead, least_along);
    // Farther out by so much turn; never where there is less left than that.
    const double left = across - along * turn;
    double next = end;
    if (left > 0.0) {
      next = (along + across * turn) * across / left - ahead;
      next = larger(next < end ? next : end, range + kLeastPart * view.cell_m);
    }
    std::uint32_t last = static_cast<std::uint32_t>(next * per_cell + 0.5);
    if (last > cells) last = cells;
    const double middle = 0.5 * static_cast<double>(cell + last) * view.cell_m;
    const double next_along = larger(next + ahead, least_along);
    // At the mean of the ends' tangents.
    const double off = rows_off(0.5 * across * (along + next_along) / (along * next_along));
    const double over = middle + ahead;
    const double seen = std::sqrt(over * over + across2);
    visit(PlacedPart{cell, last, off, (seen - middle) * per_cell});
    cell = last;
    range = next;
  }
}

template <typename Visit>
void for_each_part(const MovedView& view, std::uint32_t bearing_units, double from_m,
                   std::uint32_t cells, Visit&& visit) {
  lay_parts(view, bearing_units, from_m, cells,
            [&](const PlacedPart& part) { visit(part.at(bearing_units, view.rows)); });
}

}  // namespace skerry::echo
