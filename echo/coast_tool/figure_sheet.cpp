#include "echo/coast_tool/figure_sheet.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "protocol/picture/label_text.hpp"
#include "protocol/picture/ppi_picture.hpp"

namespace skerry::echo {
namespace {

constexpr Rgba kPaper{9, 14, 17};
constexpr Rgba kWater{14, 24, 32};
constexpr Rgba kLand{52, 50, 30};
constexpr Rgba kChartEdge{130, 140, 150};
constexpr Rgba kCoast{255, 205, 60};
constexpr Rgba kRim{70, 170, 120};
constexpr Rgba kShip{205, 235, 215};
constexpr Rgba kHeading{230, 240, 235};
constexpr Rgba kText{150, 205, 175};
constexpr Rgba kRemark{120, 150, 140};

constexpr int kMargin = 16, kGap = 12;
constexpr int kTitleHeight = 88, kHeadingHeight = 58, kCaptionHeight = 40;
constexpr double kRadius = 0.5 * FigureSheet::kPanel - 3.0;

constexpr int kWidth =
    2 * kMargin + FigureSheet::kColumns * FigureSheet::kPanel + (FigureSheet::kColumns - 1) * kGap;

RgbaImage blank(int width, int height, Rgba colour) {
  return {width, height, std::vector<Rgba>(static_cast<std::size_t>(width) * height, colour)};
}

double from_middle(int x, int y) {
  return std::hypot(x + 0.5 - 0.5 * FigureSheet::kPanel, y + 0.5 - 0.5 * FigureSheet::kPanel);
}

}  // namespace

FigureSheet::FigureSheet(const FigureCoast& coast, const std::string& title)
    : coast_(coast), image_(blank(kWidth, kTitleHeight, kPaper)) {
  Canvas canvas(image_);
  canvas.text(title, kMargin, kMargin, 3, kHeading);
  const auto write = [&](int line, const std::string& text) {
    canvas.text(text, kMargin, kMargin + 30 + 20 * line, 2, kRemark);
  };
  write(0, fmt::format("{}, own ship at {}", coast.source(), position_text(coast.place())));
  write(1,
        fmt::format("Range {} NM, ring at {:.0f} m, display of {:.0f} pixels. Grey: the chart's {} "
                    "edges. Shaded: land as the echo chain reads the coast.",
                    coast.scale().in_nautical_miles(), 0.5 * coast.scale().length().in_metres(),
                    FigureCoast::kDisplayPixels, coast.straight().edge_count()));
}

void FigureSheet::grow_to(int height) {
  if (height <= image_.height) return;
  image_.pixels.resize(static_cast<std::size_t>(image_.width) * height, kPaper);
  image_.height = height;
}

void FigureSheet::begin_row(const std::string& heading, const std::string& remark) {
  row_top_ = image_.height;
  grow_to(row_top_ + kHeadingHeight + kPanel + kCaptionHeight);
  Canvas canvas(image_);
  canvas.text(heading, kMargin, row_top_ + 14, 2, kHeading);
  canvas.text(remark, kMargin, row_top_ + 36, 2, kRemark);
  row_top_ += kHeadingHeight;
  column_ = 0;
}

FigureSheet::Place FigureSheet::next_panel() {
  if (column_ == kColumns) {
    row_top_ = image_.height;
    grow_to(row_top_ + kPanel + kCaptionHeight);
    column_ = 0;
  }
  return {kMargin + (kPanel + kGap) * column_++, row_top_};
}

void FigureSheet::caption_under(Place panel, const std::string& first, const std::string& second) {
  Canvas canvas(image_);
  const int top = panel.top + kPanel + 4;
  const auto middle = [&](const std::string& text) {
    return panel.left + (kPanel - Canvas::text_width(text, 2)) / 2;
  };
  canvas.text(first, middle(first), top, 2, kText);
  canvas.text(second, middle(second), top + 18, 2, kRemark);
}

void FigureSheet::draw_line(RgbaImage& panel, const CoastPicture& picture, double width,
                            Rgba colour) const {
  Canvas canvas(panel);
  const double scale = kRadius / coast_.scale().length().in_metres();
  const auto pixels = [&](PlanePoint p) {
    return Pixels{0.5 * kPanel + (p.east_m - picture.centre.east_m) * scale,
                  0.5 * kPanel - (p.north_m - picture.centre.north_m) * scale};
  };
  for (std::size_t run = 0; run + 1 < picture.run_starts.size(); ++run) {
    for (std::uint32_t v = picture.run_starts[run]; v + 1 < picture.run_starts[run + 1]; ++v) {
      const Pixels a = pixels(picture.vertices[v]), b = pixels(picture.vertices[v + 1]);
      const auto off = [](double p, double q) {
        return std::max(p, q) < 0.0 || std::min(p, q) > kPanel;
      };
      if (!off(a.x, b.x) && !off(a.y, b.y)) canvas.line(a, b, width, colour);
    }
  }
}

void FigureSheet::put_round(const RgbaImage& panel, Place place) {
  Canvas canvas(image_);
  for (int y = 0; y < kPanel; ++y) {
    for (int x = 0; x < kPanel; ++x) {
      const double cover = std::clamp(kRadius + 0.5 - from_middle(x, y), 0.0, 1.0);
      if (cover > 0.0) canvas.blend(place.left + x, place.top + y, panel.at(x, y), cover);
    }
  }
  const Pixels middle{place.left + 0.5 * kPanel, place.top + 0.5 * kPanel};
  canvas.ring(middle, kRadius, 1.5, kRim, 0.9);
  canvas.ring(middle, 0.5 * kRadius, 1.0, kRim, 0.4);
  canvas.line({middle.x - 6, middle.y}, {middle.x + 6, middle.y}, 1.2, kShip);
  canvas.line({middle.x, middle.y - 6}, {middle.x, middle.y + 6}, 1.2, kShip);
}

void FigureSheet::add_coast(const CoastPicture& picture, const std::string& caption) {
  const Place place = next_panel();
  RgbaImage panel = blank(kPanel, kPanel, kWater);
  const LandByRay land(picture);
  const double metres_per_pixel = coast_.scale().length().in_metres() / kRadius;
  for (int y = 0; y < kPanel; ++y) {
    for (int x = 0; x < kPanel; ++x) {
      const double east = x + 0.5 - 0.5 * kPanel, north = 0.5 * kPanel - y - 0.5;
      const double bearing = std::atan2(east, north) * 180.0 / std::numbers::pi;
      if (land.is_land(bearing < 0.0 ? bearing + 360.0 : bearing,
                       std::hypot(east, north) * metres_per_pixel)) {
        panel.at(x, y) = kLand;
      }
    }
  }
  draw_line(panel, coast_.straight(), 1.0, kChartEdge);
  draw_line(panel, picture, 1.3, kCoast);
  put_round(panel, place);
  caption_under(place, caption, fmt::format("{} points", picture.vertices.size()));
}

void FigureSheet::add_echo(const CoastPicturePtr& picture, const std::string& caption) {
  const Place place = next_panel();
  const Scan scan = coast_.scan_of(picture);
  const PpiRaster raster = rasterise(scan, {.size = kPanel, .radius = kRadius});
  const auto colours = colours_of(Palette::amber);
  RgbaImage panel = blank(kPanel, kPanel, colours[0]);
  for (std::size_t i = 0; i < panel.pixels.size(); ++i) {
    panel.pixels[i] = colours[raster.level[i]];
  }
  put_round(panel, place);
  caption_under(place, caption, fmt::format("{} points", picture->vertices.size()));
}

RgbaImage FigureSheet::take() {
  grow_to(image_.height + kMargin);
  return std::move(image_);
}

}  // namespace skerry::echo
