#include "echo/scene/spoke_aim.hpp"

#include "protocol/quantity/bearing.hpp"

namespace skerry::echo {

SpokeAim aim_of(const Scene& scene, const SpokeClock& clock, std::uint64_t spoke) {
  const std::uint32_t turn = clock.spokes_per_turn();
  SpokeAim aim;
  aim.spoke = spoke;
  aim.scan = static_cast<std::uint32_t>(spoke / turn);
  aim.index = static_cast<std::uint32_t>(spoke % turn);
  aim.dt = in_seconds(clock.time_of(spoke) - scene.time);
  aim.shown_units = RelativeBearing::of_spoke(aim.index, turn).units();
  aim.relative_units =
      aim.shown_units - RelativeBearing::from(degrees(scene.bearing_alignment_deg)).units();
  const Angle heading = degrees(scene.heading_deg + scene.turn_rate_deg_s * aim.dt);
  aim.true_units = aim.relative_units + TrueBearing::from(heading).units();
  aim.plane_units = aim.true_units + TrueBearing::from(degrees(scene.true_north_deg)).units();
  aim.own_ship = scene.own_ship + scene.own_velocity * aim.dt;
  return aim;
}

}  // namespace skerry::echo
