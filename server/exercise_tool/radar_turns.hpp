// RadarTurns: what a radar of an exercise shows, turn by turn, without a server.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "protocol/video/scan.hpp"
#include "server/radar/sector_maker.hpp"
#include "server/replay/exercise_replay.hpp"
#include "server/world/world.hpp"

namespace skerry::server {

// Turns from the present of a world on, which it steps as they pass: a copy, so that the exercise
// itself stays where it is.  A pure function of plan, chart, world and range scale.
// Thread: one at a time.
class RadarTurns {
 public:
  // The plan and the chart must outlive it.  `range` instead of the radar's own scale.
  // Error: std::runtime_error if the chart cannot be read.
  RadarTurns(const ExercisePlan& plan, std::size_t radar, std::optional<RangeScale> range,
             const echo::ChartSource& chart, const World& world);

  // The next whole turn of view 0 that begins when the world is there.
  Scan turn();
  // Lets that much of the exercise pass without making video.
  void pass(Duration time);
  // The world at the end of the last turn.
  const World& world() const { return world_; }
  const RadarConfig& config() const { return config_; }

 private:
  void step_to(ScenarioTime time);
  void see_coast();

  RadarConfig config_;
  SectorMaker maker_;
  PictureMaker pictures_;
  Airwaves airwaves_;
  World world_;
  WorldStatePtr state_;
  SectorInputs given_;
  std::uint64_t next_ = 0;
};

}  // namespace skerry::server
