#include "server/plotter/judge/scene_figure.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "server/page/html_text.hpp"
#include "server/plotter/judge/place_series.hpp"

namespace skerry::server {
namespace {

constexpr double kFigureWidth = 1000.0, kLeastHeight = 320.0, kMostHeight = 900.0;
constexpr std::size_t kMostDrawnTracks = 400, kMostDrawnPoints = 400, kMostNames = 60;

struct Extent {
  double west = 1e300, south = 1e300, east = -1e300, north = -1e300;
  void take(PlanePoint p) {
    west = std::min(west, p.east_m), east = std::max(east, p.east_m);
    south = std::min(south, p.north_m), north = std::max(north, p.north_m);
  }
};

class SceneFigure {
 public:
  SceneFigure(const Truth& truth, const Told& told)
      : truth_(truth), told_(told), plane_(plane_of(truth)) {
    Extent all;
    for (const TruthTarget& target : truth.targets)
      for (const TruthPoint& point : target.points) all.take(plane_.to_plane(point.place));
    for (const TruthPoint& point : truth.own_ship) all.take(plane_.to_plane(point.place));
    if (all.west > all.east) all.take({0.0, 0.0});
    const double margin = 0.06 * std::max({all.east - all.west, all.north - all.south, 100.0});
    west_ = all.west - margin;
    north_ = all.north + margin;
    const double wide = all.east - all.west + 2.0 * margin;
    const double high = all.north - all.south + 2.0 * margin;
    px_per_m_ = std::min(kFigureWidth / wide, kMostHeight / high);
    height_ = std::clamp(high * px_per_m_, kLeastHeight, kMostHeight);
    west_ -= 0.5 * (kFigureWidth / px_per_m_ - wide);
    north_ += 0.5 * (height_ / px_per_m_ - high);
  }

  std::string svg() {
    out_ = fmt::format(
        "<svg class=\"chart\" viewBox=\"0 0 {:.0f} {:.0f}\" role=\"img\" aria-label=\"tracks over "
        "the truth\"><rect class=\"sea\" width=\"{:.0f}\" height=\"{:.0f}\"/>",
        kFigureWidth, height_, kFigureWidth, height_);
    grid();
    own_way();
    for (std::size_t i = 0; i < truth_.targets.size(); ++i) target_way(i);
    for (std::size_t i = 0; i < std::min(told_.tracks.size(), kMostDrawnTracks); ++i)
      track_way(told_.tracks[i]);
    return out_ + "</svg>\n";
  }

 private:
  double x(PlanePoint p) const { return (p.east_m - west_) * px_per_m_; }
  double y(PlanePoint p) const { return (north_ - p.north_m) * px_per_m_; }
  // Far outside it is cut off, so that no number is too long.
  std::string at(PlanePoint p) const {
    return fmt::format("{:.1f} {:.1f}", std::clamp(x(p), -5e3, 5e3), std::clamp(y(p), -5e3, 5e3));
  }

  void grid() {
    double step_m = 10.0;
    for (const double step : {10., 20., 50., 100., 200., 500., 1e3, 2e3, 5e3, 1e4, 2e4, 5e4, 1e5})
      if (step * px_per_m_ <= 160.0) step_m = step;
    const double wide = kFigureWidth / px_per_m_, high = height_ / px_per_m_;
    std::string path;
    int lines = 0;
    for (double e = std::ceil(west_ / step_m) * step_m; e < west_ + wide && ++lines < 200;
         e += step_m)
      path += fmt::format("M{:.1f} 0V{:.0f}", (e - west_) * px_per_m_, height_);
    for (double n = std::floor(north_ / step_m) * step_m; n > north_ - high && ++lines < 400;
         n -= step_m)
      path += fmt::format("M0 {:.1f}H{:.0f}", (north_ - n) * px_per_m_, kFigureWidth);
    out_ += fmt::format("<path class=\"grid\" d=\"{}\"/>", path);
    out_ += fmt::format(
        "<path class=\"scale\" d=\"M14 {:.1f}h{:.1f}\"/><text class=\"tick\" x=\"14\" "
        "y=\"{:.1f}\">{:g} m</text>",
        height_ - 12.0, step_m * px_per_m_, height_ - 18.0, step_m);
  }

  template <typename Points>
  std::string path_of(const Points& points) const {
    const std::size_t stride = std::max<std::size_t>(1, points.size() / kMostDrawnPoints);
    std::string path;
    for (std::size_t i = 0; i < points.size(); i += stride)
      path += (path.empty() ? "M" : "L") + at(plane_.to_plane(points[i].place));
    if (!points.empty()) path += "L" + at(plane_.to_plane(points.back().place));
    return path;
  }

  void own_way() {
    if (truth_.own_ship.empty()) return;
    out_ += fmt::format("<path class=\"way\" style=\"stroke:var(--c8)\" d=\"{}\"/>",
                        path_of(truth_.own_ship));
    name(truth_.own_ship.front().place, "own ship");
  }

  void target_way(std::size_t index) {
    const TruthTarget& target = truth_.targets[index];
    if (target.points.empty()) return;
    out_ += fmt::format(
        "<path class=\"way c{}\" style=\"stroke-width:5;opacity:.45\" d=\"{}\"><title>{}</title>"
        "</path>",
        index % 8, path_of(target.points), escaped(target.id));
    if (index < kMostNames) name(target.points.front().place, target.id);
  }

  void name(GeoPoint place, const std::string& text) {
    const PlanePoint p = plane_.to_plane(place);
    const bool at_edge = x(p) > 0.85 * kFigureWidth;
    out_ += fmt::format(
        "<circle class=\"dot\" cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"3\"/><text class=\"label\" "
        "x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>",
        x(p), y(p), x(p) + (at_edge ? -7.0 : 7.0), y(p) - 6.0, at_edge ? "end" : "start",
        escaped(text));
  }

  void track_way(const ToldTrack& track) {
    std::vector<ToldPoint> shown;
    for (const ToldPoint& point : track.points)
      if (point.status == ToldStatus::tracked) shown.push_back(point);
    if (shown.empty()) return;
    out_ += fmt::format(
        "<path class=\"way\" style=\"stroke:var(--ink);stroke-width:1.2;stroke-dasharray:4 2\" "
        "d=\"{}\"><title>track {}</title></path>",
        path_of(shown), escaped(track.number));
    const PlanePoint begin = plane_.to_plane(shown.front().place);
    if (x(begin) > 0.0 && x(begin) < kFigureWidth && y(begin) > 0.0 && y(begin) < height_)
      out_ += fmt::format("<text class=\"time\" x=\"{:.1f}\" y=\"{:.1f}\">{}</text>",
                          x(begin) + 4.0, y(begin) + 12.0, escaped(track.number));
    if (track.points.back().status != ToldStatus::lost) return;
    const PlanePoint end = plane_.to_plane(shown.back().place);
    out_ += fmt::format(
        "<circle class=\"curve\" style=\"stroke:var(--bad)\" cx=\"{:.1f}\" cy=\"{:.1f}\" "
        "r=\"4.5\"/>",
        std::clamp(x(end), -5e3, 5e3), std::clamp(y(end), -5e3, 5e3));
  }

  const Truth& truth_;
  const Told& told_;
  echo::LocalPlane plane_;
  double west_ = 0.0, north_ = 0.0, px_per_m_ = 1.0, height_ = kLeastHeight;
  std::string out_;
};

}  // namespace

std::string scene_figure(const Truth& truth, const Told& told) {
  return SceneFigure(truth, told).svg();
}

}  // namespace skerry::server
