// A run of one of the four scenarios of A.823(19) on video that Skerry's own echo renders.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "echo/radar/radar_set.hpp"
#include "server/plotter/plotter.hpp"
#include "tests/unit/plotter/standard_scenarios.hpp"

namespace skerry::server {

// Where the errors of the sensors come from:
//   by the echo: how a hull of 200 m by 30 m glints and fades, the beam, the pulse, noise, the
//   cells
//     and spokes that quantise range and bearing, and roll: what +-10 deg do to bearings (none
//     ahead and abeam, mean and amplitude .22 deg on the quarters, at twice the roll's frequency)
//     and how far the antenna swings.  The sea is calm.
//   by what spokes say: the gyro's constant .5 deg and sigma .12 deg, backlash +-.05 deg and the
//     encoder's sigma .03 deg, both new at each passing of the antenna; and own ship's place, which
//     is reckoned by gyro and log (constant .5 kn, sigma .067 kn).
struct RenderedRadar {
  echo::RadarSet set;  // 25 kW X, beam 1.2 deg, 24 rpm
  // On the range scale of 12 NM (scale_of()) they quantise as A.823 has it, +-.1 deg and +-.01 NM.
  std::uint32_t spokes = 1800, cells = 600;
  bool errors = true;  // false: all but what the echo does to a ship that lies still is left out
};

// The range scale that it is seen on.
RangeScale scale_of(const StandardScenario& scenario);

// Everything is acquired; and the plotter is told how long the pulse is, instead of learning it.
Plotter::Rule rule_of_all();
Plotter::Rule rule_knowing_the_pulse(const StandardScenario& scenario, const RenderedRadar& radar);

// A plot of the target against where her middle was.
struct PlotError {
  double far_m = 0.0, right_m = 0.0;  // of the plot from the truth, along the range and across
  double range_sigma_m = 0.0, right_sigma_m = 0.0;  // as the plot tells them
};

struct RenderedResult {
  std::vector<double> track;  // as errors_of() has them; empty: none of the target
  std::vector<double> line;   // the same of a straight line through her plots; empty: no plots
  std::vector<PlotError> plots;
  int turns = 0, pieces = 0;  // the antenna passed her; plots of her beside the largest
  int false_tracks = 0;       // shown at the end, farther off than she may be
};

// From `minutes` before the scenario's end, with errors of this seed.  Rendered is a sector of 15
// deg on either side of the target; other spokes are empty.
RenderedResult rendered_run(const StandardScenario& scenario, double minutes, std::uint64_t seed,
                            const RenderedRadar& radar, const Plotter::Rule& rule);

}  // namespace skerry::server
