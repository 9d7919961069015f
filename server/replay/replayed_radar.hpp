// ReplayedRadar: the radar of a recorded exercise, sector by sector.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "server/radar/picture_maker.hpp"
#include "server/radar/sector_maker.hpp"
#include "server/replay/recorded_exercise.hpp"
#include "server/replay/replayed_world.hpp"

namespace skerry::server {

// The inputs contradict each other, or are of another scenario.
struct ReplayError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

// The transmissions of all radars, every version of them.
class EmissionHistory {
 public:
  explicit EmissionHistory(std::size_t radars) : airwaves_(radars), versions_{airwaves_.get()} {}
  std::uint64_t latest() const { return versions_.size() - 1; }
  EmissionsPtr at(std::uint64_t version) const { return versions_.at(version); }
  // True if that made a new version.
  bool set(std::size_t radar, const Emission& emission) {
    const Airwaves::Set made = airwaves_.set(radar, emission);
    if (made.changed) versions_.push_back(made.emissions);
    return made.changed;
  }

 private:
  Airwaves airwaves_;
  std::vector<EmissionsPtr> versions_;
};

// Thread: one at a time.
class ReplayedRadar {
 public:
  // All must outlive it.  Error: ReplayError if inputs have values that no control can have.
  ReplayedRadar(const RadarConfig& config, std::size_t workers, const RadarInputs& inputs,
                const echo::ChartSource& chart, const echo::CoastRules& rules,
                EmissionHistory& emissions);

  // Asks as RadarServer does before its start; the world is at time 0.
  // Error: std::runtime_error if the chart cannot be read; ReplayError.
  void ask_for_coast(const WorldState& state);
  void warm_up(const WorldStatePtr& state);

  bool is_done() const { return next_ >= inputs_.end; }
  ScenarioTime next_time() const { return maker_.clock().time_of(next_); }
  // The other radars have gone far enough for the next sector, and not too far.
  bool is_ready() const;
  // Makes the next sector, or passes over one that was skipped (then `out` is empty).
  // Requires is_ready().  Error: ReplayError.
  void step(ReplayedWorld& world, UtcTime epoch, std::vector<ViewSector>& out);

 private:
  const recording::Input::Taken* taken_at(std::uint64_t first) const;
  void take(const recording::Input::Taken& taken);
  void see_coast(const PictureOrigin& origin);
  const CoastWish& wish_of(std::uint64_t tag) const;

  const RadarConfig& config_;
  const RadarInputs& inputs_;
  EmissionHistory& emissions_;
  SectorMaker maker_;
  PictureMaker pictures_;
  std::set<std::uint64_t> wanted_;             // tags of wishes that pictures came of
  std::map<std::uint64_t, CoastWish> wishes_;  // of these
  std::optional<std::uint64_t> laid_;
  std::optional<PictureOrigin> coast_wanted_;  // not yet in given_
  std::optional<std::uint64_t> emissions_wanted_;
  std::optional<UtcClock> utc_;  // none: as the exercise began
  SectorInputs given_;
  std::uint64_t next_ = 0;
};

}  // namespace skerry::server
