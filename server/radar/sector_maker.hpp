// SectorMaker: from what a radar was given to the spokes of a sector.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "echo/receiver/controls.hpp"
#include "protocol/quantity/time.hpp"
#include "protocol/video/spoke.hpp"
#include "server/core/utc_clock.hpp"
#include "server/core/worker_pool.hpp"
#include "server/radar/airwaves.hpp"
#include "server/radar/picture_maker.hpp"
#include "server/radar/scene_builder.hpp"
#include "server/radar/view_renderers.hpp"

namespace skerry::server {

struct RadarConfig {
  std::uint32_t radar = 0;   // index in the server
  std::size_t own_ship = 0;  // index in the world
  std::string name;
  echo::RadarSet set;
  ScanGeometry geometry;
  echo::ViewControls controls;         // of view 0, at the start
  echo::RadarControls radar_controls;  // at the start
  std::vector<echo::Obstruction> obstructions = {};
  std::uint64_t seed = 0;
};

// The turns a minute of a set as its controls have it.
double rpm_of(const echo::RadarSet& set, const echo::RadarControls& controls);

// A view's number and the controls in force for it.
struct ViewInForce {
  std::uint32_t number = 0;
  echo::ViewControls controls;
  friend bool operator==(const ViewInForce&, const ViewInForce&) = default;
};

// Everything from outside that a sector depends on.
struct SectorInputs {
  echo::RadarControls radar;
  std::vector<ViewInForce> views;  // number 0 first; at least that
  RangeScale on_air;               // view 0's, or still the one before until its coast has come
  WorldStatePtr state;             // of the tick that the sector begins in
  CoastInSightPtr coast;
  EmissionsPtr emissions;  // with its own of this sector
  UtcClock utc;            // what spokes are stamped with
  // The shared view's spokes count from there, where a radar is taken up that has turned before on
  // another host: no number comes twice, as nobody has made more spokes than the antenna has
  // passed.
  std::uint64_t numbered_from = 0;
};

// The spokes of a sector in one view.
struct ViewSector {
  std::uint32_t view = 0;
  Sector sector;
};

// A pure function of its configuration and of the inputs of all sectors made before, in their
// order: two makers that were given the same give the same bytes, whatever the threads, instruction
// sets and clocks.  What it keeps from sector to sector: the antenna's clock, the returns kept
// between turns, the memory of receivers, the numbers of spokes.
// Thread: one at a time.
class SectorMaker {
 public:
  static constexpr std::uint32_t kSectorSpokes = 16;

  // `workers` threads help with each sector (0: none).
  SectorMaker(const RadarConfig& config, std::size_t workers);

  // Before each sector, in order, also of those not made: from spoke `first` on the antenna turns
  // as its controls have it.
  void turn(std::uint64_t first, const echo::RadarControls& controls);
  const echo::SpokeClock& clock() const { return clock_; }

  // The radar's transmission with those controls.
  Emission emission(const echo::RadarControls& controls, RangeScale range) const;

  // The coast it asks for: as far as its rows reach, at most the longest range scale.
  CoastWish wish(const ShipState& own_ship, const std::vector<ViewInForce>& views,
                 std::uint64_t tag) const;

  // Before the first sector: makes what that needs and would make late, some 60 ms for the first
  // radar of a set, less for others like it.
  void warm_up(const SectorInputs& inputs);

  // The same for inputs to come, for another thread: what it returns makes the tables and returns
  // what holds them.  Changes nothing of what make() makes.
  std::function<std::shared_ptr<const void>()> ahead(const SectorInputs& inputs) const;

  // One sector of every view; none in standby.
  void make(std::uint64_t first, const SectorInputs& inputs, std::vector<ViewSector>& out);

 private:
  void take_views(const SectorInputs& inputs);
  echo::RadarFaults faults_of(const SectorInputs& inputs) const;
  void cut_spokes(std::uint64_t first, const SectorInputs& inputs, std::vector<ViewSector>& out);

  RadarConfig config_;
  WorkerPool workers_;
  echo::SpokeClock clock_;
  ScenarioTime bow_passed_{};  // by the beam, at the rate of now
  ViewRenderers renderer_;
  SceneBuilder scenes_;
  std::map<std::uint32_t, std::uint64_t> sequences_;  // of each view's next spoke
  std::uint64_t numbered_from_ = 0;                   // that they heed
};

}  // namespace skerry::server
