#include "echo/chart/gshhg_reader.hpp"

#include <fmt/core.h>

#include <cmath>
#include <stdexcept>
#include <string>

#include "echo/chart/gshhg_bin.hpp"
#include "echo/chart/gshhg_file.hpp"

namespace skerry::echo {
namespace {

// Everything south of it belongs to Antarctica (GSHHG has no other land there but islands).
constexpr double kAntarcticLimit = -60.0;

CoastRing as_coast_ring(const GshhgGrid& grid, int bin, BinRing&& ring) {
  CoastRing out;
  out.level = ring.level;
  out.vertices.reserve(ring.points.size());
  out.vertex_ids.reserve(ring.points.size());
  for (const BinPoint p : ring.points) {
    out.vertices.push_back(grid.position(bin, p));
    out.vertex_ids.push_back(grid.identity(bin, p));
  }
  out.edges = std::move(ring.edges);
  out.edges.shrink_to_fit();
  return out;
}

}  // namespace

GshhgReader::GshhgReader(std::unique_ptr<const GshhgFile> file) : file_(std::move(file)) {}
GshhgReader::GshhgReader(GshhgReader&&) noexcept = default;
GshhgReader& GshhgReader::operator=(GshhgReader&&) noexcept = default;
GshhgReader::~GshhgReader() = default;

GshhgReader GshhgReader::open(const std::filesystem::path& file) {
  return GshhgReader(std::make_unique<const GshhgFile>(file));
}

std::filesystem::path GshhgReader::find_finest(
    const std::vector<std::filesystem::path>& directories) {
  for (const char detail : {'f', 'h', 'i', 'l', 'c'}) {
    for (const std::filesystem::path& directory : directories) {
      const auto file = directory / fmt::format("binned_GSHHS_{}.nc", detail);
      std::error_code ignored;
      if (std::filesystem::is_regular_file(file, ignored)) return file;
    }
  }
  std::string looked;
  for (const std::filesystem::path& directory : directories)
    looked += (looked.empty() ? "" : ", ") + directory.string();
  throw std::runtime_error(
      fmt::format("no world shoreline: no binned_GSHHS_{{f,h,i,l,c}}.nc in {}; install it with "
                  "`apt-get install gmt-gshhg-full` (32 MB; gmt-gshhg-high or gmt-gshhg-low for "
                  "coarser coasts)",
                  looked.empty() ? "(no directory)" : looked));
}

std::string GshhgReader::describe() const { return file_->source(); }

CoastChart GshhgReader::load(GeoPoint centre, Length radius) const {
  if (!(std::abs(centre.latitude_deg) <= 90.0) || !std::isfinite(centre.longitude_deg) ||
      !(radius.in_metres() >= 0.0))
    throw std::invalid_argument(fmt::format(
        "no chart window of radius {} m around latitude {}, longitude {}: expected a latitude "
        "within 90 degrees of the equator and a radius of 0 or more",
        radius.in_metres(), centre.latitude_deg, centre.longitude_deg));

  const GshhgGrid& grid = file_->grid();
  CoastChart chart;
  chart.centre = {centre.latitude_deg, wrapped_longitude(std::fmod(centre.longitude_deg, 360.0))};
  chart.radius_m = radius.in_metres();
  chart.source = file_->source();
  for (const BinRun run : grid.bins_within(chart.centre, chart.radius_m)) {
    for (const BinShore& shore : file_->read(run)) {
      try {
        for (BinRing& ring : assemble_bin(shore, grid.north_of(shore.bin) <= kAntarcticLimit))
          chart.rings.push_back(as_coast_ring(grid, shore.bin, std::move(ring)));
      } catch (const BinError& error) {
        throw std::runtime_error(
            fmt::format("chart file {}: bin {} (south-west corner {:.2f}, {:.2f}): {}; the file is "
                        "damaged",
                        file_->path().string(), shore.bin, grid.south_of(shore.bin),
                        grid.west_of(shore.bin), error.what()));
      }
    }
  }
  return chart;
}

}  // namespace skerry::echo
