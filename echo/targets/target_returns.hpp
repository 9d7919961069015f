// TargetReturns: ships, buoys, turbines, wakes and cables as points, sector by sector.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"
#include "echo/targets/echo_parts.hpp"
#include "echo/targets/point_echo.hpp"
#include "echo/targets/sector_view.hpp"
#include "echo/targets/ship_figure.hpp"
#include "echo/targets/ship_shadow.hpp"
#include "echo/targets/side_lobe_targets.hpp"
#include "echo/targets/target_medium.hpp"

namespace skerry::echo {

// All powers are signal over noise in the middle of the beam, in this passing of it: fluctuation is
// that of (scene's seed, radar, identity, passing).  Only what may lie under the main lobe within
// the sector is made in detail; what may stand out all round (side lobes, multiple and indirect
// echoes) is kept besides, ships as up to three points along the line of sight.
// Cost: linear in targets.
class TargetReturns {
 public:
  // `propagation` outlives this, or the next set_propagation().
  explicit TargetReturns(const RadarModel& model, const Propagation* propagation = nullptr);
  void set_propagation(const Propagation* propagation);

  // Fills `out` with what spokes first to last (less than half a turn) see in their main lobes.
  // Thread: the radar's.
  void prepare(const Scene& scene, const SpokeAim& first, const SpokeAim& last,
               const HiddenHeight& hidden, std::vector<PointEcho>& out);

  // State of the sector last prepared: all strong targets, those of the sector too; empty if the
  // scene wants neither side lobes nor multiple nor indirect echoes.
  const StrongEchoes& strong() const { return wants_strong_ ? side_lobes_.strong() : none_; }
  // State of the sector last prepared.
  const ShipShadow& shadows() const { return shadows_; }

 private:
  struct Figure {  // a ship's scatterers in one passing, and what they were made for
    std::uint64_t identity = 0, pass_key = 0;
    std::uint32_t along = 0, rows = 0, aspect_step = 0;
    std::vector<ShipScatterer> scatterers;
  };
  struct Sector;

  void add_ship(const Sector& sector, std::uint32_t index);
  void add_wake(const Sector& sector, std::uint32_t index);
  void add_point(const Sector& sector, std::uint32_t index);
  void add_turbine(const Sector& sector, std::uint32_t index);
  void add_cable(const Sector& sector, std::uint32_t index);
  void add_part(const Sector& sector, const EchoPart& part, const Polar& at, std::uint32_t body);
  void add_parts(const Sector& sector, std::uint32_t body);
  float seen(const Sector& sector, const Polar& at, double height_m, std::uint32_t not_by) const;
  const Figure& figure_of(const Hull& hull, std::uint32_t index, ShipDetail detail,
                          std::uint32_t aspect_units, std::uint64_t pass_key);

  RadarModel model_;
  TargetMedium medium_;
  std::uint32_t reach_units_;
  double beam_radians_;
  ShipShadow shadows_;
  SideLobeTargets side_lobes_;
  bool wants_strong_ = false;
  StrongEchoes none_;
  std::vector<Figure> figures_;     // by index of the hull
  std::vector<std::uint32_t> met_;  // hulls that the beam may meet
  std::vector<EchoPart> parts_;
  std::vector<PointEcho>* out_ = nullptr;  // while preparing
};

}  // namespace skerry::echo
