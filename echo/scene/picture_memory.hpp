// PictureMemory: the pictures last made, of which the next one takes what it can use.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "echo/scene/coast_picture.hpp"

namespace skerry::echo {

// A refined edge is the same vertices for the same detail (edge_detail.hpp), wherever the own ship
// is.  Bound: three pictures, 4 million vertices in all (64 MB), and 16 bytes per chart edge and
// picture; a picture of more than that is not kept.
// Thread: one at a time.
class PictureMemory {
 public:
  // The place of an edge in its picture, and its detail.
  struct Place {
    double detail_m = -1.0;   // < 0: not there, or not to be used again
    std::uint32_t first = 0;  // the edge's first vertex after its beginning
    std::uint32_t count = 0;  // vertices after its beginning
  };

  // The vertices after the beginning of that edge, refined to that detail; empty if not known.
  std::span<const PlanePoint> find(std::uint32_t edge, double detail_m) const {
    for (const Kept& kept : kept_) {
      const Place& p = kept.places[edge];
      if (p.detail_m == detail_m) return {kept.picture->vertices.data() + p.first, p.count};
    }
    return {};
  }
  // `places` by edge.  The newest takes the place of the one before it for the same resolution.
  void keep(CoastPicturePtr picture, const RadarResolution& resolution, std::vector<Place> places);

 private:
  struct Kept {
    CoastPicturePtr picture;
    RadarResolution resolution;
    std::vector<Place> places;
  };
  std::vector<Kept> kept_;  // newest first
};

}  // namespace skerry::echo
