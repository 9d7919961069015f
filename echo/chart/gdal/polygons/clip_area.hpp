// ClipArea: the part of the Earth where one of several charts is asked.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include <ogr_geometry.h>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/gdal/coverage.hpp"

namespace skerry::echo {

// In a plane of longitude and latitude around a meridian, by GEOS.
class ClipArea {
 public:
  // One for each coverage: what is in it and in none before it.
  // Error: std::runtime_error if GEOS cannot tell them apart.
  static std::vector<ClipArea> of(const std::vector<const Coverage*>& coverages,
                                  double meridian_deg);

  // Appends the parts of `ring` within the area to `out`: the ring itself if all of it is.  Land
  // stays on the left.  An edge or a piece of one keeps its kind and shore, a vertex its identity;
  // what is new along the area's limit is EdgeKind::seam, new vertices lie on multiples of 1e-7
  // degrees and are named by identity_of().
  // Error: std::runtime_error with the reason of GEOS, or that the ring is too tangled
  // (tangle.hpp), and the place of the ring.
  void clip(const CoastRing& ring, std::vector<CoastRing>& out) const;

  // The limit, as far as it is that of a coverage.
  Coverage limit() const;

 private:
  void append_part(const OGRLinearRing& part, bool counter_clockwise, const CoastRing& ring,
                   const std::vector<OGRRawPoint>& laid, std::vector<CoastRing>& out) const;

  double meridian_deg_ = 0.0;
  bool everywhere_ = false;            // all that no coverage before it holds
  std::unique_ptr<OGRGeometry> area_;  // null: nothing
  std::unique_ptr<OGRGeometry> cut_;   // of an area everywhere: what is taken away
  OGREnvelope box_;                    // of area_, or of cut_
  OGRPreparedGeometryUniquePtr prepared_;
};

}  // namespace skerry::echo
