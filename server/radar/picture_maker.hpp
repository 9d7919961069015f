// PictureMaker: the coast that a wish asks for.
#pragma once

#include <memory>
#include <optional>

#include "echo/assembly/scene_maker.hpp"
#include "echo/chart/chart_source.hpp"

namespace skerry::server {

// A radar's wish: the coast around a place, as fine as the radar can tell apart.
struct CoastWish {
  GeoPoint own_ship;
  double speed_mps = 0.0;
  echo::RadarResolution resolution;
  // Names the wish among those of its slot: for a radar, the first spoke of the sector it was made
  // at, plus 1; 0 before the first.
  std::uint64_t tag = 0;
};

// The wishes that made a picture.  The picture is a function of these, the chart and the rules.
struct PictureOrigin {
  std::uint64_t wish = 0;  // tag of the one it was made for
  std::uint64_t laid = 0;  // tag of the one around which the chart was laid for it
  friend bool operator==(const PictureOrigin&, const PictureOrigin&) = default;
};

// The coast around an own ship and the index by which a place on it is looked up.  The picture is
// good for as far as its slack says, the index for a shorter way; neither changes what the other
// shows.
struct CoastInSight {
  echo::CoastPicturePtr picture;
  echo::CoastIndex index;
  PlanePoint index_centre;
  double index_slack_m = 0.0;
  PictureOrigin origin = {};
};
using CoastInSightPtr = std::shared_ptr<const CoastInSight>;

// The picture with an index around the place of the wish.
CoastInSight seen_from(const echo::CoastPicturePtr& picture, const CoastWish& wish,
                       const PictureOrigin& origin);

// Lays chart windows and makes pictures of them.  Thread: one at a time.
class PictureMaker {
 public:
  // Both must outlive it.
  PictureMaker(const echo::ChartSource& chart, const echo::CoastRules& rules)
      : chart_(chart), rules_(rules) {}

  // The chart around the wish's place.  Error: std::runtime_error if it cannot be read, and then
  // what was laid before stays.
  void lay(const CoastWish& wish);
  // Whether the coast is exact for that wish.
  bool serves(const CoastWish& wish) const;
  // Requires serves().
  echo::CoastPicturePtr picture(const CoastWish& wish);

 private:
  const echo::ChartSource& chart_;
  const echo::CoastRules& rules_;
  std::unique_ptr<echo::CoastPreparer> preparer_;
};

}  // namespace skerry::server
