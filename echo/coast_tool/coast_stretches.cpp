#include "echo/coast_tool/coast_stretches.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "echo/measure/ruler_walk.hpp"
#include "protocol/quantity/plane_geometry.hpp"

namespace skerry::echo {
namespace {

CoastStretch measured_stretch(const PlaneLine& line, double length, const LocalPlane& plane,
                              double from_m, double chord_m) {
  CoastStretch out;
  out.length_m = length;
  const PlanePoint middle = stretch_of(line, 0.0, length / 2.0).back();
  for (PlanePoint p : line) out.radius_m = std::max(out.radius_m, distance(middle, p));
  out.middle = plane.to_geo(middle);
  const double longest = std::min(16.0 * from_m, length / 8.0);
  out.dimension = divider_estimate(divider_lengths(line, 2.0 * from_m, longest));
  const ChordOffsets offsets = chord_offsets(std::vector<PlaneLine>{line}, chord_m, chord_m);
  out.offset = offsets.middle_rms;
  out.offset_error = offsets.middle_error;
  return out;
}

}  // namespace

CoastStretches measure_stretches(const CoastLines& coast, const LocalPlane& plane, double length_m,
                                 double from_m, const Telling& tell) {
  double chord = 2.0 * from_m;
  while (chord < 2.0 * coast.mean_spacing_m) chord *= 2.0;
  CoastStretches out;
  for (const PlaneLine& line : coast.lines) {
    const double length = length_of(line);
    if (length < length_m / 2.0) {
      ++out.left_out;
      out.left_out_m += length;
      continue;
    }
    const double count = std::max(1.0, std::round(length / length_m)), each = length / count;
    for (double k = 0.0; k < count; ++k) {
      tell(fmt::format("stretch {}", out.stretches.size() + 1));
      const PlaneLine stretch = stretch_of(line, k * each, (k + 1.0) * each);
      if (stretch.size() < 2) continue;
      out.stretches.push_back(measured_stretch(stretch, each, plane, from_m, chord));
    }
  }
  return out;
}

}  // namespace skerry::echo
