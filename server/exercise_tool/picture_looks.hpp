// PictureLooks: which echoes a radar shows at a time of an exercise.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "server/app/land_around.hpp"
#include "server/exercise_tool/echo_stand.hpp"
#include "server/exercise_tool/radar_turns.hpp"

namespace skerry::server {

// Three turns, and up to twelve more, 5 s apart, while a beacon is still waited for: racons answer
// in part of the time only.  What stands out in any of these turns is seen.
class PictureLooks {
 public:
  static constexpr int kTurns = 3, kBeaconTurns = 12;

  // All must outlive it.
  PictureLooks(const ExercisePlan& plan, std::size_t radar, std::optional<RangeScale> range,
               const echo::ChartSource& chart, const World& world);

  // Of a target, racon or SART of the scenario.
  EchoStand seen(const std::string& name);
  LitShares shares(double within_m);
  // The first turn.
  const Scan& first() const { return scans_.front(); }
  const RadarConfig& config() const { return turns_.config(); }

 private:
  // Where it is, in the turn of that state; nothing if it is not on the water.
  std::optional<EchoPlace> place_of(const std::string& name, const WorldState& state) const;
  void look();

  const ExercisePlan& plan_;
  RadarTurns turns_;
  std::unique_ptr<const LandAround> land_;
  std::vector<Scan> scans_;
  std::vector<WorldState> states_;  // at the end of each
};

}  // namespace skerry::server
