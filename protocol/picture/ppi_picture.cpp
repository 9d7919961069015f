#include "protocol/picture/ppi_picture.hpp"

#include <algorithm>
#include <cmath>
#include <span>

#include "protocol/picture/canvas.hpp"
#include "protocol/picture/label_text.hpp"
#include "protocol/quantity/angle.hpp"

namespace skerry {
namespace {

constexpr Rgba kOutside{9, 14, 17};
constexpr Rgba kBackground{3, 6, 9};
constexpr Rgba kMissing{44, 46, 48};
constexpr Rgba kRings{70, 170, 120};
constexpr Rgba kHeadingLine{205, 235, 215};
constexpr Rgba kScale{120, 175, 150};
constexpr Rgba kLabels{150, 205, 175};
constexpr Rgba kWarning{240, 150, 60};

struct Stop {
  int level;
  Rgba colour;
};

Rgba between(const Stop& low, const Stop& high, int level) {
  const auto mix = [&](int a, int b) {
    return static_cast<std::uint8_t>(a + (b - a) * (level - low.level) / (high.level - low.level));
  };
  return {mix(low.colour.red, high.colour.red), mix(low.colour.green, high.colour.green),
          mix(low.colour.blue, high.colour.blue), 255};
}

std::array<Rgba, 256> ramp(std::span<const Stop> stops) {
  std::array<Rgba, 256> colours{};
  for (std::size_t k = 1; k < stops.size(); ++k) {
    for (int level = stops[k - 1].level; level <= stops[k].level; ++level) {
      colours[level] = between(stops[k - 1], stops[k], level);
    }
  }
  return colours;
}

class Painter {
 public:
  Painter(const Scan& scan, const PpiOptions& options, const PpiLabels& labels)
      : scan_(scan),
        options_(options),
        labels_(labels),
        frame_(frame_of(options)),
        text_scale_(std::max(1, options.size / 512)) {
    image_.width = image_.height = options.size;
    image_.pixels.assign(static_cast<std::size_t>(options.size) * options.size, kOutside);
  }

  RgbaImage run() {
    video();
    if (scan_.newest()) {
      if (options_.range_rings) range_rings();
      if (options_.heading_line) heading_line();
    }
    bearing_scale();
    if (with_labels()) labels();
    return std::move(image_);
  }

 private:
  bool with_labels() const { return options_.labels && options_.size >= kLabelSize; }
  Pixels centre() const { return {frame_.centre(), frame_.centre()}; }
  double stroke() const { return std::max(1.0, options_.size / 1024.0); }

  // The point at `degrees` clockwise from the top and `radius` pixels from the centre.
  Pixels polar(double degrees, double radius) const {
    const double angle = degrees * kRadiansPerDegree;
    return {centre().x + radius * std::sin(angle), centre().y - radius * std::cos(angle)};
  }

  void video() {
    const PpiRaster raster = rasterise(scan_, frame_);
    const std::array colours = {colours_of(options_.palette),
                                colours_of(DopplerClass::approaching, options_.palette),
                                colours_of(DopplerClass::receding, options_.palette)};
    for (std::size_t i = 0; i < image_.pixels.size(); ++i) {
      switch (raster.kind[i]) {
        case PixelKind::outside:
          break;
        case PixelKind::unswept:
          image_.pixels[i] = colours[0][0];
          break;
        case PixelKind::missing:
          image_.pixels[i] = kMissing;
          break;
        case PixelKind::video:
          image_.pixels[i] =
              colours[raster.doppler.empty() ? 0 : static_cast<std::size_t>(raster.doppler[i])]
                     [raster.level[i]];
          break;
      }
    }
  }

  void range_rings() {
    const int count = scan_.newest()->header.range_scale.ring_count();
    for (int n = 1; n < count; ++n) {
      canvas_.ring(centre(), frame_.radius * n / count, stroke(), kRings, 0.5);
    }
    canvas_.ring(centre(), frame_.radius, 1.5 * stroke(), kRings, 0.9);
  }

  void heading_line() {
    const double up = options_.orientation == Orientation::head_up
                          ? 0.0
                          : scan_.newest()->header.heading.in_degrees();
    canvas_.line(centre(), polar(up, frame_.radius), 1.2 * stroke(), kHeadingLine, 0.8);
  }

