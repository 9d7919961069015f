#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tests/bench/error/study.hpp"

namespace skerry::bench {
namespace {

constexpr double kWidth = 760, kHeight = 480, kLeft = 70, kTop = 30, kRight = 230, kBottom = 60;
constexpr double kLeast = 1e-5;  // metres; smaller errors are drawn here

struct Axis {
  double low, high;  // powers of ten
  double begin, end;
  double at(double value) const {
    const double x = (std::log10(value) - low) / (high - low);
    return begin + (end - begin) * std::clamp(x, 0.0, 1.0);
  }
};

}  // namespace

std::string error_curve_svg(std::span<const ErrorRow> rows) {
  double low_t = 1e12, high_t = 0.0, high_e = 1.0;
  for (const ErrorRow& r : rows) {
    if (r.microseconds_per_spoke <= 0.0) continue;
    low_t = std::min(low_t, r.microseconds_per_spoke);
    high_t = std::max(high_t, r.microseconds_per_spoke);
    high_e = std::max(high_e, r.p99_m);
  }
  if (high_t <= 0.0) return {};
  const Axis across{std::log10(kLeast), std::ceil(std::log10(high_e)), kLeft, kWidth - kRight};
  const Axis up{std::floor(std::log10(low_t)), std::ceil(std::log10(high_t) + 1e-9),
                kHeight - kBottom, kTop};
  std::string svg;
  const auto out = std::back_inserter(svg);
  fmt::format_to(out,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {} {}\" "
                 "font-family=\"sans-serif\" font-size=\"12\">\n"
                 "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
                 kWidth, kHeight);
  for (int p = static_cast<int>(across.low); p <= static_cast<int>(across.high); ++p) {
    const double x = across.at(std::pow(10.0, p));
    fmt::format_to(out,
                   "<line x1=\"{0:.1f}\" y1=\"{1}\" x2=\"{0:.1f}\" y2=\"{2}\" stroke=\"#ddd\"/>"
                   "<text x=\"{0:.1f}\" y=\"{3}\" text-anchor=\"middle\">1e{4}</text>\n",
                   x, kTop, kHeight - kBottom, kHeight - kBottom + 16, p);
  }
  for (int p = static_cast<int>(up.low); p <= static_cast<int>(up.high); ++p) {
    const double y = up.at(std::pow(10.0, p));
    fmt::format_to(out,
                   "<line x1=\"{0}\" y1=\"{1:.1f}\" x2=\"{2}\" y2=\"{1:.1f}\" stroke=\"#ddd\"/>"
                   "<text x=\"{3}\" y=\"{1:.1f}\" text-anchor=\"end\">1e{4}</text>\n",
                   kLeft, y, kWidth - kRight, kLeft - 6, p);
  }
  fmt::format_to(out,
                 "<text x=\"{}\" y=\"{}\" text-anchor=\"middle\">error, metres, p99 (at 1e-5: that "
                 "or less)</text>\n<text x=\"14\" y=\"{}\" transform=\"rotate(-90 14 {})\" "
                 "text-anchor=\"middle\">microseconds per spoke</text>\n",
                 (kLeft + kWidth - kRight) / 2, kHeight - 16, kHeight / 2, kHeight / 2);
  constexpr std::array<const char*, 5> kColours = {"#1f77b4", "#d62728", "#2ca02c", "#9467bd",
                                                   "#ff7f0e"};
  std::string knob;
  std::size_t curve = 0;
  std::string line;
  const auto finish = [&] {
    if (line.empty()) return;
    const char* colour = kColours[(curve - 1) % kColours.size()];
    fmt::format_to(out,
                   "<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\"/>\n"
                   "<text x=\"{}\" y=\"{}\" fill=\"{}\">{}</text>\n",
                   line, colour, kWidth - kRight + 14, kTop + 18.0 * static_cast<double>(curve),
                   colour, knob);
    line.clear();
  };
  for (const ErrorRow& r : rows) {
    if (r.knob != knob) {
      finish();
      knob = r.knob;
      ++curve;
    }
    if (r.microseconds_per_spoke <= 0.0) continue;
    const double x = across.at(std::max(r.p99_m, kLeast)), y = up.at(r.microseconds_per_spoke);
    line += fmt::format("{:.1f},{:.1f} ", x, y);
    fmt::format_to(
        out,
        "<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"{}\" fill=\"{}\"><title>{}: {}</title></circle>\n",
        x, y, r.in_use ? 6 : 3, kColours[(curve - 1) % kColours.size()], r.knob, r.setting);
  }
  finish();
  fmt::format_to(out, "<text x=\"{}\" y=\"{}\">large dot: what the server does</text>\n</svg>\n",
                 kWidth - kRight + 14, kTop + 18.0 * static_cast<double>(curve + 1));
  return svg;
}

}  // namespace skerry::bench
