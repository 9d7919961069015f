// Curves over time, as SVG.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace skerry::server {

struct PlotCurve {
  struct Point {
    double at_s = 0.0, value = 0.0;
    bool begins = false;  // not joined to the point before
  };
  std::string name;           // empty: not named
  int colour = 0;             // of the eight of the page's style
  std::vector<Point> points;  // by time
};

struct PlotMark {
  double at_s = 0.0;
  std::string kind;  // a class of letters only
  std::string text;
};

struct PlotFrame {
  std::string title, unit;
  std::string along;   // what the axis along is; empty: a time
  double end_s = 0.0;  // of that axis, from 0
  double height_px = 130.0;
  std::optional<double> least, most;  // of the values; without: what the curves have
  double least_span = 1.0;            // of the values' axis
  std::optional<double> tick;         // of the values' axis; without: a round one
  std::optional<double> limit;        // a dashed line
};

// At most some 1500 points of a curve are drawn: the least and greatest of equal shares of the
// time. Everything is escaped.
std::string plot_figure(const PlotFrame& frame, const std::vector<PlotCurve>& curves,
                        const std::vector<PlotMark>& marks);

// Seconds between the ticks of a time axis that is so long: at most `most` of them.
double time_tick(double length_s, int most);

}  // namespace skerry::server
