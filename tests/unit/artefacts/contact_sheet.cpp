#include "tests/unit/artefacts/contact_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "protocol/picture/canvas.hpp"
#include "protocol/picture/label_text.hpp"
#include "protocol/picture/ppi_picture.hpp"
#include "protocol/picture/ppi_raster.hpp"

namespace skerry {
namespace {

constexpr Rgba kPaper{9, 14, 17}, kRim{70, 170, 120}, kShip{205, 235, 215}, kHeading{230, 240, 235},
    kName{150, 205, 175}, kRemark{120, 150, 140};
constexpr int kMargin = 16, kGap = 14, kTitle = 44, kText = 40;
constexpr double kRadius = 0.5 * kPicture - 2.0;

void put_round(RgbaImage& sheet, const Scan& scan, int left, int top) {
  const PpiRaster raster = rasterise(scan, {.size = kPicture, .radius = kRadius});
  const auto colours = colours_of(Palette::amber);
  Canvas canvas(sheet);
  const double middle = 0.5 * kPicture;
  for (int y = 0; y < kPicture; ++y) {
    for (int x = 0; x < kPicture; ++x) {
      const double off = std::hypot(x + 0.5 - middle, y + 0.5 - middle);
      const double cover = std::clamp(kRadius + 0.5 - off, 0.0, 1.0);
      if (cover <= 0.0) continue;
      const std::uint8_t level = raster.level[static_cast<std::size_t>(y) * kPicture + x];
      canvas.blend(left + x, top + y, colours[level], cover);
    }
  }
  canvas.ring({left + middle, top + middle}, kRadius, 1.4, kRim, 0.9);
  canvas.ring({left + middle, top + middle}, 0.5 * kRadius, 1.0, kRim, 0.35);
  canvas.line({left + middle, top + middle - 4.0}, {left + middle, top + middle + 4.0}, 1.0, kShip,
              0.7);
  canvas.line({left + middle - 4.0, top + middle}, {left + middle + 4.0, top + middle}, 1.0, kShip,
              0.7);
}

}  // namespace

Scan last_turn(const std::vector<std::uint8_t>& video, const ScanGeometry& geometry,
               RangeScale scale) {
  Scan scan;
  scan.geometry = geometry;
  const std::size_t turn = std::size_t{geometry.spokes_per_turn} * geometry.cells;
  const auto last = video.end() - static_cast<std::ptrdiff_t>(turn);
  for (std::uint32_t k = 0; k < geometry.spokes_per_turn; ++k) {
    Spoke spoke;
    spoke.header.index = k;
    spoke.header.geometry = geometry;
    spoke.header.range_scale = scale;
    const auto from = last + static_cast<std::ptrdiff_t>(std::size_t{k} * geometry.cells);
    spoke.cells.assign(from, from + geometry.cells);
    scan.spokes.emplace_back(std::move(spoke));
  }
  scan.received = geometry.spokes_per_turn;
  return scan;
}

RgbaImage contact_sheet(const std::string& title, const std::vector<Thumbnail>& pictures) {
  const int rows = (static_cast<int>(pictures.size()) + kColumns - 1) / kColumns;
  RgbaImage sheet;
  sheet.width = 2 * kMargin + kColumns * kPicture + (kColumns - 1) * kGap;
  sheet.height = kTitle + rows * (kPicture + kText + kGap) + kMargin;
  sheet.pixels.assign(static_cast<std::size_t>(sheet.width) * sheet.height, kPaper);
  Canvas canvas(sheet);
  canvas.text(title, kMargin, kMargin, 2, kHeading);
  for (int i = 0; i < static_cast<int>(pictures.size()); ++i) {
    const Thumbnail& picture = pictures[static_cast<std::size_t>(i)];
    const int left = kMargin + (i % kColumns) * (kPicture + kGap);
    const int top = kTitle + (i / kColumns) * (kPicture + kText + kGap);
    put_round(sheet, picture.scan, left, top);
    const auto centred = [&](const std::string& text, int scale) {
      return left + (kPicture - Canvas::text_width(text, scale)) / 2;
    };
    const std::string name = fmt::format("{}, {} NM", picture.name,
                                         range_text(picture.scan.newest()->header.range_scale));
    const int scale = Canvas::text_width(name, 2) <= kPicture ? 2 : 1;
    canvas.text(name, centred(name, scale), top + kPicture + 5, scale, kName);
    canvas.text(picture.caption, centred(picture.caption, 1), top + kPicture + 26, 1, kRemark);
  }
  return sheet;
}

}  // namespace skerry
