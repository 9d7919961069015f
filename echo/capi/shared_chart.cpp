#include "echo/capi/shared_chart.hpp"

#include <cmath>
#include <string>

#include "echo/chart/gdal/open_chart.hpp"
#include "echo/chart/land_mask.hpp"
#include "echo/chart/local_plane.hpp"

namespace skerry::echo::capi {

SharedChart::SharedChart(std::unique_ptr<const ChartSource> source, std::string warnings)
    : source_(std::move(source)), name_(source_->describe()), warnings_(std::move(warnings)) {}

CoastChart SharedChart::load(GeoPoint centre, Length radius) const {
  const std::lock_guard lock(reading_);
  return reading_chart([&] { return source_->load(centre, radius); });
}

bool SharedChart::is_land(GeoPoint place) const {
  const std::lock_guard lock(looking_);
  const auto covers = [&](const CoastChart& window) {
    const PlanePoint p = LocalPlane(window.centre).to_plane(place);
    return std::hypot(p.east_m, p.north_m) <= 0.5 * kWindowMetres;
  };
  if (!window_ || !covers(*window_)) window_ = load(place, metres(kWindowMetres));
  return skerry::echo::is_land(*window_, place);
}

std::shared_ptr<SharedChart> open_shared_chart(
    const std::vector<std::filesystem::path>& charts,
    const std::vector<std::filesystem::path>& elevations) {
  return reading_chart([&] {
    OpenedChart opened = open_charts(charts);
    std::unique_ptr<ChartSource> source = std::move(opened.chart);
    std::string warnings;
    const auto warn = [&](const std::vector<std::string>& texts) {
      for (const std::string& text : texts) warnings += (warnings.empty() ? "" : "\n") + text;
    };
    warn(opened.warnings);
    // The one laid on last lies over the others.
    for (auto path = elevations.rbegin(); path != elevations.rend(); ++path) {
      OpenedElevation elevation = open_elevation(*path);
      warn(elevation.warnings);
      source = with_elevation(std::move(source), std::move(elevation.elevation));
    }
    return std::make_shared<SharedChart>(std::move(source), std::move(warnings));
  });
}

}  // namespace skerry::echo::capi
