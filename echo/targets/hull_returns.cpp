#include "echo/targets/hull_returns.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/hash.hpp"
#include "echo/radar/radar_equation.hpp"

namespace skerry::echo {

double ship_cross_section(double length_m, double beam_m, double frequency_hz) {
  const double tonnes = 1.025 * 0.7 * length_m * beam_m * (0.4 * beam_m);
  const double kilotonnes = tonnes * 1e-3;
  return 52.0 * std::sqrt(frequency_hz * 1e-6) * kilotonnes * std::sqrt(kilotonnes);
}

double aspect_factor(double aspect_degrees) {
  const double side = std::fabs(sin_cos_degrees(aspect_degrees).sin);
  const double lobe = side * side;
  const double lobe4 = lobe * lobe, lobe16 = lobe4 * lobe4 * lobe4 * lobe4;
  return 1.0 + 9.0 * lobe16;
}

void scatterers_of(const Hull& hull, PlanePoint own_ship, double dt, double antenna_height_m,
                   double frequency_hz, double resolution_m, std::vector<Scatterer>& out) {
  out.clear();
  const PlanePoint centre = hull.centre + hull.velocity * dt - own_ship;
  const SinCos bow = sin_cos_degrees(hull.heading_deg + hull.turn_rate_deg_s * dt);
  const double centre_range =
      std::sqrt(centre.east_m * centre.east_m + centre.north_m * centre.north_m);
  const double hidden = hidden_height(centre_range, antenna_height_m);
  if (hidden >= hull.height_m) return;

  const double line_of_sight =
      exact_atan2(centre.east_m, centre.north_m) * (180.0 / std::numbers::pi);
  const double aspect = line_of_sight + 180.0 - hull.heading_deg;
  const double total = ship_cross_section(hull.length_m, hull.beam_m, frequency_hz) *
                       aspect_factor(aspect) * (1.0 - hidden / hull.height_m);

  const int along =
      std::clamp(static_cast<int>(hull.length_m / std::max(resolution_m, 1.0)) + 2, 4, 80);
  const int across = hull.beam_m > resolution_m ? 3 : 1;
  double weight_sum = 0.0;
  for (int i = 0; i < along; ++i) {
    const double t = (i + 0.5) / along - 0.5;  // -1/2 stern .. 1/2 bow
    for (int j = 0; j < across; ++j) {
      const double s = across == 1 ? 0.0 : 0.5 * (j - 1);
      // The rails run together toward the bow.
      const double taper = 1.0 - std::max(0.0, 4.0 * t - 1.0);
      const double forward = t * hull.length_m, starboard = s * hull.beam_m * taper;
      const PlanePoint p{centre.east_m + forward * bow.sin + starboard * bow.cos,
                         centre.north_m + forward * bow.cos - starboard * bow.sin};
      const double house = t > -0.4 && t < -0.15 ? 3.0 : 1.0;
      const double weight =
          house *
          (0.4 + 1.2 * as_unit(mixed(hull.identity, static_cast<std::uint64_t>(i * 3 + j))));
      weight_sum += weight;
      out.push_back({std::sqrt(p.east_m * p.east_m + p.north_m * p.north_m),
                     exact_atan2(p.east_m, p.north_m), weight});
    }
  }
  for (Scatterer& s : out) s.cross_section_m2 *= total / weight_sum;
}

}  // namespace skerry::echo
