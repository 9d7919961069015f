// What covers the land along one ray, and what stands on it.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "echo/chart/cover_grid.hpp"
#include "echo/returns/ground_track.hpp"
#include "echo/returns/land_returns.hpp"

namespace skerry::echo {

// The cover under a ray.
struct ChartedCover {
  const CoverGrid& grid;
  GroundTrack track;
};

// A row of covers, one byte a cell, read when a frame makes the ray, and only where land may show.
// Inside a chunk of cells latitude and longitude are joined straight, as ChartedRelief's are.
class CoverRow {
 public:
  // `path`: the ray over the Earth-fixed lattice, which places objects and gaps.
  CoverRow(const ChartedCover& charted, const LandModel& model, const LatticePath& path,
           std::size_t cells);

  // Reads cells first .. first + count - 1 unless they have been; whether any of them is covered.
  bool read(std::size_t first, std::size_t count);
  // Of a cell that has been read.
  LandCover at(std::size_t cell) const { return covers_[cell]; }
  // Heights of what stands on the ground of cells first .. first + out.size() - 1, at most
  // kLandChunk of them, metres; 0 where nothing does.  Grain finer than two cells is even: the
  // share of the height.
  void objects(std::size_t first, std::span<float> out) const;
  // objects() are nowhere higher.
  double most_objects(std::size_t first, std::size_t count) const;

 private:
  const ChartedCover& charted_;
  const LandModel& model_;
  const LatticePath& path_;
  std::vector<LandCover> covers_;
  std::vector<bool> read_;  // by chunk
  std::size_t known_chunk_ = ~std::size_t{0};
  GeoPoint known_{};  // the middle of the first cell of known_chunk_
};

}  // namespace skerry::echo
