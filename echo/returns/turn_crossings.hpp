// The crossings of all the rays of a turn with the coast.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "echo/kernel/exact_math.hpp"
#include "echo/returns/coast_crossings.hpp"

namespace skerry::echo {

// Goes along the coast once, and not along the rays: each edge is handed to the rays between its
// ends, so the cost is that of the vertices and of the crossings, and can be spread over time.
// The same crossings as find_crossings() makes, but that a vertex within 2e-6 rad of a ray
// (bearing_sector.hpp) may count to its other side; then the crossing is the vertex itself. Held by
// TurnCrossings.AreThoseOfEachRay.
// Thread: one at a time; of() any, once done().
class TurnCrossings {
 public:
  // Rays of `rays` (a power of two, at most 65536) bearings from the plane's north on, from `at`.
  // Crossings beyond `reach_m` are left out.
  void begin(const CoastPicture& coast, PlanePoint at, std::uint32_t rays, double reach_m);

  // Goes on until `vertices` of the coast have been looked at.  The coast must still be there.
  void work_to(const CoastPicture& coast, std::size_t vertices);
  bool done() const { return done_; }

  // Nearest first.
  void of(std::uint32_t ray, std::vector<Crossing>& crossings) const;
  // The nearest crossing of any ray, metres; reach_m where there is none.
  double nearest_m() const { return nearest_m_; }
  // Whether a crossing of any ray is of a shore that `pred` holds for, by its number in the
  // picture.
  template <typename Pred>
  bool any_of_shore(Pred&& pred) const {
    for (std::size_t shore = 0; shore < shores_met_.size(); ++shore)
      if (shores_met_[shore] && pred(shore)) return true;
    return false;
  }
  std::size_t bytes() const {
    return found_.capacity() * sizeof(OnRay) + sorted_.capacity() * sizeof(Crossing) +
           directions_.capacity() * sizeof(SinCos);
  }

 private:
  struct OnRay {
    std::uint32_t ray;
    Crossing crossing;
  };
  void cross(const CoastPicture& coast, std::uint32_t vertex, std::int32_t from, std::int32_t to);
  void finish();

  PlanePoint at_;
  std::uint32_t rays_ = 0;
  double reach_m_ = 0.0, nearest_m_ = 0.0;
  std::size_t next_ = 0, run_ = 0;
  bool done_ = false;
  std::vector<SinCos> directions_;
  std::vector<std::int32_t> sectors_;
  std::vector<OnRay> found_;
  std::vector<char> shores_met_;
  std::vector<std::uint32_t> starts_;
  std::vector<Crossing> sorted_;
};

}  // namespace skerry::echo
