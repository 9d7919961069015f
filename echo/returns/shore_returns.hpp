// Echoes of land with typed shores or charted heights.
#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "echo/chart/elevation_grid.hpp"
#include "echo/returns/cover_row.hpp"
#include "echo/returns/ground_track.hpp"
#include "echo/returns/land_returns.hpp"
#include "echo/returns/shore_stretch.hpp"

namespace skerry::echo {

// Heights from a raster under the ray.  Inside a chunk of cells latitude and longitude are joined
// straight: L^2 tan(latitude) / 8R off for a chunk of L metres, which is 2e-5 tan(latitude) of a
// cell for each metre of it.  Held by ShoreReturns.ReliefIsThatOfTheRasterAtTheCell.
struct ChartedRelief {
  const ElevationGrid& grid;
  GroundTrack track;
};

// The shadow of the land along a ray, for things on it and behind it; by cell.
struct GroundProfile {
  std::vector<float> shadow;    // slope (land_ray.hpp) below which all nearer land hides
  std::vector<float> height_m;  // of the ground over the water; 0 where it is water or all hidden
  void clear(std::size_t cells);
  // The shadow as it is now, for all cells before `end` that have none yet.
  void fill(std::size_t end, float slope) {
    for (; filled_ < end; ++filled_) shadow[filled_] = slope;
  }
  // Shadow and heights of the next cells, up to `end`, worked out elsewhere.
  void take(std::size_t end, const float* slopes, const float* heights) {
    std::copy(heights, heights + (end - filled_), height_m.data() + filled_);
    std::copy(slopes, slopes + (end - filled_), shadow.data() + filled_);
    filled_ = end;
  }

 private:
  std::size_t filled_ = 0;
};

// Adds as add_land() does, with shores by their types (shore_profile.hpp):
//   I: the face returns kFaceGamma times its height times the arc, at the edge and nowhere else but
//      where the edge runs along the ray, over as many cells as it covers within the arc.
//   III: gamma of the wet edge times 1 + 0.9 beach_noise, fading out 30 m and the swash inland.
// Land that is_plain() comes out with the bits of add_land(), unless there is `relief`.
// With `relief`, the raster's height is the ground's where it has data, and the synthetic one
// elsewhere; below its step roughness and bank stay synthetic.
// With `cover`, covered cells echo as kCoverEchoes has it, objects and gaps on the bare relief, but
// on the apron of a quay and the wet edge of sand.  Land without cover keeps its bits where no
// covered land stands before it.
// `profile`: null, or cleared for as many cells as `power` has; its heights are without objects.
void add_shores(std::span<const ShoreStretch> land, const LandModel& model, const ShoreWater& water,
                const LatticePath& path, const ChartedRelief* relief, GroundProfile* profile,
                std::span<float> power, const ChartedCover* cover = nullptr);

// The ground `range_m` along the ray, between the two shores of the stretch: by the nearer one
// where they are alike, from one type to the other in proportion to nearness where not.
// `roofs` as ground_behind() has it.
Ground ground_at(const ShoreStretch& stretch, double range_m, double broad_noise, double fine_noise,
                 bool roofs = true);

// The ground where a raster says `raster_m`: at least 0.5 m, and within one step of the shore at
// least what is left of the bank; `below_step_noise` in [-1, 1] roughens it.
double charted_height(const ShoreStretch& stretch, double range_m, double raster_m, double step_m,
                      double below_step_noise);

}  // namespace skerry::echo
