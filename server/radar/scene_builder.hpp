// SceneBuilder: from where the ships are on Earth to what a radar's rays meet.
#pragma once

#include <cstdint>
#include <memory>

#include "echo/scene/scene.hpp"
#include "server/radar/coast_service.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Lays a WorldState into the plane of a coast picture, as seen from one own ship.
// Thread: one at a time (the radar's).
class SceneBuilder {
 public:
  SceneBuilder(std::size_t own_ship, std::uint64_t seed) : own_ship_(own_ship), seed_(seed) {}

  // The same scene is returned while neither state nor coast has changed.  Where the coast's index
  // no longer serves (the coast thread is behind), it is made here.  Requires a non-null state and
  // coast, and state->own_ships.size() > own_ship.
  echo::ScenePtr build(const WorldStatePtr& state, const CoastInSightPtr& coast);

 private:
  std::size_t own_ship_;
  std::uint64_t seed_;
  WorldStatePtr state_;
  CoastInSightPtr coast_;
  std::shared_ptr<const echo::PolarIndex> own_index_;  // made here for coast_, or null
  std::shared_ptr<const echo::StructureIndex> own_structure_index_;  // the same
  echo::ScenePtr scene_;
};

}  // namespace skerry::server
