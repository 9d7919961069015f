#include "echo/beacons/far_coast.hpp"

#include <algorithm>
#include <cmath>

#include "echo/beacons/second_trace.hpp"
#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/targets/sector_view.hpp"
#include "protocol/quantity/bearing.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

constexpr double kNoShore = 1e300;

// The nearest shore of each bearing.
class Nearest {
 public:
  Nearest(double width_deg, double from_m, double to_m)
      : bins_(static_cast<std::uint32_t>(std::ceil(360.0 / width_deg))),
        from_m_(from_m),
        to_m_(to_m),
        range_(bins_, kNoShore) {}

  void lay(PlanePoint a, PlanePoint b) {
    if (std::max(length_of(a), length_of(b)) < from_m_) return;
    if (distance_to_segment({0.0, 0.0}, a, b) > to_m_) return;
    const Polar from = polar_of(a), to = polar_of(b);
    const auto turn = static_cast<std::int32_t>(to.units - from.units);
    const double bins_crossed = std::fabs(turn / kUnitsPerTurn) * bins_;
    const auto steps = static_cast<std::uint32_t>(std::min(2.0 * bins_crossed, 2.0 * bins_)) + 1;
    for (std::uint32_t i = 0; i <= steps; ++i) {
      const Polar at = polar_of(a + (b - a) * (double{1} * i / steps));
      if (at.range_m < from_m_ || at.range_m > to_m_) continue;
      double& nearest = range_[bin_of(at.units)];
      nearest = std::min(nearest, at.range_m);
    }
  }

  std::uint32_t bins() const { return bins_; }
  double range(std::uint32_t bin) const { return range_[bin]; }
  std::uint32_t bearing_units(std::uint32_t bin) const {
    return static_cast<std::uint32_t>(((2 * std::uint64_t{bin} + 1) << 31) / bins_);
  }

 private:
  std::uint32_t bin_of(std::uint32_t units) const {
    return static_cast<std::uint32_t>((std::uint64_t{units} * bins_) >> 32);
  }

  std::uint32_t bins_;
  double from_m_, to_m_;
  std::vector<double> range_;
};

}  // namespace

void far_coast_points(const RadarModel& model, const Propagation& propagation,
                      const CoastPicture& coast, PlanePoint own_ship, const FarCoast& far,
                      std::vector<PointEcho>& points) {
  const double from = far.nearest_m > 0.0 ? far.nearest_m : unambiguous_range(model.pulse);
  const double to = far.farthest_m > 0.0 ? far.farthest_m : farthest_trace(model.pulse);
  Nearest nearest(std::clamp(0.5 * model.set.beam_width_deg, 0.1, 5.0), from, to);
  for (std::size_t run = 0; run + 1 < coast.run_starts.size(); ++run) {
    for (std::uint32_t v = coast.run_starts[run]; v + 1 < coast.run_starts[run + 1]; ++v)
      nearest.lay(coast.vertices[v] - own_ship, coast.vertices[v + 1] - own_ship);
  }
  const double gamma = ratio_from_decibels(far.gamma_db);
  const double arc = kRadiansPerTurn / nearest.bins();
  for (std::uint32_t bin = 0; bin < nearest.bins(); ++bin) {
    const double range = nearest.range(bin);
    if (range == kNoShore) continue;
    const double sigma = gamma * far.height_m * range * arc;
    const double body = static_cast<double>(propagation.body(range, far.height_m));
    PointEcho point;
    point.range_m = range;
    point.bearing_units = nearest.bearing_units(bin);
    point.power =
        static_cast<float>(model.unit_snr * sigma * body / (range * range * range * range));
    if (!(point.power >= kLeastTrace)) continue;
    point.phase = static_cast<float>(as_unit(mixed(0xFA7C0A57, bin)));
    point.body = body_of(BodyKind::far_coast, bin);
    point.height_m = static_cast<float>(far.height_m);
    points.push_back(point);
  }
}

}  // namespace skerry::echo
