// Charts and elevations by the name of a file or directory.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "echo/chart/chart_source.hpp"
#include "echo/chart/gdal/elevation_raster.hpp"

namespace skerry::echo {

struct OpenedChart {
  std::unique_ptr<ChartSource> chart;
  std::vector<std::string> warnings;  // what of it cannot be used, by file and object
};

// Opens a chart by its name:
//  - .nc: a file of GSHHG; .000: an ENC cell, its updates beside it; .geojson, .json, .shp: land
//    drawn by anyone.
//  - a directory: all ENC cells in it and below (an ENC_ROOT; at most 500), those of larger scale
//    over those of smaller; a cell that cannot be read is a warning if another can.  Without cells,
//    the finest GSHHG file in it.
//  - empty: the finest GSHHG file installed.
// Several paths: the first over the others.
// Error: std::runtime_error naming the file and what is wrong where.
OpenedChart open_chart(const std::filesystem::path& path);
OpenedChart open_charts(const std::vector<std::filesystem::path>& paths);

struct OpenedElevation {
  std::unique_ptr<ElevationRaster> elevation;
  std::vector<std::string> warnings;
};
// Error: std::runtime_error as ElevationRaster::open().
OpenedElevation open_elevation(const std::filesystem::path& path);

// `chart` with the heights of `elevation` in every window.
std::unique_ptr<ChartSource> with_elevation(std::unique_ptr<ChartSource> chart,
                                            std::unique_ptr<ElevationRaster> elevation);

}  // namespace skerry::echo
