// CoastKeeper: asks for the coast of one slot in time, for whoever looks at it.
#pragma once

#include "protocol/quantity/time.hpp"
#include "server/radar/coast_service.hpp"

namespace skerry::server {

// Asks when the own ship has used up half of what there is, or when another resolution is wanted;
// again only when that has not come within kPatience (the chart could not be read).
// Thread: one at a time, the one that looks.
class CoastKeeper {
 public:
  static constexpr Duration kPatience = std::chrono::seconds(5);

  // The service must outlive it.
  CoastKeeper(CoastService& coast, std::size_t slot) : coast_(coast), slot_(slot) {}

  // From now on; what is there, if anything is, was made for `resolution`.
  void begin(const echo::RadarResolution& resolution);
  // `now` is the scenario time of the wish.
  void look_after(const CoastWish& wish, ScenarioTime now);
  // May be null in a slot of which nothing has been made ready before the service started.
  CoastInSightPtr latest() const { return coast_.latest(slot_); }
  // A wish may yet be answered.
  bool is_waiting(ScenarioTime now) const { return now - asked_at_ < kPatience; }

 private:
  CoastService& coast_;
  std::size_t slot_;
  CoastInSightPtr asked_after_;  // what was there at the last wish
  echo::RadarResolution asked_for_;
  ScenarioTime asked_at_{};
};

}  // namespace skerry::server
