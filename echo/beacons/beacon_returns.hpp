// BeaconReturns: all that answers or sends on the radar's frequency.
#pragma once

#include <memory>
#include <span>

#include "echo/beacons/interference.hpp"
#include "echo/beacons/one_way.hpp"
#include "echo/beacons/racon_returns.hpp"
#include "echo/beacons/sart_returns.hpp"
#include "echo/propagation/propagation.hpp"
#include "echo/radar/antenna_pattern.hpp"
#include "echo/radar/radar_model.hpp"
#include "echo/scene/spoke_aim.hpp"

namespace skerry::echo {

// Racons, SARTs and other radars' pulses of one radar.  Work grows linearly with their number; a
// scene without costs one branch a spoke.  Requires beacons within the ranges of scene/beacons.hpp.
class BeaconReturns {
 public:
  // `pattern`: of model.set; null: made when first needed.
  explicit BeaconReturns(const RadarModel& model,
                         std::shared_ptr<const AntennaPattern> pattern = nullptr);

  // For the spokes from first to last, less than half a turn.  Of `scene`: racons, sarts, emitters
  // and artefacts.interference.  Thread: the radar's.
  void prepare(const Scene& scene, const Propagation& propagation, const SpokeAim& first,
               const SpokeAim& last, const HiddenHeight& hidden = {});

  // Whether there is anything to add in this sector.
  bool any() const { return any_; }

  // Adds power over noise to a spoke of the prepared sector.  `tune_factor`: what the receiver's
  // tune leaves of echoes, already on `power`; racons, which answer on the radar's frequency, lose
  // it too, SARTs and interference do not.  `asked`: whether the
  // own radar transmits on that spoke; where it does not, no beacon answers.  Thread: any, after
  // prepare().
  void add(const SpokeAim& aim, std::span<float> power, float tune_factor = 1.0f,
           bool asked = true) const;

 private:
  RadarModel model_;
  std::shared_ptr<const AntennaPattern> pattern_;
  OneWayLink link_;
  BeamBound bound_;
  RaconReturns racons_;
  SartReturns sarts_;
  Interference interference_;
  bool any_ = false;
};

}  // namespace skerry::echo
