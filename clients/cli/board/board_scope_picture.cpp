#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "clients/cli/board/board_scope.hpp"
#include "clients/cli/board/board_words.hpp"
#include "protocol/picture/canvas.hpp"
#include "protocol/quantity/length.hpp"

namespace skerry::client {
namespace {

constexpr Rgba kBackground{3, 6, 9};
constexpr Rgba kPanel{8, 14, 17};
constexpr Rgba kGrid{90, 140, 120};
constexpr Rgba kText{150, 205, 175};
constexpr Rgba kWarning{240, 150, 60};
constexpr std::array<Rgba, 2> kTraces = {{{238, 202, 48, 255}, {90, 205, 235, 255}}};
constexpr std::array<Rgba, 4> kLines = {
    {{238, 202, 48, 255}, {120, 230, 130, 255}, {240, 120, 110, 255}, {150, 170, 250, 255}}};
constexpr std::array<std::string_view, 4> kLineNames = {"TRIGGER", "ACP", "ARP", "HEADING"};

struct Box {
  int left = 0, top = 0, right = 0, bottom = 0;
  int width() const { return right - left; }
  int height() const { return bottom - top; }
};

class ScopePainter {
 public:
  ScopePainter(const board::Sweep& sweep, const std::vector<board::Edge>& edges,
               const ScopeWindow& window, PictureSize size)
      : sweep_(sweep), edges_(edges), window_(window) {
    image_.width = std::clamp(size.width, kMinScopePicture.width, kMaxScopePicture.width);
    image_.height = std::clamp(size.height, kMinScopePicture.height, kMaxScopePicture.height);
    image_.pixels.assign(static_cast<std::size_t>(image_.width) * image_.height, kBackground);
    scale_ = std::max(1, std::min(image_.width / 640, image_.height / 360));
  }

  RgbaImage run() {
    const int line = 10 * scale_, margin = 8 * scale_;
    int top = margin;
    const auto lines = scope_lines(sweep_.meta);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const bool warns = i == 2 && sweep_.meta.faults != 0;
      canvas_.text(lines[i], margin, top, scale_, warns ? kWarning : colour_of_line(i));
      top += line;
    }
    const int left = margin + 44 * scale_, right = image_.width - margin;
    const int signal_height = 4 * 14 * scale_;
    const int video_bottom = image_.height - signal_height - 4 * line - margin;
    video({left, top + line / 2, right, video_bottom});
    signals({left, video_bottom + 3 * line, right, video_bottom + 3 * line + signal_height});
    return std::move(image_);
  }

 private:
  // Channels in the colour of their trace.
  Rgba colour_of_line(std::size_t i) const {
    if (i < 3) return kText;
    return kTraces[i == 3 && sweep_.meta.channels[0].samples > 0 ? 0 : 1];
  }

  void fill(const Box& box, Rgba colour) {
    for (int y = box.top; y < box.bottom; ++y) {
      for (int x = box.left; x < box.right; ++x) canvas_.blend(x, y, colour, 1.0);
    }
  }

  void text_left_of(std::string_view text, int right, int middle, Rgba colour) {
    canvas_.text(text, right - Canvas::text_width(text, scale_) - 3 * scale_,
                 middle - Canvas::text_height(scale_) / 2, scale_, colour);
  }
  void text_below(std::string_view text, int centre, int top, const Box& within) {
    const int width = Canvas::text_width(text, scale_);
    const int left = std::clamp(centre - width / 2, 0, std::max(0, within.right - width));
    canvas_.text(text, left, top, scale_, kText);
  }
  void vertical(const Box& box, double x, double opacity) {
    canvas_.line({x, double(box.top)}, {x, double(box.bottom)}, 1.0, kGrid, opacity);
  }

  void video(const Box& box) {
    std::vector<std::size_t> channels;
    for (std::size_t channel = 0; channel < sweep_.samples.size(); ++channel) {
      if (!sweep_.samples[channel].empty()) channels.push_back(channel);
    }
    if (channels.empty()) {
      fill(box, kPanel);
      canvas_.text("BOTH CHANNELS ARE OFF", box.left + 8 * scale_, box.top + 8 * scale_, scale_,
                   kWarning);
      return;
    }
    const int gap = 8 * scale_, count = static_cast<int>(channels.size());
    const int height = (box.height() - gap * (count - 1)) / count;
    for (int i = 0; i < count; ++i) {
      const int top = box.top + i * (height + gap);
      channel(channels[static_cast<std::size_t>(i)], {box.left, top, box.right, top + height});
    }
    range_numbers(box);
  }

  template <typename Draw>
  void each_range_mark(const Box& box, Draw&& draw) const {
    const double from = metres(window_.from_m).in_nautical_miles();
    const double to = metres(window_.to_m).in_nautical_miles();
    const double distance = mark_distance(to - from, std::max(2, box.width() / (70 * scale_)));
    for (double n = std::ceil(from / distance - 1e-9); n * distance <= to * (1.0 + 1e-9);
         n += 1.0) {
      draw(box.left + (n * distance - from) / (to - from) * box.width(), n * distance, distance);
    }
  }

