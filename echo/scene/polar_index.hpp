// PolarIndex: which coast edges a ray of a given bearing can meet.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "echo/scene/coast_picture.hpp"

namespace skerry::echo {

// Buckets the edges of a picture by bearing from where the own ship is.  A candidate list holds
// every edge a ray can cross, and some it does not; crossing is then decided exactly, so the index
// never changes the result.  Immutable once built.
class PolarIndex {
 public:
  // Good for every own-ship position within `slack_m` of `own_ship`.
  PolarIndex(const CoastPicture& picture, PlanePoint own_ship, double slack_m);

  bool serves(PlanePoint own_ship) const;

  // First vertices of the candidate edges for a ray of that bearing (2^32 units a turn, clockwise
  // from the plane's north).
  std::span<const std::uint32_t> candidates(std::uint32_t bearing_units) const;
  // Edges so near that every ray may meet them.
  std::span<const std::uint32_t> near_edges() const { return near_; }

 private:
  static constexpr std::uint32_t kBuckets = 4096;
  PlanePoint own_ship_;
  double slack_m_;
  std::vector<std::uint32_t> starts_;
  std::unique_ptr<std::uint32_t[]> edges_;
  std::vector<std::uint32_t> near_;
};

}  // namespace skerry::echo
