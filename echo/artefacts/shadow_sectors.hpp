// OwnShipGain: what the own ship's masts and blanked sectors leave of each bearing.
#pragma once

#include <cstdint>
#include <vector>

#include "echo/radar/radar_model.hpp"
#include "echo/scene/scene.hpp"

namespace skerry::echo {

// A table over the bearing from the bow, made when the rig changes: the product of the shadows of
// all obstructions (strip_shadow.hpp), whose geometric width is 2 atan(width / 2 distance). Blanked
// sectors are exact: from one side to the other, both included, through the bow where `from` is the
// greater.  The first kMostObstructions and kMostBlanked count.
// Error: linear between 8192 bearings (0.044 deg).
// Thread: prepare() the radar's; the rest any.
class OwnShipGain {
 public:
  static constexpr std::size_t kMostObstructions = 32, kMostBlanked = echo::kMostBlanked;

  explicit OwnShipGain(const RadarModel& model);

  // Cost: nothing while the rig stays as it is; else a millisecond or so for each obstruction.
  void prepare(const Scene& scene);

  // Whether there is anything to multiply by at all.
  bool any() const { return !table_.empty() || !blanked_.empty(); }

  // Power factor on what comes back of the own pulse, in [0, 3.6]; 0 where the transmitter is off.
  float two_way(std::uint32_t relative_units) const;
  // Power factor on what others send; the receiver hears in blanked sectors too.
  float one_way(std::uint32_t relative_units) const;
  // False in a blanked sector: no echo comes, and no racon is asked.
  bool transmits(std::uint32_t relative_units) const;

 private:
  struct Sector {
    std::uint32_t from_units, width_units;
  };
  void lay_shadows();

  double wavelength_m_, antenna_m_;
  std::vector<Obstruction> obstructions_;
  std::vector<BlankedSector> asked_blanked_;
  std::vector<Sector> blanked_;
  std::vector<float> table_;  // one-way, by bearing; empty: nothing shadows
};

}  // namespace skerry::echo
