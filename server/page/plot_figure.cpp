#include "server/page/plot_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "server/page/html_text.hpp"

namespace skerry::server {
namespace {

constexpr double kLeft = 62.0, kRight = 150.0, kTop = 22.0, kBottom = 20.0, kPlotWidth = 1000.0;
constexpr int kBins = 750;  // two points each

// Of each share of the time the least and the greatest value, in their order.
std::vector<PlotCurve::Point> thinned(const std::vector<PlotCurve::Point>& points, double end_s) {
  if (points.size() <= 2 * kBins || end_s <= 0.0) return points;
  std::vector<PlotCurve::Point> out;
  for (std::size_t from = 0; from < points.size();) {
    const double bin = std::floor(points[from].at_s / end_s * kBins);
    std::size_t to = from + 1, low = from, high = from;
    while (to < points.size() && !points[to].begins &&
           std::floor(points[to].at_s / end_s * kBins) == bin) {
      if (points[to].value < points[low].value) low = to;
      if (points[to].value > points[high].value) high = to;
      ++to;
    }
    for (const std::size_t i : {std::min(low, high), std::max(low, high)}) {
      if (!out.empty() && i == low && low == high && out.back().at_s == points[i].at_s) continue;
      PlotCurve::Point point = points[i];
      point.begins = points[from].begins && i == std::min(low, high);
      out.push_back(point);
    }
    from = to;
  }
  return out;
}

double value_tick(double span, int most) {
  for (double power = 0.001;; power *= 10.0) {
    for (const double step : {1.0, 2.0, 3.0, 5.0}) {
      if (span / (step * power) <= most) return step * power;
    }
  }
}

class Plot {
 public:
  Plot(const PlotFrame& frame, const std::vector<PlotCurve>& curves) : frame_(frame) {
    double least = 1e300, most = -1e300;
    for (const PlotCurve& curve : curves) {
      for (const PlotCurve::Point& point : curve.points) {
        least = std::min(least, point.value);
        most = std::max(most, point.value);
      }
    }
    if (least > most) least = most = 0.0;
    least = frame.least.value_or(least);
    most = frame.most.value_or(most);
    if (most - least < frame.least_span) {
      const double middle = 0.5 * (least + most);
      if (!frame.least) least = middle - 0.5 * frame.least_span;
      most = least + frame.least_span;
    }
    tick_ = frame.tick.value_or(value_tick(most - least, frame.height_px > 200.0 ? 8 : 4));
    least_ = frame.least ? least : std::floor(least / tick_ + 1e-9) * tick_;
    most_ = frame.most ? most : std::ceil(most / tick_ - 1e-9) * tick_;
  }

  double x(double at_s) const {
    return kLeft + (kPlotWidth - kLeft - kRight) * at_s / std::max(frame_.end_s, 1e-9);
  }
  double y(double value) const {
    const double inner = frame_.height_px - kTop - kBottom;
    return kTop + inner * (most_ - std::clamp(value, least_, most_)) / (most_ - least_);
  }

  void axes(std::string& out) const {
    const double bottom = frame_.height_px - kBottom;
    for (double value = std::ceil(least_ / tick_ - 1e-9) * tick_; value <= most_ + 1e-9;
         value += tick_) {
      out += fmt::format(
          "<path class=\"grid\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>"
          "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"end\">{:g}</text>",
          kLeft, y(value), kPlotWidth - kRight, kLeft - 5.0, y(value) + 4.0,
          std::fabs(value) < 1e-9 ? 0.0 : value);
    }
    const bool time = frame_.along.empty();
    const double step = time ? time_tick(frame_.end_s, 10) : value_tick(frame_.end_s, 10);
    for (double at = 0.0; at <= frame_.end_s + 1e-6; at += step) {
      out += fmt::format(
          "<path class=\"grid\" d=\"M{:.1f} {:.1f}V{:.1f}\"/>"
          "<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"middle\">{}</text>",
          x(at), kTop, bottom, x(at), bottom + 14.0,
          time ? clock_text(at) : fmt::format("{:g}", at));
    }
    if (!time) {
      out += fmt::format("<text class=\"tick\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
                         kPlotWidth - kRight + 8.0, bottom + 14.0, escaped(frame_.along));
    }
    out += fmt::format("<path class=\"axis\" d=\"M{:.1f} {:.1f}V{:.1f}H{:.1f}\"/>", kLeft, kTop,
                       bottom, kPlotWidth - kRight);
    if (frame_.limit && *frame_.limit >= least_ && *frame_.limit <= most_) {
      out += fmt::format("<path class=\"limit\" d=\"M{:.1f} {:.1f}H{:.1f}\"/>", kLeft,
                         y(*frame_.limit), kPlotWidth - kRight);
    }
  }

  void curve(const PlotCurve& curve, std::string& out) const {
    if (curve.points.empty()) return;
    std::string path;
    for (const PlotCurve::Point& point : thinned(curve.points, frame_.end_s)) {
      path += fmt::format("{}{:.1f} {:.1f}", path.empty() || point.begins ? "M" : "L",
                          x(point.at_s), y(point.value));
    }
    out += fmt::format("<path class=\"curve c{}\" d=\"{}\"/>", curve.colour, path);
  }

 private:
  const PlotFrame& frame_;
  double least_ = 0.0, most_ = 1.0, tick_ = 1.0;
};

}  // namespace

double time_tick(double length_s, int most) {
  constexpr std::array kSteps = {5.0,   10.0,   15.0,   30.0,   60.0,   120.0,   300.0,  600.0,
                                 900.0, 1800.0, 3600.0, 7200.0, 14400., 28800.0, 86400.0};
  for (const double step : kSteps) {
    if (length_s / step <= most) return step;
  }
  return length_s / most;
}

std::string plot_figure(const PlotFrame& frame, const std::vector<PlotCurve>& curves,
                        const std::vector<PlotMark>& marks) {
  const Plot plot(frame, curves);
  std::string out = fmt::format(
      "<svg class=\"plot\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"{}\" "
      "data-left=\"{:.0f}\" data-right=\"{:.0f}\" data-end=\"{:.1f}\">",
      kPlotWidth, frame.height_px, escaped(frame.title), kLeft, kPlotWidth - kRight, frame.end_s);
  out += fmt::format("<text class=\"name\" x=\"{:.0f}\" y=\"14\">{}{}</text>", kLeft,
                     escaped(frame.title), frame.unit.empty() ? "" : ", " + escaped(frame.unit));
  plot.axes(out);
  for (const PlotMark& mark : marks) {
    out += fmt::format(
        "<path class=\"mark {}\" d=\"M{:.1f} {:.0f}V{:.1f}\"><title>{} {}</title></path>",
        mark.kind, plot.x(mark.at_s), kTop, frame.height_px - kBottom, clock_text(mark.at_s),
        escaped(mark.text));
  }
  for (const PlotCurve& curve : curves) plot.curve(curve, out);
  // Names stand to the right, none over another.
  double y = kTop + 4.0;
  for (const PlotCurve& curve : curves) {
    if (curve.name.empty()) continue;
    out += fmt::format(
        "<path class=\"curve c{}\" d=\"M{:.0f} {:.1f}h14\"/>"
        "<text class=\"tick\" x=\"{:.0f}\" y=\"{:.1f}\">{}</text>",
        curve.colour, kPlotWidth - kRight + 8.0, y, kPlotWidth - kRight + 26.0, y + 4.0,
        escaped(curve.name));
    y += 15.0;
  }
  return out + "</svg>\n";
}

}  // namespace skerry::server
