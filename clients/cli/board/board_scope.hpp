// One sweep as an oscilloscope shows it: in the terminal, or as a picture.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "protocol/board/sweep_record.hpp"
#include "protocol/picture/canvas.hpp"

namespace skerry::client {

// The ranges shown, metres from the trigger; to_m > from_m.
struct ScopeWindow {
  double from_m = 0.0;
  double to_m = 0.0;
};
// From range zero to the end of the longest channel.
ScopeWindow whole_window(const board::SweepMeta& meta);

// The lowest and the highest code of all samples that reach into a column; a sample reaches half a
// step to either side of its range.
struct ScopeColumn {
  std::uint16_t low = 0;
  std::uint16_t high = 0;
  bool any = false;
};
std::vector<ScopeColumn> columns_of(const board::Sweep& sweep, std::size_t channel,
                                    const ScopeWindow& window, std::size_t columns);

// The values latched at the trigger, a line each: trigger, azimuth, pulse and faults, channels.
std::vector<std::string> scope_lines(const board::SweepMeta& meta);

// Distances between the marks of an axis: 1, 2 or 5 times a power of ten, at most `marks` in
// `length`.  Requires length > 0 and marks > 0.
double mark_distance(double length, int marks);
// The text at a mark, of marks `distance` apart: "0" at zero, of either sign; `with_sign`:
// "+20" and "-20".
std::string mark_text(double mark, double distance, bool with_sign = false);

struct TextSize {
  int columns = 80, rows = 24;
};
inline constexpr TextSize kMinTextSize{40, 12};
inline constexpr TextSize kMaxTextSize{1000, 300};

// Channels one above the other in braille dots, 2 x 4 to a character, with their codes to the left
// and the range in NM below; UTF-8, at most size.columns wide and size.rows high (but at least
// kMinTextSize).  Pure.
std::string draw_scope_text(const board::Sweep& sweep, const ScopeWindow& window, TextSize size);

struct PictureSize {
  int width = 1280, height = 720;
};
inline constexpr PictureSize kMinScopePicture{480, 360};
inline constexpr PictureSize kMaxScopePicture{8192, 8192};

// The same as a picture, and below it the digital signals around the trigger, as far as `edges`
// (in order of time) has them.  Pure.  Thread: any.
RgbaImage draw_scope_picture(const board::Sweep& sweep, const std::vector<board::Edge>& edges,
                             const ScopeWindow& window, PictureSize size);
// Ticks shown to either side of the trigger.
std::uint64_t signal_span(const board::SweepMeta& meta);

}  // namespace skerry::client
