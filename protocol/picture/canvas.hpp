// RgbaImage: a picture of pixels; Canvas: lines, rings and text drawn onto one, with smooth edges.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

namespace skerry {

struct Rgba {
  std::uint8_t red = 0;
  std::uint8_t green = 0;
  std::uint8_t blue = 0;
  std::uint8_t alpha = 255;
  friend constexpr bool operator==(Rgba, Rgba) = default;
};

// Rows from the top, pixels from the left, 8 bits per channel, alpha not premultiplied.
struct RgbaImage {
  int width = 0;
  int height = 0;
  std::vector<Rgba> pixels;  // width * height

  // Requires 0 <= x < width and 0 <= y < height.
  Rgba& at(int x, int y) { return pixels[static_cast<std::size_t>(y) * width + x]; }
  const Rgba& at(int x, int y) const { return pixels[static_cast<std::size_t>(y) * width + x]; }
};

// Points are in pixels from the top left corner; the centre of pixel (x, y) lies at (x+0.5, y+0.5).
struct Pixels {
  double x = 0.0;
  double y = 0.0;
};

// Draws into an opaque image that outlives it; what lies outside the image is cut off.  Edges are
// smoothed over one pixel by coverage along the normal.
// Thread: one at a time per image.
class Canvas {
 public:
  explicit Canvas(RgbaImage& image) : image_(image) {}

  // `opacity` in [0, 1].
  void blend(int x, int y, Rgba colour, double opacity);
  void line(Pixels from, Pixels to, double width, Rgba colour, double opacity = 1.0);
  void ring(Pixels centre, double radius, double width, Rgba colour, double opacity = 1.0);

  // Glyphs of 5 x 7 dots in a 6 x 8 field, each dot `scale` pixels wide; `left_top` is the first
  // glyph's corner.  Lower case is drawn as upper case, a character without a glyph as a box.
  void text(std::string_view text, int left, int top, int scale, Rgba colour);
  static int text_width(std::string_view text, int scale);
  static int text_height(int scale) { return 7 * scale; }

 private:
  RgbaImage& image_;
};

}  // namespace skerry
