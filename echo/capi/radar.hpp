// Radar: one antenna on one coast, told where the ships are.
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "echo/assembly/scene_maker.hpp"
#include "echo/capi/coast.hpp"
#include "echo/spoke_renderer.hpp"

namespace skerry::echo::capi {

struct RadarMount {
  RadarSet set;
  ScanGeometry geometry;
  std::uint32_t number = 0;  // tells the noise of radars apart
};

struct TargetShip {
  ShipMotion motion;
  double length_m = 60.0, beam_m = 11.0, height_m = 10.0;
  std::uint64_t identity = 0;
};

// Places of everything at `time`.
struct ShipPositions {
  ScenarioTime time;
  ShipMotion own_ship;
  std::vector<TargetShip> targets;
};

// The sea as Scene has it.
struct SeaState {
  double water_level_m = 0.0;
  double wave_height_m = 0.0;
};

// Drives a SpokeRenderer: lays the ships into the plane of a coast picture and makes the picture
// and its index anew as the own ship leaves them.  The picture is a function of the calls' values
// alone: made around a position that was set, when half of its slack is used up.
// Thread: one at a time, which holds `in_use`.
class Radar {
 public:
  // A scene is carried on for so long at most.
  static constexpr double kSceneSeconds = 10.0;

  // Requires a valid geometry and a set within kSetLimits (set_checks.hpp).
  Radar(std::shared_ptr<const SharedChart> chart, const CoastRules& rules, const RadarMount& mount);

  std::mutex in_use;

  const ScanGeometry& geometry() const { return mount_.geometry; }
  const ViewControls& controls() const { return renderer_.controls(); }
  const SpokeClock& clock() const { return clock_; }
  // Null before the first scene.
  const ScenePtr& scene() const { return scene_; }
  std::uint64_t coasts_made() const { return view_.coasts_made; }
  std::uint64_t charts_read() const { return view_.charts_read; }

  // Each leaves all as it was where it fails.  Error: CallError CHART.
  void set_controls(const ViewControls& controls);
  void set_sea(const SeaState& sea);
  void set_positions(ShipPositions positions);

  // Error: CallError STATE where no scene is set or the one that is does not serve those spokes.
  void render(std::uint64_t first, std::uint32_t count, std::uint8_t* video, std::size_t stride);

 private:
  // The coast around an own ship for a range scale.
  struct View {
    std::shared_ptr<CoastPreparer> preparer;
    CoastPicturePtr picture;
    CoastIndex index;
    RadarResolution resolution;
    std::uint64_t coasts_made = 0, charts_read = 0;
  };
  View view_for(const ShipMotion& own_ship, RangeScale scale) const;
  ScenePtr scene_of(const ShipPositions& positions, View& view) const;
  void require_served(double from_s, double to_s) const;
  void keep_indexed(double from_s, double to_s);

  std::shared_ptr<const SharedChart> chart_;
  CoastRules rules_;
  RadarMount mount_;
  SpokeClock clock_;
  SpokeRenderer renderer_;
  ShipPositions positions_;
  SeaState sea_;
  View view_;
  ScenePtr scene_;
  std::vector<std::uint8_t> rows_;  // of one sector, for callers whose rows are farther apart
};

}  // namespace skerry::echo::capi
