// StructureIndex: which walls and point objects a ray of a given bearing can meet.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/scene/structures.hpp"
#include "protocol/quantity/geo_point.hpp"

namespace skerry::echo {

// Buckets walls and points by bearing from where the own ship is.  What it offers holds everything
// that echoes on a ray and more; which of it does is decided exactly, so the index never changes
// the result.  Immutable once built.
// Cost: a thing takes as many of the 1024 buckets as it is wide, and the slack's width more.
class StructureIndex {
 public:
  // Good for every own-ship position within `slack_m` of `own_ship`.  Requires structures != null.
  StructureIndex(std::shared_ptr<const Structures> structures, PlanePoint own_ship, double slack_m);

  const Structures& structures() const { return *structures_; }
  bool serves(PlanePoint own_ship) const;

  // Indices, ascending and each once, of what may lie within `reach_units` to either side of that
  // bearing (2^32 units a turn, clockwise from the plane's north).
  void walls_near(std::uint32_t bearing_units, std::uint32_t reach_units,
                  std::vector<std::uint32_t>& found) const;
  void points_near(std::uint32_t bearing_units, std::uint32_t reach_units,
                   std::vector<std::uint32_t>& found) const;

 private:
  struct Span {
    std::int32_t first = 0, last = 0;  // buckets; first may be negative
    std::uint32_t item = 0;
  };
  struct Buckets {
    void fill(std::span<const Span> spans);
    void find(std::uint32_t bearing_units, std::uint32_t reach_units,
              std::vector<std::uint32_t>& found) const;
    std::vector<std::uint32_t> starts, items;
    std::vector<std::uint32_t> near;  // so near that every ray may meet them
  };
  static constexpr std::uint32_t kBuckets = 1024;

  std::shared_ptr<const Structures> structures_;
  PlanePoint own_ship_;
  double slack_m_;
  Buckets walls_, points_;
};

}  // namespace skerry::echo
