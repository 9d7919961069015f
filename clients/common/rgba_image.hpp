// RgbaImage: a picture in memory.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace skerry::client {

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

}  // namespace skerry::client
