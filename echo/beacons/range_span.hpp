// A stretch of range in cells.
#pragma once

#include <algorithm>
#include <span>

namespace skerry::echo {

// Adds `value` to the cells from `from` to `to` (in cells from the antenna), to those covered in
// part in that proportion.  What is shorter than a cell counts as a cell long, from its beginning,
// as a pulse does (pulse_stretch.hpp).  Anything off the row is left out.
inline void add_span(double from, double to, float value, std::span<float> power) {
  const auto cells = static_cast<double>(power.size());
  to = std::min(std::max(to, from + 1.0), cells);
  from = std::max(from, 0.0);
  if (!(from < to)) return;
  const auto first = static_cast<std::size_t>(from);
  const auto last = static_cast<std::size_t>(to);  // the cell `to` ends in
  if (first == last) {
    power[first] += value * static_cast<float>(to - from);
    return;
  }
  power[first] += value * static_cast<float>(static_cast<double>(first + 1) - from);
  for (std::size_t i = first + 1; i < last; ++i) power[i] += value;
  if (last < power.size())
    power[last] += value * static_cast<float>(to - static_cast<double>(last));
}

}  // namespace skerry::echo
