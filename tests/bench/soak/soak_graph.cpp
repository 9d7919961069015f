#include "tests/bench/soak/soak_graph.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include "protocol/picture/picture_file.hpp"

namespace skerry::bench {
namespace {

constexpr int kWidth = 1200, kPanelHeight = 260, kLeft = 90, kRight = 30, kTop = 40, kFoot = 40;
constexpr int kTextScale = 2;
constexpr Rgba kGround{16, 22, 28}, kGrid{56, 66, 76}, kText{210, 216, 222}, kLive{70, 210, 120},
    kPlayer{240, 180, 60};

struct Panel {
  const char* title;
  double (*value)(const ProcessFigures&);
};
constexpr std::array kPanels = {
    Panel{"RESIDENT MEMORY, MIB", [](const ProcessFigures& of) { return of.resident_mib; }},
    Panel{"DESCRIPTORS",
          [](const ProcessFigures& of) { return static_cast<double>(of.descriptors); }},
    Panel{"THREADS", [](const ProcessFigures& of) { return static_cast<double>(of.threads); }},
};

// 1, 2 or 5 times a power of ten, so that there are at most eight steps up to `most`.
double step_for(double most) {
  const double power = std::pow(10.0, std::floor(std::log10(std::max(most, 1.0) / 8.0)));
  for (const double factor : {1.0, 2.0, 5.0}) {
    if (most / (factor * power) <= 8.0) return factor * power;
  }
  return 10.0 * power;
}

class PanelPainter {
 public:
  PanelPainter(Canvas& canvas, int top, double minutes, double most)
      : canvas_(canvas), top_(top), minutes_(minutes), step_(step_for(most)) {
    most_ = std::max(step_, step_ * std::ceil(most / step_));
  }

  void frame(const char* title) {
    canvas_.text(title, kLeft, top_ + 12, kTextScale, kText);
    for (double value = 0.0; value <= most_ + 0.5 * step_; value += step_) {
      const double y = at(0.0, value).y;
      canvas_.line({kLeft, y}, {kWidth - kRight, y}, 1.0, kGrid);
      const std::string label = fmt::format("{:g}", value);
      canvas_.text(label, kLeft - 10 - Canvas::text_width(label, kTextScale),
                   static_cast<int>(y) - 7, kTextScale, kText);
    }
    const double step = step_for(minutes_);
    for (double minute = 0.0; minute <= minutes_; minute += step) {
      const std::string label = fmt::format("{:g}", minute);
      canvas_.text(label, static_cast<int>(at(minute, 0.0).x) - 6, top_ + kPanelHeight - kFoot + 10,
                   kTextScale, kText);
    }
    canvas_.text("MIN", kWidth - kRight - 40, top_ + 12, kTextScale, kText);
  }

  void curve(const std::vector<SoakSample>& samples, const Panel& panel,
             ProcessFigures SoakSample::*of, Rgba colour) {
    std::optional<Pixels> before;
    for (const SoakSample& sample : samples) {
      const Pixels here = at(sample.minutes, panel.value(sample.*of));
      if (before) canvas_.line(*before, here, 1.5, colour);
      if (sample.is_ebb) canvas_.ring(here, 4.0, 2.0, colour);
      before = here;
    }
  }

 private:
  Pixels at(double minute, double value) const {
    const double height = kPanelHeight - kTop - kFoot;
    return {kLeft + (kWidth - kLeft - kRight) * minute / minutes_,
            top_ + kTop + height * (1.0 - value / most_)};
  }

  Canvas& canvas_;
  const int top_;
  const double minutes_, step_;
  double most_;
};

}  // namespace

void write_soak_graph(const std::string& file, const std::vector<SoakSample>& samples) {
  RgbaImage image;
  image.width = kWidth;
  image.height = kPanelHeight * static_cast<int>(kPanels.size());
  image.pixels.assign(static_cast<std::size_t>(image.width) * image.height, kGround);
  Canvas canvas(image);
  const double minutes = std::max(samples.empty() ? 1.0 : samples.back().minutes, 0.1);
  for (std::size_t i = 0; i < kPanels.size(); ++i) {
    double most = 1.0;
    for (const SoakSample& sample : samples) {
      most = std::max({most, kPanels[i].value(sample.live), kPanels[i].value(sample.player)});
    }
    PanelPainter painter(canvas, static_cast<int>(i) * kPanelHeight, minutes, most);
    painter.frame(kPanels[i].title);
    painter.curve(samples, kPanels[i], &SoakSample::live, kLive);
    painter.curve(samples, kPanels[i], &SoakSample::player, kPlayer);
  }
  write_file(file, encode_png(image, {{"Title", "skerryd: memory, descriptors and threads"}}));
}

}  // namespace skerry::bench
