// RainMap: where in an area how much rain falls, for some seconds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "echo/kernel/rain_grid.hpp"
#include "echo/rain/rain_form.hpp"
#include "echo/scene/weather.hpp"

namespace skerry::echo {

// The field of an area stays for so many seconds, 1 to 20 by its radius, and is then renewed.
// What changes from step to step is 0.15 octaves (root mean square) at most; held by
// RainMap.ChangesLittleFromStepToStep.
double rain_step(double radius_m);

// All that a map is made of; drift is none of it.
struct RainMapKey {
  std::uint64_t identity = 0;
  RainKind kind = RainKind::cell;
  double radius_m = 2000.0;
  std::int64_t step = 0;
  friend bool operator==(const RainMapKey&, const RainMapKey&) = default;
};
// Of an area at a scenario time.  Areas change their steps at different times.
RainMapKey rain_map_key(const RainCell& cell, double seconds);

// Share of the area's rate on a lattice along the form's axis (columns) and to the right of it
// (rows): 2^(spread * grains + outline) - 2^least, so log-normal inside and ragged at the edge,
// then scaled so that the mean where it rains is 1.  The grains flatten out at 2.8 standard
// deviations.  The lattice has 64 to 512 values along, 75 m apart where that suffices; its border
// is dry.  Coarser levels hold the means of 2 by 2 values, for beams wider than a value.
//
// Immutable; any thread.
class RainMap {
 public:
  explicit RainMap(const RainMapKey& key);

  const RainMapKey& key() const { return key_; }
  const RainForm& form() const { return form_; }
  // 0 is the finest; value (i, k) of level l lies at ((i + 0.5) 2^l - 0.5, ...) of the finest.
  std::size_t levels() const { return levels_.size(); }
  GridView level(std::size_t l) const;
  // Of the finest level, metres.
  double column_m() const { return column_m_; }
  double row_m() const { return row_m_; }
  double greatest() const { return greatest_; }    // share
  double wet_share() const { return wet_share_; }  // of the map
  SinCos turn() const { return turn_; }            // of the axis, by the identity

 private:
  struct Level {
    std::uint32_t columns, rows;
    std::vector<float> values;
  };
  void scale();
  void add_coarser_levels();

  RainMapKey key_;
  const RainForm& form_;
  std::vector<Level> levels_;
  double column_m_ = 1.0, row_m_ = 1.0, greatest_ = 0.0, wet_share_ = 0.0;
  SinCos turn_;
};
using RainMapPtr = std::shared_ptr<const RainMap>;

// The map of a key, made when it is first asked for.  An area's present map and the one before are
// kept, of 128 areas or 64 MiB at most.  Thread: any.
RainMapPtr rain_map_for(const RainMapKey& key);

}  // namespace skerry::echo
