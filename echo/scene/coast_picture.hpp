// CoastPicture: the refined coast around an own ship, ready to be crossed by rays.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "echo/chart/coast_chart.hpp"
#include "echo/chart/cover_grid.hpp"
#include "echo/chart/local_plane.hpp"
#include "echo/scene/beacons.hpp"
#include "echo/scene/coast_rules.hpp"
#include "echo/scene/picture_shore.hpp"
#include "echo/scene/structures.hpp"

namespace skerry::echo {

// The coast in range, as runs of vertices in a plane, land on the left of each run.  Immutable.
struct CoastPicture {
  LocalPlane plane;
  PlanePoint centre;           // where the own ship was when it was made
  double slack_m = 0.0;        // good while the own ship is within this of `centre`
  double range_m = 0.0;        // all coast within range_m + slack_m of `centre` is present
  bool centre_ashore = false;  // the centre lies on land
  std::vector<PlanePoint> vertices;
  std::vector<std::uint32_t> run_starts;  // run r is vertices [run_starts[r], run_starts[r+1])
  std::vector<PictureShore> shores = {PictureShore{}};  // at most 256 kinds; [0] is PictureShore{}
  std::vector<std::uint8_t> edge_shores = {};           // by first vertex; empty: shores[0] for all
  std::shared_ptr<const Structures> structures = nullptr;    // null: none in range
  std::vector<Racon> racons = {};                            // charted ones in range
  std::shared_ptr<const ElevationGrid> elevation = nullptr;  // null: relief is synthesised
  std::shared_ptr<const CoverGrid> cover = nullptr;          // null: no chart tells
  std::uint8_t shore_of(std::uint32_t edge) const {
    return edge_shores.empty() ? std::uint8_t{0} : edge_shores[edge];
  }
  std::uint32_t edge_count() const {
    return static_cast<std::uint32_t>(vertices.size() -
                                      (run_starts.empty() ? 0 : run_starts.size() - 1));
  }
};
using CoastPicturePtr = std::shared_ptr<const CoastPicture>;

// The lengths that the radar can tell apart, which decide where refinement stops
// (DetailLimit::visible_m).
struct RadarResolution {
  double range_m = 0.0;  // range scale
  double cell_m = 1.0;
  double spoke_degrees = 0.1;
  friend bool operator==(const RadarResolution&, const RadarResolution&) = default;
};

// A chart window laid into a plane, from which pictures are made as the own ship moves.  A picture
// is a function of chart, anchor, rules, own ship and resolution alone; what was made before is
// used again where it is the same (edge_detail.hpp, picture_memory.hpp), and changes nothing.
// Thread: one at a time.
class CoastPreparer {
 public:
  // Error: std::invalid_argument as require_valid() for the styles of `rules`, as lay_edges()
  // (coast_edges.hpp) and LaidObjects for a chart that contradicts itself.
  CoastPreparer(CoastChart chart, GeoPoint anchor, const CoastRules& rules);
  ~CoastPreparer();
  CoastPreparer(CoastPreparer&&) noexcept;
  CoastPreparer& operator=(CoastPreparer&&) noexcept;

  // True while pictures for that position and range are exact: the chart window holds them and the
  // plane's anchor is near enough (kMaxAnchorDistance).
  bool serves(GeoPoint own_ship, double range_m) const;

  CoastPicturePtr prepare(GeoPoint own_ship, const RadarResolution& resolution);

  // The cost of the last picture, in chart edges.
  struct Effort {
    std::uint32_t straight = 0;  // nothing to be seen on them
    std::uint32_t reused = 0;    // from an earlier picture
    std::uint32_t refined = 0;
  };
  const Effort& last_effort() const;

  // The farthest the own ship may be from the plane's anchor, metres; LocalPlane's bound holds.
  static constexpr double kMaxAnchorDistance = 5000.0;
  // How far the own ship may move before a picture is made anew: 2 % of the range, at least 20 m.
  static double slack_for(double range_m);

 private:
  struct Laid;
  CoastChart chart_;
  LocalPlane plane_;
  std::uint64_t seed_;
  std::unique_ptr<Laid> laid_;
};

}  // namespace skerry::echo
