#include "tests/scenes/without.hpp"

#include <memory>
#include <utility>

namespace skerry::scenes {

NamedScene with(const NamedScene& named, const std::function<void(echo::Scene&)>& change) {
  NamedScene other = named;
  auto scene = std::make_shared<echo::Scene>(*named.scene);
  change(*scene);
  other.scene = std::move(scene);
  return other;
}

void no_sea(echo::Scene& scene) {
  scene.sea.state = 0.0;
  scene.wave_height_m = 0.0;
}

void no_land(echo::Scene& scene) {
  auto bare = std::make_shared<echo::CoastPicture>(*scene.coast);
  bare->vertices.clear();
  bare->run_starts.clear();
  bare->edge_shores.clear();
  scene.index = std::make_shared<const echo::PolarIndex>(*bare, scene.own_ship, 50.0);
  scene.coast = std::move(bare);
  scene.structure_index = nullptr;
}

void no_rain(echo::Scene& scene) { scene.rain.clear(); }

void no_targets(echo::Scene& scene) {
  scene.hulls.clear();
  scene.points.clear();
}

}  // namespace skerry::scenes
