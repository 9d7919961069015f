#include "server/radar/set_faults.hpp"

#include "echo/kernel/hash.hpp"

namespace skerry::server {

echo::RadarFaults radar_faults(const ShipState& own_ship) {
  if (own_ship.faults == nullptr) return {};
  const wire::Faults& faults = own_ship.faults->faults;
  return {.power_loss_db = faults.radar_power_loss_db(),
          .detuned_db = faults.radar_detuned_db(),
          .noise_db = faults.radar_noise_db(),
          .range_error_m = faults.radar_range_error_m(),
          .blind_from_deg = faults.radar_blind_from_deg(),
          .blind_width_deg = faults.radar_blind_width_deg(),
          .trigger_lost = faults.radar_trigger_lost() || faults.blackout()};
}

bool loses_spoke(const ShipState& own_ship, std::uint64_t seed, std::uint32_t radar,
                 std::uint64_t n) {
  if (own_ship.faults == nullptr) return false;
  const wire::Faults& faults = own_ship.faults->faults;
  if (faults.blackout()) return true;
  const double share = faults.radar_spoke_loss_percent() / 100.0;
  return share > 0.0 && echo::as_unit(echo::mixed(echo::mixed(seed, 0x10575B0E), radar, n)) < share;
}

}  // namespace skerry::server
