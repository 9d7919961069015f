// The mean echo of a ship in double: how much a picture of few scatterers differs from many.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "echo/radar/beam.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/targets/ship_figure.hpp"

namespace skerry::echo {

// A ship before the antenna: range of her middle and the radar's bearing from her bow.
struct ShipStudy {
  double length_m = 120.0, beam_m = 18.0, range_m = 4000.0, aspect_deg = 30.0;
  std::uint64_t identity = 1;
};

inline Hull hull_of(const ShipStudy& study) {
  Hull hull;
  hull.length_m = study.length_m, hull.beam_m = study.beam_m, hull.identity = study.identity;
  hull.height_m = 15.0;
  return hull;
}

inline ShipDetail detail_of(const RadarModel& model, const ShipStudy& study,
                            double per_resolution) {
  const double aspect = study.aspect_deg * std::numbers::pi / 180.0;
  const double beam = model.set.beam_width_deg * std::numbers::pi / 180.0;
  return ship_detail(hull_of(study), std::fabs(std::sin(aspect)), std::fabs(std::cos(aspect)),
                     {std::max(1.0, model.pulse_cells) * model.cell_m, study.range_m * beam},
                     per_resolution);
}

// Mean power, of 1 m2 in all, over a patch of spokes (every second one) and cells about the ship.
inline std::vector<double> mean_echo(const RadarModel& model, const ShipStudy& study,
                                     ShipDetail detail) {
  std::vector<ShipScatterer> figure;
  const double aspect = study.aspect_deg * std::numbers::pi / 180.0;
  const auto units = static_cast<std::uint32_t>(study.aspect_deg / 360.0 * 4294967296.0);
  ship_shares(study.identity, detail, units, figure);
  const double pulse = std::max(1.0, model.pulse_cells);
  const double reach_deg = std::atan2(study.length_m, study.range_m) * 57.29577951 + 1.5;
  const int spokes = static_cast<int>(reach_deg / (360.0 / 4096)) | 1;
  const double nearest = study.range_m - study.length_m - 2.0 * model.cell_m;
  const int cells = static_cast<int>((2.0 * study.length_m) / model.cell_m + pulse) + 6;
  const double origin = std::floor(nearest / model.cell_m);
  std::vector<double> patch(static_cast<std::size_t>(spokes + 1) * static_cast<std::size_t>(cells));
  for (const ShipScatterer& s : figure) {
    const double forward = static_cast<double>(s.forward) * study.length_m;
    const double starboard = static_cast<double>(s.starboard) * study.beam_m;
    const double along = study.range_m - forward * std::cos(aspect) - starboard * std::sin(aspect);
    const double right = forward * std::sin(aspect) - starboard * std::cos(aspect);
    const double start = std::hypot(along, right) / model.cell_m - origin;
    const double bearing = std::atan2(right, along) * 57.29577951;
    for (int k = 0; k <= spokes; ++k) {
      const double off = (k - spokes / 2) * 2.0 * (360.0 / 4096) - bearing;
      if (std::fabs(off) > 1.25 * model.set.beam_width_deg) continue;
      const double g = std::pow(cosine_taper_voltage(off, model.set.beam_width_deg), 4);
      const int last = std::min(cells - 1, static_cast<int>(start + pulse));
      for (int c = std::max(0, static_cast<int>(start)); c <= last; ++c) {
        const double share =
            std::min(c + 1.0, start + pulse) - std::max(static_cast<double>(c), start);
        patch[static_cast<std::size_t>(k) * static_cast<std::size_t>(cells) +
              static_cast<std::size_t>(c)] += g * share * static_cast<double>(s.share);
      }
    }
  }
  return patch;
}

// Differences in dB where the reference is within 10 dB of its peak; a cell where the other has
// nothing counts as 40 dB.
inline std::vector<double> decibel_errors(const std::vector<double>& patch,
                                          const std::vector<double>& reference) {
  const double peak = *std::max_element(reference.begin(), reference.end());
  std::vector<double> errors;
  for (std::size_t i = 0; i < patch.size(); ++i) {
    if (reference[i] < 0.1 * peak) continue;
    const double ratio = std::max(1e-4, patch[i] / reference[i]);
    errors.push_back(std::fabs(10.0 * std::log10(ratio)));
  }
  return errors;
}

inline double part_of(std::vector<double>& values, double part) {
  const auto at = static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), values.begin() + at, values.end());
  return values[static_cast<std::size_t>(at)];
}

// Ships, aspects and ranges at which the knob is judged.
inline std::vector<ShipStudy> ship_studies() {
  std::vector<ShipStudy> studies;
  for (const double length : {9.0, 40.0, 120.0, 300.0}) {
    for (const double aspect : {0.0, 25.0, 60.0, 90.0}) {
      for (const double range : {1500.0, 5000.0}) {
        studies.push_back({length, 0.15 * length + 1.5, range + length, aspect,
                           static_cast<std::uint64_t>(length)});
      }
    }
  }
  return studies;
}
inline constexpr ShipDetail kManyScatterers{256, 16};

}  // namespace skerry::echo