  void bearing_scale() {
    const double unit = options_.size / 1024.0;
    const double inner = frame_.radius + 2.0 * unit;
    const int every = options_.size >= 512 ? 1 : 5;
    for (int degree = 0; degree < 360; degree += every) {
      const double length = degree % 10 == 0 ? 11.0 : degree % 5 == 0 ? 7.0 : 4.0;
      canvas_.line(polar(degree, inner), polar(degree, inner + length * unit),
                   degree % 10 == 0 ? 1.4 * stroke() : stroke(), kScale,
                   degree % 5 == 0 ? 0.95 : 0.6);
    }
    if (!with_labels()) return;
    for (int degree = 0; degree < 360; degree += 30) {
      const Pixels at = polar(degree, inner + 11.0 * unit + 12.0 * text_scale_);
      const std::string text = three_digits(degree);
      canvas_.text(text, static_cast<int>(at.x) - Canvas::text_width(text, text_scale_) / 2,
                   static_cast<int>(at.y) - Canvas::text_height(text_scale_) / 2, text_scale_,
                   kScale);
    }
  }

  void labels() {
    const LabelText text = label_text(scan_, options_.orientation, labels_);
    corner(text.top_left, false, false);
    corner(text.top_right, true, false);
    corner(text.bottom_left, false, true);
    corner(text.bottom_right, true, true);
  }

  void corner(const std::vector<LabelLine>& lines, bool right, bool bottom) {
    const int margin = 6 * text_scale_, pitch = 10 * text_scale_;
    int top = bottom ? options_.size - margin - static_cast<int>(lines.size()) * pitch + 3 : margin;
    for (const LabelLine& line : lines) {
      const int left =
          right ? options_.size - margin - Canvas::text_width(line.text, text_scale_) : margin;
      canvas_.text(line.text, left, top, text_scale_, line.warning ? kWarning : kLabels);
      top += pitch;
    }
  }

  const Scan& scan_;
  const PpiOptions& options_;
  const PpiLabels& labels_;
  PpiFrame frame_;
  int text_scale_;
  RgbaImage image_;
  Canvas canvas_{image_};
};

}  // namespace

PpiFrame frame_of(const PpiOptions& options) {
  const double margin = options.size >= kLabelSize
                            ? 15.0 * options.size / 1024.0 + 21.0 * std::max(1, options.size / 512)
                            : 15.0 * options.size / 1024.0 + 1.0;
  return {.size = options.size,
          .radius = 0.5 * options.size - margin,
          .orientation = options.orientation};
}

std::array<Rgba, 256> colours_of(Palette palette) {
  static constexpr std::array<Stop, 6> kAmber = {{{0, kBackground},
                                                  {24, {12, 18, 10}},
                                                  {70, {58, 62, 12}},
                                                  {130, {150, 138, 18}},
                                                  {200, {232, 196, 34}},
                                                  {255, {255, 240, 120}}}};
  static constexpr std::array<Stop, 6> kGreen = {{{0, kBackground},
                                                  {24, {6, 20, 12}},
                                                  {70, {14, 70, 28}},
                                                  {130, {30, 150, 54}},
                                                  {200, {80, 226, 90}},
                                                  {255, {200, 255, 170}}}};
  return palette == Palette::amber ? ramp(kAmber) : ramp(kGreen);
}

std::array<Rgba, 256> colours_of(DopplerClass motion, Palette palette) {
  static constexpr std::array<Stop, 4> kApproaching = {
      {{0, kBackground}, {24, {40, 8, 8}}, {130, {196, 34, 30}}, {255, {255, 92, 84}}}};
  static constexpr std::array<Stop, 4> kReceding = {
      {{0, kBackground}, {24, {8, 12, 44}}, {130, {36, 84, 206}}, {255, {104, 164, 255}}}};
  switch (motion) {
    case DopplerClass::approaching:
      return ramp(kApproaching);
    case DopplerClass::receding:
      return ramp(kReceding);
    case DopplerClass::none:
      break;
  }
  return colours_of(palette);
}

RgbaImage draw_ppi(const Scan& scan, const PpiOptions& options, const PpiLabels& labels) {
  return Painter(scan, options, labels).run();
}

}  // namespace skerry
