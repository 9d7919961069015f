// SceneBuilder: from where things are on Earth to what a radar's rays meet.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "echo/scene/scene.hpp"
#include "server/radar/airwaves.hpp"
#include "server/radar/coast_service.hpp"
#include "server/radar/laid_fixtures.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Whose scene it is.
struct SceneRole {
  std::size_t own_ship = 0;  // index in the world
  std::size_t radar = 0;     // index in the server
  echo::Band band = echo::Band::x;
  std::uint64_t seed = 0;
  std::vector<echo::Obstruction> obstructions = {};
};

// Lays a WorldState into the plane of a coast picture, as seen from one own ship.  What is out of
// reach is left out: echoes from beyond twice the range and 1 km, unless ducting brings them in as
// second-trace echoes (then 150 NM); other radars from beyond 60 NM (then 150 NM).  Radars of the
// same ship do not interfere: their triggers are tied.
// Thread: one at a time (the radar's).
class SceneBuilder {
 public:
  explicit SceneBuilder(SceneRole role) : role_(std::move(role)) {}

  // Changes the parts of the rig that can change under way; no sectors and 0 at first.
  void set_rig(const std::vector<echo::BlankedSector>& blanked, double bearing_alignment_deg);

  // The same scene is returned while neither state, coast, rig nor what others have on the air has
  // changed.  Where the coast's index no longer serves (the coast thread is behind), it is made
  // here.  Requires a non-null state, coast and emissions, and state->own_ships.size() > own_ship.
  echo::ScenePtr build(const WorldStatePtr& state, const CoastInSightPtr& coast,
                       const EmissionsPtr& emissions);

 private:
  struct Reach {
    double echoes_m;
    double emitters_m;
  };
  static Reach reach_of(const WorldState& state, double range_m);
  void lay_own_ship(const WorldState& state, const echo::LocalPlane& plane,
                    echo::Scene& scene) const;
  void find_coast(const CoastInSightPtr& coast, echo::Scene& scene);
  void lay_ships(const WorldState& state, const echo::LocalPlane& plane, const Reach& reach,
                 echo::Scene& scene) const;
  void lay_emitters(const WorldState& state, const std::vector<Emission>& emissions,
                    const echo::LocalPlane& plane, const Reach& reach, echo::Scene& scene) const;

  SceneRole role_;
  std::vector<echo::BlankedSector> blanked_;
  double bearing_alignment_deg_ = 0.0;
  WorldStatePtr state_;
  CoastInSightPtr coast_;
  EmissionsPtr emissions_;
  echo::CoastIndex own_index_;            // made here for coast_, or empty
  std::optional<LaidFixtures> fixtures_;  // in the plane of ...
  GeoPoint fixtures_anchor_;
  echo::ScenePtr scene_;
};

}  // namespace skerry::server
