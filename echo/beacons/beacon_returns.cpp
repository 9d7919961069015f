#include "echo/beacons/beacon_returns.hpp"

#include <utility>

namespace skerry::echo {

BeaconReturns::BeaconReturns(const RadarModel& model, std::shared_ptr<const AntennaPattern> pattern)
    : model_(model),
      pattern_(std::move(pattern)),
      link_(model),
      bound_(model.set),
      interference_(model) {}

void BeaconReturns::prepare(const Scene& scene, const Propagation& propagation,
                            const SpokeAim& first, const SpokeAim& last,
                            const HiddenHeight& hidden) {
  any_ = false;
  if (scene.racons.empty() && scene.sarts.empty() && scene.emitters.empty()) return;
  if (!pattern_) pattern_ = antenna_pattern_for(model_.set);
  const Listening at{scene,
                     model_,
                     link_,
                     bound_,
                     propagation,
                     hidden,
                     Sector(first.plane_units, last.plane_units),
                     SectorView(first, last, bound_.main_units())};
  racons_.prepare(at);
  sarts_.prepare(at);
  interference_.prepare(at, first.spoke, last.spoke);
  any_ = racons_.any() || sarts_.any() || interference_.any();
}

void BeaconReturns::add(const SpokeAim& aim, std::span<float> power, float tune_factor,
                        bool asked) const {
  if (!any_) return;
  if (asked) {
    racons_.add(*pattern_, aim, tune_factor, power);
    sarts_.add(*pattern_, aim, power);
  }
  interference_.add(*pattern_, aim, power);
}

}  // namespace skerry::echo
