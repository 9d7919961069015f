#include "echo/beacons/second_trace.hpp"

#include <algorithm>
#include <cmath>

#include "echo/kernel/hash.hpp"

namespace skerry::echo {
namespace {

constexpr double kMostTraces = 2.0;  // after the first

}  // namespace

double unambiguous_range(const Pulse& pulse) { return 0.5 * kLightSpeed / pulse.prf_hz; }

double farthest_trace(const Pulse& pulse) { return (kMostTraces + 1.0) * unambiguous_range(pulse); }

void fold_second_trace(const RadarModel& model, std::vector<PointEcho>& points, PrfJitter jitter) {
  const double once = unambiguous_range(model.pulse);
  const double last = model.cell_m * model.geometry.cells;
  const double least = std::min(last, once);
  std::uint64_t number = 0;
  const auto lost = [&](PointEcho& point) {
    if (point.range_m < least) return false;
    const double traces = std::floor(point.range_m / once);
    if (traces < 1.0 || traces > kMostTraces || !(point.power >= kLeastTrace)) return true;
    point.range_m -= traces * once;
    if (jitter.share > 0.0) {
      const double drawn = 2.0 * as_unit(mixed(0x2D72ACE, jitter.key, number++)) - 1.0;
      point.range_m += drawn * std::min(jitter.share, 0.1) * once;
    }
    return point.range_m < 0.0 || point.range_m >= last;
  };
  points.erase(std::remove_if(points.begin(), points.end(), lost), points.end());
}

}  // namespace skerry::echo
