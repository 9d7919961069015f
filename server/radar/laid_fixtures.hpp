// LaidFixtures: what a scenario has that stands still, in the plane of a coast picture.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/chart/local_plane.hpp"
#include "echo/scene/scene.hpp"
#include "server/world/scenario.pb.h"

namespace skerry::server {

// Whose echoes fluctuate alike wherever they are seen from: a number for each kind and entry.
enum class Fixture : std::uint8_t { small_target, turbine, cable, racon, sart, rain, emitter };
inline constexpr std::uint64_t kFirstTargetEmitter = 1000;  // those of own ships count from 0
std::uint64_t identity_of(std::uint64_t seed, Fixture kind, std::uint64_t number);

// A small target without its place.
echo::PointTarget point_of(const scenario::Target& target, std::uint64_t seed, std::size_t number);

// Small targets without way, wind turbines, cables and racons within the plane's reach.
// Immutable once made; laid anew with the plane.
class LaidFixtures {
 public:
  LaidFixtures(const scenario::Scenario& scenario, std::uint64_t seed,
               const echo::LocalPlane& plane);

  // Adds those within `reach_m` of the scene's own ship.
  void add_to(echo::Scene& scene, double reach_m) const;

 private:
  std::vector<echo::PointTarget> points_;
  std::vector<echo::WindTurbine> turbines_;
  std::vector<echo::OverheadCable> cables_;
  std::vector<echo::Racon> racons_;
};

// Within the degrees of latitude and longitude where the plane is good
// (echo/chart/local_plane.hpp).
bool in_plane(const echo::LocalPlane& plane, GeoPoint place);

}  // namespace skerry::server
