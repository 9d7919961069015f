// SceneBuilder: from where the ships are on Earth to what a radar's rays meet.
#pragma once

#include <cstdint>
#include <memory>

#include "echo/scene/scene.hpp"
#include "server/world/world_state.hpp"

namespace skerry::server {

// Lays a WorldState into the plane of a coast picture, as seen from one own ship.  Keeps the polar
// index as long as it serves.  Thread: one at a time (the radar's).
class SceneBuilder {
 public:
  SceneBuilder(std::size_t own_ship, std::uint64_t seed) : own_ship_(own_ship), seed_(seed) {}

  // The same scene is returned while neither state nor coast has changed.  Requires a non-null
  // state and coast, and state->own_ships.size() > own_ship.
  echo::ScenePtr build(const WorldStatePtr& state, const echo::CoastPicturePtr& coast);

 private:
  std::size_t own_ship_;
  std::uint64_t seed_;
  WorldStatePtr state_;
  echo::CoastPicturePtr coast_;
  std::shared_ptr<const echo::PolarIndex> index_;
  echo::ScenePtr scene_;
};

}  // namespace skerry::server
