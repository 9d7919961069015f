// ElevationRaster: heights of the ground out of GeoTIFF, DTED or SRTM files.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "echo/chart/elevation_grid.hpp"
#include "protocol/quantity/length.hpp"

class GDALDataset;

namespace skerry::echo {

// Thread: one at a time.
class ElevationRaster {
 public:
  // The most posts of a grid handed out: 64 MB.
  static constexpr int kMostPosts = 16'000'000;

  // A file, or a directory whose .tif, .tiff, .dt0, .dt1, .dt2 and .hgt files lie side by side (at
  // most 4000).  Rasters of other reference systems are brought to latitude and longitude.
  // Error: std::runtime_error naming the file and the reason.
  static ElevationRaster open(const std::filesystem::path& path,
                              std::vector<std::string>& warnings);

  ElevationRaster(ElevationRaster&&) noexcept;
  ElevationRaster& operator=(ElevationRaster&&) noexcept;
  ~ElevationRaster();

  // The part within `radius` of `centre`, posts at the middles of the raster's pixels, with no data
  // as NaN; every second, third ... pixel by bilinear resampling where it has more than kMostPosts.
  // Heights are in metres as band 1 has them, by its scale and offset, feet brought to metres.
  // Null if the raster has nothing there.
  // Error: std::runtime_error for a file that cannot be read there.
  std::shared_ptr<const ElevationGrid> load(GeoPoint centre, Length radius) const;

  std::string describe() const { return source_; }  // "elevation bergen.tif, 1800 x 1200 posts"

 private:
  struct Close {
    void operator()(GDALDataset* dataset) const;
  };
  ElevationRaster() = default;

  std::string file_, source_;
  std::vector<std::unique_ptr<GDALDataset, Close>> layers_;  // each over the one before
};

}  // namespace skerry::echo
