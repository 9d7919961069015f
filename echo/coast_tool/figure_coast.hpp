// FigureCoast: one piece of charted coast by every method, as line and as radar echo.
#pragma once

#include "echo/chart/coast_chart.hpp"
#include "echo/fractal/as_printed/printed_coast.hpp"
#include "echo/scene/coast_picture.hpp"
#include "protocol/video/range_scale.hpp"
#include "protocol/video/scan.hpp"

namespace skerry::echo {

// Pictures of the coast around a place, by the chart alone, as Ji et al. 2016 print it and
// corrected.  Thread: one at a time.
class FigureCoast {
 public:
  // The display of Ji et al. 2016: c and L are pixels of it.
  static constexpr double kDisplayPixels = 1000.0;

  // Error: std::invalid_argument where there is no shore of the chart in range.
  FigureCoast(CoastChart chart, GeoPoint place, RangeScale scale);

  GeoPoint place() const { return place_; }
  RangeScale scale() const { return scale_; }
  const std::string& source() const { return chart_.source; }

  // The chart's edges.
  const CoastPicture& straight() const { return *straight_; }
  // Each run of the chart's edges in range refined by itself.  Error: as as_printed::refine().
  CoastPicturePtr printed(const as_printed::Parameters& parameters) const;
  // All kinds of coast refined by one style.  Error: as require_valid().
  CoastPicturePtr corrected(const CoastStyle& style) const;

  // The radar's picture of it: one turn, gain and sea control at their defaults, no traffic.
  Scan scan_of(CoastPicturePtr picture) const;

 private:
  CoastChart chart_;
  GeoPoint place_;
  RangeScale scale_;
  CoastPicturePtr straight_;
};

// The land that an echo chain reads out of a coast, whatever crosses what: ray by ray, from the
// picture's centre.
class LandByRay {
 public:
  static constexpr std::uint32_t kRays = 4096;

  explicit LandByRay(const CoastPicture& picture);
  // At `bearing_deg` clockwise from north and `range_m`.
  bool is_land(double bearing_deg, double range_m) const;

 private:
  struct Stretch {
    double begin_m, end_m;
  };
  std::vector<std::vector<Stretch>> rays_;
};

}  // namespace skerry::echo
