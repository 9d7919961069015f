#include "clients/common/canvas.hpp"

#include <algorithm>
#include <cmath>

#include "clients/common/bitmap_font.hpp"

namespace skerry::client {
namespace {

std::uint8_t mixed(std::uint8_t below, std::uint8_t above, double opacity) {
  return static_cast<std::uint8_t>(std::lround(below + (above - below) * opacity));
}

// How much of a pixel a stroke of `width` covers whose middle passes at `distance`.
double coverage(double distance, double width) {
  return std::clamp(0.5 * (width + 1.0) - std::abs(distance), 0.0, 1.0);
}

}  // namespace

void Canvas::blend(int x, int y, Rgba colour, double opacity) {
  if (x < 0 || y < 0 || x >= image_.width || y >= image_.height) return;
  Rgba& pixel = image_.at(x, y);
  pixel = {mixed(pixel.red, colour.red, opacity), mixed(pixel.green, colour.green, opacity),
           mixed(pixel.blue, colour.blue, opacity), 255};
}

void Canvas::line(Pixels from, Pixels to, double width, Rgba colour, double opacity) {
  const double dx = to.x - from.x, dy = to.y - from.y;
  const double length_squared = dx * dx + dy * dy;
  const double reach = 0.5 * width + 1.0;
  const int left = std::max(0, static_cast<int>(std::min(from.x, to.x) - reach));
  const int right = std::min(image_.width - 1, static_cast<int>(std::max(from.x, to.x) + reach));
  const int top = std::max(0, static_cast<int>(std::min(from.y, to.y) - reach));
  const int bottom = std::min(image_.height - 1, static_cast<int>(std::max(from.y, to.y) + reach));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double px = x + 0.5 - from.x, py = y + 0.5 - from.y;
      const double along =
          length_squared > 0 ? std::clamp((px * dx + py * dy) / length_squared, 0.0, 1.0) : 0.0;
      const double cover = coverage(std::hypot(px - along * dx, py - along * dy), width);
      if (cover > 0) blend(x, y, colour, cover * opacity);
    }
  }
}

void Canvas::ring(Pixels centre, double radius, double width, Rgba colour, double opacity) {
  const double reach = radius + 0.5 * width + 1.0;
  const int top = std::max(0, static_cast<int>(centre.y - reach));
  const int bottom = std::min(image_.height - 1, static_cast<int>(centre.y + reach));
  const int left = std::max(0, static_cast<int>(centre.x - reach));
  const int right = std::min(image_.width - 1, static_cast<int>(centre.x + reach));
  for (int y = top; y <= bottom; ++y) {
    for (int x = left; x <= right; ++x) {
      const double r = std::hypot(x + 0.5 - centre.x, y + 0.5 - centre.y);
      const double cover = coverage(r - radius, width);
      if (cover > 0) blend(x, y, colour, cover * opacity);
    }
  }
}

void Canvas::text(std::string_view text, int left, int top, int scale, Rgba colour) {
  for (const char c : text) {
    const Glyph& glyph = glyph_of(c);
    for (int row = 0; row < kGlyphRows * scale; ++row) {
      for (int column = 0; column < kGlyphColumns * scale; ++column) {
        if (glyph.dot(column / scale, row / scale)) blend(left + column, top + row, colour, 1.0);
      }
    }
    left += (kGlyphColumns + 1) * scale;
  }
}

int Canvas::text_width(std::string_view text, int scale) {
  if (text.empty()) return 0;
  return (static_cast<int>(text.size()) * (kGlyphColumns + 1) - 1) * scale;
}

}  // namespace skerry::client
