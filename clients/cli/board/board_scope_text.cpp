#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "clients/cli/board/board_scope.hpp"
#include "clients/cli/board/board_words.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::client {
namespace {

constexpr int kLabelColumns = 6;  // "65535 "
constexpr int kDotColumns = 2, kDotRows = 4;

// Dots of braille characters.
class DotPlane {
 public:
  DotPlane(int columns, int rows) : columns_(columns), cells_(std::size_t(columns) * rows) {}

  // From the top left corner.
  void set(int x, int y) {
    static constexpr std::uint8_t kBits[kDotRows][kDotColumns] = {
        {0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    cells_[std::size_t(y / kDotRows) * columns_ + x / kDotColumns] |=
        kBits[y % kDotRows][x % kDotColumns];
  }

  std::string row(int row) const {
    std::string text;
    for (int column = 0; column < columns_; ++column) {
      const std::uint8_t dots = cells_[std::size_t(row) * columns_ + column];
      // U+2800 + dots.
      text += '\xe2';
      text += static_cast<char>(0xa0 | (dots >> 6));
      text += static_cast<char>(0x80 | (dots & 0x3f));
    }
    return text;
  }

 private:
  int columns_;
  std::vector<std::uint8_t> cells_;
};

std::string panel(const board::Sweep& sweep, std::size_t channel, const ScopeWindow& window,
                  int columns, int rows) {
  const std::uint32_t top = board::largest_code(sweep.meta.channels[channel]);
  const int dots = rows * kDotRows;
  // The row of dots of a code, from the top.
  const auto dot_of = [&](std::uint32_t code) {
    const auto up =
        std::min<std::uint64_t>(static_cast<std::uint64_t>(code) *
                                    static_cast<std::uint64_t>(dots) / (std::uint64_t{top} + 1),
                                static_cast<std::uint64_t>(dots - 1));
    return dots - 1 - static_cast<int>(up);
  };
  DotPlane plane(columns, rows);
  const auto trace =
      columns_of(sweep, channel, window, static_cast<std::size_t>(columns) * kDotColumns);
  for (std::size_t x = 0; x < trace.size(); ++x) {
    if (!trace[x].any) continue;
    for (int y = dot_of(trace[x].high); y <= dot_of(trace[x].low); ++y) {
      plane.set(static_cast<int>(x), y);
    }
  }
  std::string text;
  for (int row = 0; row < rows; ++row) {
    const std::string label = row == 0          ? fmt::format("{}", top)
                              : row == rows - 1 ? "0"
                              : row == rows / 2 ? (channel == 0 ? "A" : "B")
                                                : "";
    text += fmt::format("{:>{}} {}\n", label, kLabelColumns - 1, plane.row(row));
  }
  return text;
}

std::string range_axis(const ScopeWindow& window, int columns) {
  const double from = metres(window.from_m).in_nautical_miles();
  const double to = metres(window.to_m).in_nautical_miles();
  std::string line(static_cast<std::size_t>(columns), '-'), numbers(line.size() + 8, ' ');
  const double distance = mark_distance(to - from, std::max(1, columns / 10));
  for (double mark = std::ceil(from / distance - 1e-9); mark * distance <= to * (1.0 + 1e-9);
       mark += 1.0) {
    const auto at = static_cast<std::size_t>(std::clamp(
        (mark * distance - from) / (to - from) * columns, 0.0, static_cast<double>(columns - 1)));
    line[at] = '+';
    const std::string number = mark_text(mark * distance, distance);
    const std::size_t left = at >= number.size() / 2 ? at - number.size() / 2 : 0;
    if (left + number.size() + 3 < numbers.size()) numbers.replace(left, number.size(), number);
  }
  numbers.replace(static_cast<std::size_t>(columns) - 2, std::string::npos, "NM");
  const std::string margin(kLabelColumns, ' ');
  return margin + line + "\n" + margin + numbers + "\n";
}

}  // namespace

std::string draw_scope_text(const board::Sweep& sweep, const ScopeWindow& window, TextSize size) {
  const int width = std::clamp(size.columns, kMinTextSize.columns, kMaxTextSize.columns);
  const int height = std::clamp(size.rows, kMinTextSize.rows, kMaxTextSize.rows);
  std::string text;
  int used = 2;  // the axis
  for (const std::string& line : scope_lines(sweep.meta)) {
    text += line.substr(0, static_cast<std::size_t>(width)) + "\n";
    ++used;
  }
  const int columns = width - kLabelColumns;
  const int channels =
      static_cast<int>(std::count_if(sweep.samples.begin(), sweep.samples.end(),
                                     [](const auto& samples) { return !samples.empty(); }));
  if (channels == 0) return text + "both channels are off\n";
  const int rows = std::max(2, (height - used) / channels);
  for (std::size_t channel = 0; channel < sweep.samples.size(); ++channel) {
    if (!sweep.samples[channel].empty()) text += panel(sweep, channel, window, columns, rows);
  }
  return text + range_axis(window, columns);
}

}  // namespace skerry::client