  void range_numbers(const Box& box) {
    each_range_mark(box, [&](double x, double nm, double distance) {
      if (x < box.right - 30 * scale_) {
        text_below(mark_text(nm, distance), static_cast<int>(x), box.bottom + 4 * scale_, box);
      }
    });
    text_below("NM", box.right - 6 * scale_, box.bottom + 4 * scale_, box);
  }

  void channel(std::size_t channel, const Box& box) {
    fill(box, kPanel);
    const std::uint32_t top_code = board::largest_code(sweep_.meta.channels[channel]);
    const auto y_of = [&](double code) {
      return box.bottom - std::min(code / top_code, 1.0) * (box.height() - 1) - 1.0;
    };
    each_range_mark(box, [&](double x, double, double) { vertical(box, x, 0.25); });
    for (int quarter = 0; quarter <= 4; ++quarter) {
      const double code = top_code * 0.25 * quarter;
      canvas_.line({double(box.left), y_of(code) + 0.5}, {double(box.right), y_of(code) + 0.5}, 1.0,
                   kGrid, 0.25);
      const int middle =
          std::clamp(static_cast<int>(y_of(code)), box.top + 4 * scale_, box.bottom - 4 * scale_);
      text_left_of(fmt::format("{:.0f}", code), box.left, middle, kText);
    }
    const auto trace = columns_of(sweep_, channel, window_, static_cast<std::size_t>(box.width()));
    for (std::size_t x = 0; x < trace.size(); ++x) {
      if (!trace[x].any) continue;
      // Joined to the column before, so that a steep edge is a line.
      double low = trace[x].low, high = trace[x].high;
      if (x > 0 && trace[x - 1].any) {
        low = std::min<double>(low, trace[x - 1].high);
        high = std::max<double>(high, trace[x - 1].low);
      }
      const double at = box.left + static_cast<double>(x) + 0.5;
      canvas_.line({at, y_of(high)}, {at, y_of(low) + 1.0}, 1.0, kTraces[channel], 0.9);
    }
    canvas_.text(channel == 0 ? "A" : "B", box.right - 10 * scale_, box.top + 5 * scale_, scale_,
                 kTraces[channel]);
  }

  // The four digital lines around the trigger; a pulse is drawn at least 2 pixels wide.
  void signals(const Box& box) {
    const board::SweepMeta& meta = sweep_.meta;
    const auto span = static_cast<double>(signal_span(meta));
    const int pitch = box.height() / 4;
    fill(box, kPanel);
    for (std::size_t n = 0; n < kLineNames.size(); ++n) {
      const int base = box.top + static_cast<int>(n + 1) * pitch - 3 * scale_;
      canvas_.line({double(box.left), base + 0.5}, {double(box.right), base + 0.5}, 1.0, kLines[n],
                   0.5);
      text_left_of(kLineNames[n], box.left, base - pitch / 2 + 3 * scale_, kLines[n]);
    }
    for (const board::Edge& edge : edges_) {
      const auto line = static_cast<std::size_t>(edge.line);
      const double after = static_cast<double>(edge.tick) - static_cast<double>(meta.trigger_tick);
      if (line >= kLineNames.size() || std::abs(after) > span) continue;
      const double x = box.left + (after / span + 1.0) * 0.5 * box.width();
      const int base = box.top + static_cast<int>(line + 1) * pitch - 3 * scale_;
      canvas_.line({x, base + 1.0}, {x, base - pitch + 6.0 * scale_}, 2.0, kLines[line]);
    }
    vertical(box, box.left + 0.5 * box.width(), 0.5);
    const double microseconds = 1e6 * span / std::max(1u, meta.sample_clock_hz);
    const double distance =
        mark_distance(2.0 * microseconds, std::max(2, box.width() / (80 * scale_)));
    const double marks = std::floor(microseconds / distance);
    for (double n = -marks; n <= marks; n += 1.0) {
      const double x = box.left + (n * distance / microseconds + 1.0) * 0.5 * box.width();
      vertical(box, x, 0.25);
      if (x > box.right - 40 * scale_) continue;
      text_below(mark_text(n * distance, distance, true), static_cast<int>(x),
                 box.bottom + 4 * scale_, box);
    }
    text_below("US", box.right - 6 * scale_, box.bottom + 4 * scale_, box);
  }

  const board::Sweep& sweep_;
  const std::vector<board::Edge>& edges_;
  ScopeWindow window_;
  RgbaImage image_;
  Canvas canvas_{image_};
  int scale_ = 1;
};

}  // namespace

std::uint64_t signal_span(const board::SweepMeta& meta) {
  const std::uint64_t period =
      meta.prf_millihertz > 0 ? std::uint64_t{meta.sample_clock_hz} * 1000 / meta.prf_millihertz
                              : 0;
  const std::uint64_t span =
      std::max<std::uint64_t>(3 * std::uint64_t{meta.acp_period}, 3 * period);
  // Half a second of signals at most, however strange the board.
  return std::clamp<std::uint64_t>(span, 1, std::max(1u, meta.sample_clock_hz / 2));
}

RgbaImage draw_scope_picture(const board::Sweep& sweep, const std::vector<board::Edge>& edges,
                             const ScopeWindow& window, PictureSize size) {
  return ScopePainter(sweep, edges, window, size).run();
}

}  // namespace skerry::client
