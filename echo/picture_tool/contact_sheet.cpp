#include "echo/picture_tool/contact_sheet.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

#include "protocol/picture/ppi_picture.hpp"

namespace skerry::echo {
namespace {

constexpr Rgba kSheet{9, 14, 17};
constexpr Rgba kRimColour{70, 170, 120};
constexpr Rgba kTitle{230, 240, 235};
constexpr Rgba kCaption{150, 205, 175};
constexpr int kEdge = 16, kBetween = 12, kTitleRow = 52, kHeadingRow = 36, kCaptionRow = 28;
constexpr double kRim = 0.5 * ContactSheet::kPanel - 2.0;  // pixels
constexpr int kSheetWidth = 2 * kEdge + ContactSheet::kColumns * ContactSheet::kPanel +
                            (ContactSheet::kColumns - 1) * kBetween;

// Levels 0 to 255, row by row.
std::vector<std::uint8_t> panel_of(const TurnsOfPicture& picture) {
  constexpr int kSide = ContactSheet::kPanel;
  const PictureTurn turn = picture.turn(0, 1.0);
  std::vector<std::uint8_t> level(std::size_t{kSide} * kSide, 0);
  const double cells_per_pixel = turn.cells / kRim, turn_radians = 2.0 * std::numbers::pi;
  const auto at = [&](int x, int y) -> std::uint8_t& {
    return level[static_cast<std::size_t>(y) * kSide + static_cast<std::size_t>(x)];
  };
  const auto shown = [&](std::uint32_t spoke, std::uint32_t cell) {
    return static_cast<std::uint8_t>(turn.at(spoke, cell) * 255u / turn.full_scale);
  };
  for (int y = 0; y < kSide; ++y) {
    for (int x = 0; x < kSide; ++x) {
      const double east = x + 0.5 - 0.5 * kSide, north = 0.5 * kSide - y - 0.5;
      const double cell = std::sqrt(east * east + north * north) * cells_per_pixel;
      if (cell >= turn.cells) continue;
      const double share = std::atan2(east, north) / turn_radians;
      const auto spoke =
          static_cast<std::uint32_t>((share < 0.0 ? share + 1.0 : share) * turn.spokes) %
          turn.spokes;
      at(x, y) = shown(spoke, static_cast<std::uint32_t>(cell));
    }
  }
  for (std::uint32_t s = 0; s < turn.spokes; ++s) {
    const double bearing = (s + 0.5) / turn.spokes * turn_radians;
    const double east = std::sin(bearing), north = std::cos(bearing);
    for (std::uint32_t c = 0; c < turn.cells; ++c) {
      const double r = (c + 0.5) / cells_per_pixel;
      auto& here =
          at(static_cast<int>(0.5 * kSide + r * east), static_cast<int>(0.5 * kSide - r * north));
      here = std::max(here, shown(s, c));
    }
  }
  return level;
}

}  // namespace

ContactSheet::ContactSheet(const std::string& title)
    : image_{kSheetWidth, kTitleRow,
             std::vector<Rgba>(std::size_t{kSheetWidth} * kTitleRow, kSheet)} {
  Canvas(image_).text(title, kEdge, kEdge, 3, kTitle);
}

void ContactSheet::grow_to(int height) {
  if (height <= image_.height) return;
  image_.pixels.resize(static_cast<std::size_t>(image_.width) * height, kSheet);
  image_.height = height;
}

void ContactSheet::begin_row(const std::string& heading) {
  row_top_ = image_.height + kHeadingRow;
  grow_to(row_top_ + kPanel + kCaptionRow);
  Canvas(image_).text(heading, kEdge, row_top_ - 24, 2, kTitle);
  column_ = 0;
}

void ContactSheet::add(const TurnsOfPicture& picture, const std::string& caption) {
  if (picture.turns.empty() || row_top_ == 0 || column_ >= kColumns)
    throw std::logic_error("contact sheet: no turn, no row or no room in it");
  const int left = kEdge + (kPanel + kBetween) * column_++;
  const std::vector<std::uint8_t> level = panel_of(picture);
  const auto colours = colours_of(Palette::amber);
  Canvas canvas(image_);
  for (int y = 0; y < kPanel; ++y) {
    for (int x = 0; x < kPanel; ++x) {
      const double from_middle = std::hypot(x + 0.5 - 0.5 * kPanel, y + 0.5 - 0.5 * kPanel);
      const double cover = std::clamp(kRim + 0.5 - from_middle, 0.0, 1.0);
      const auto value = level[static_cast<std::size_t>(y) * kPanel + static_cast<std::size_t>(x)];
      if (cover > 0.0) canvas.blend(left + x, row_top_ + y, colours[value], cover);
    }
  }
  canvas.ring({left + 0.5 * kPanel, row_top_ + 0.5 * kPanel}, kRim, 1.5, kRimColour, 0.9);
  canvas.text(caption, left + (kPanel - Canvas::text_width(caption, 2)) / 2, row_top_ + kPanel + 6,
              2, kCaption);
}

RgbaImage ContactSheet::take() {
  grow_to(image_.height + kEdge);
  return std::move(image_);
}

}  // namespace skerry::echo
