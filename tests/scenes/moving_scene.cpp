#include "tests/scenes/moving_scene.hpp"

#include <utility>

namespace skerry::scenes {
namespace {

constexpr Duration kTick = std::chrono::milliseconds(100);
constexpr double kIndexSlack = 50.0;

}  // namespace

MovingScene::MovingScene(echo::ScenePtr start) : start_(std::move(start)), now_(start_) {}

echo::ScenePtr MovingScene::at(ScenarioTime time) {
  const ScenarioTime tick = start_->time + kTick * ((time - start_->time) / kTick);
  if (now_->time == tick) return now_;
  auto next = std::make_shared<echo::Scene>(*start_);
  const double dt = in_seconds(tick - start_->time);
  next->time = tick;
  next->own_ship = start_->own_ship + start_->own_velocity * dt;
  next->own_ship_geo = next->coast->plane.to_geo(next->own_ship);
  next->true_north_deg = next->coast->plane.true_north_degrees(next->own_ship_geo);
  next->heading_deg = start_->heading_deg + start_->turn_rate_deg_s * dt;
  const auto move = [dt](auto& things, auto place) {
    for (auto& thing : things) thing.*place = thing.*place + thing.velocity * dt;
  };
  for (echo::Hull& hull : next->hulls) hull.heading_deg += hull.turn_rate_deg_s * dt;
  move(next->hulls, &echo::Hull::centre);
  move(next->points, &echo::PointTarget::place);
  move(next->sarts, &echo::Sart::place);
  move(next->emitters, &echo::Emitter::place);
  move(next->rain, &echo::RainCell::centre);
  next->index = now_->index;
  next->structure_index = now_->structure_index;
  if (!next->index->serves(next->own_ship) ||
      !next->index->serves(next->own_ship + next->own_velocity * 0.5)) {
    next->index =
        std::make_shared<const echo::PolarIndex>(*next->coast, next->own_ship, kIndexSlack);
    if (next->coast->structures) {
      next->structure_index = std::make_shared<const echo::StructureIndex>(
          next->coast->structures, next->own_ship, kIndexSlack);
    }
  }
  return now_ = std::move(next);
}

}  // namespace skerry::scenes
