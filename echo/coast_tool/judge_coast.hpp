// ThinnedCoast: a fine coast with most of its vertices held back, for methods to be judged by.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/local_plane.hpp"
#include "echo/coast_tool/coast_area.hpp"
#include "echo/fractal/as_printed/printed_coast.hpp"
#include "echo/fractal/clearance.hpp"
#include "echo/fractal/coast_style.hpp"
#include "echo/measure/coast_score.hpp"

namespace skerry::echo {

// Whoever draws between the vertices that are left: the corrected mode by its style (the
// conventional method is the straight style), or Ji et al. 2016 as printed.
struct Contestant {
  std::string name;
  std::variant<CoastStyle, as_printed::Parameters> method;
  bool random() const;  // another seed makes another coast
};

class ThinnedCoast {
 public:
  // Keeps every `keep`th vertex (2 .. 64) of each stretch of shoreline and its ends, which is a
  // nested subset; islands of fewer than 4 keep vertices are left out of both coasts.  Judged are
  // the edges left whose ends both lie in the area.
  // Error: std::runtime_error where there are fewer than 20 of them.
  ThinnedCoast(const CoastChart& chart, const CoastArea& area, int keep);
  ThinnedCoast(const ThinnedCoast&) = delete;
  ThinnedCoast& operator=(const ThinnedCoast&) = delete;

  const CoastChart& fine() const { return fine_; }
  const CoastChart& coarse() const { return coarse_; }
  // The fine coast between the ends of each judged edge; and the edges themselves.
  const CoastPieces& real() const { return real_; }
  CoastPieces chords() const;

  // The coast that the contestant draws, down to details of `detail_m`, in the room that all edges
  // leave each
  // other; as printed, on a display of 1000 pixels across 6 NM.
  CoastPieces drawn_by(const Contestant& contestant, std::uint64_t seed, double detail_m);

  static constexpr double kDisplayPixels = 1000.0, kDisplayRange_m = 3.0 * 1852.0;

 private:
  void thin_ring(const CoastRing& ring, int keep, const CoastArea& area);
  CoastPieces printed(const as_printed::Parameters& parameters, std::uint64_t seed) const;

  LocalPlane plane_;
  CoastChart fine_, coarse_;
  std::vector<ShoreEdge> edges_;
  std::vector<std::uint32_t> judged_;  // indices of edges_
  CoastPieces real_;                   // by judged edge
  Clearance clearance_{{}};
};

}  // namespace skerry::echo
