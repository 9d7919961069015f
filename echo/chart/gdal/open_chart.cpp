#include "echo/chart/gdal/open_chart.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <stdexcept>

#include "echo/chart/gdal/layered_chart.hpp"
#include "echo/chart/gdal/s57/s57_chart.hpp"
#include "echo/chart/gdal/vector_chart.hpp"
#include "echo/chart/gshhg_reader.hpp"

namespace skerry::echo {
namespace {

constexpr std::size_t kMostCells = 500;
constexpr std::size_t kMostEntries = 200'000;

std::string ending_of(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return ending;
}

std::unique_ptr<ChartSource> open_gshhg(const std::filesystem::path& file) {
  return std::make_unique<GshhgReader>(GshhgReader::open(file));
}

std::vector<std::filesystem::path> cells_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> cells;
  std::error_code error;
  std::size_t seen = 0;
  for (std::filesystem::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    if (++seen > kMostEntries)
      throw std::runtime_error(
          fmt::format("chart directory {}: more than {} files", folder.string(), kMostEntries));
    if (ending_of(it->path()) == ".000") cells.push_back(it->path());
  }
  if (error)
    throw std::runtime_error(
        fmt::format("chart directory {}: {}", folder.string(), error.message()));
  if (cells.size() > kMostCells)
    throw std::runtime_error(
        fmt::format("chart directory {}: {} cells, more than the {} allowed; name a directory with "
                    "fewer",
                    folder.string(), cells.size(), kMostCells));
  std::sort(cells.begin(), cells.end());
  return cells;
}

OpenedChart open_cells(const std::vector<std::filesystem::path>& files) {
  OpenedChart opened;
  std::vector<std::unique_ptr<S57Chart>> cells;
  std::string last_error;
  for (const std::filesystem::path& file : files) {
    try {
      cells.push_back(std::make_unique<S57Chart>(S57Chart::open(file, opened.warnings)));
    } catch (const std::runtime_error& error) {
      last_error = error.what();
      opened.warnings.push_back(last_error + "; the cell is left out");
    }
  }
  if (cells.empty()) throw std::runtime_error(last_error);
  // The smaller the denominator, the larger the scale; 0 is unknown and goes last.
  std::stable_sort(cells.begin(), cells.end(), [](const auto& a, const auto& b) {
    const auto rank = [](int scale) { return scale > 0 ? scale : 1'000'000'000; };
    return rank(a->scale()) < rank(b->scale());
  });
  if (cells.size() == 1) {
    opened.chart = std::move(cells.front());
    return opened;
  }
  std::vector<std::unique_ptr<ChartSource>> layers;
  for (auto& cell : cells) layers.push_back(std::move(cell));
  opened.chart = std::make_unique<LayeredChart>(std::move(layers));
  return opened;
}

class ElevatedChart final : public CoveredChart {
 public:
  ElevatedChart(std::unique_ptr<ChartSource> chart, std::unique_ptr<ElevationRaster> elevation)
      : chart_(std::move(chart)), elevation_(std::move(elevation)) {
    if (const auto* covered = dynamic_cast<const CoveredChart*>(chart_.get()))
      coverage_ = covered->coverage();
  }
  CoastChart load(GeoPoint centre, Length radius) const override {
    CoastChart chart = chart_->load(centre, radius);
    if (auto heights = elevation_->load(centre, radius)) chart.elevation = std::move(heights);
    return chart;
  }
  ChartDetail detail(GeoPoint centre, Length radius) const override {
    return chart_->detail(centre, radius);
  }
  std::string describe() const override {
    return chart_->describe() + " with " + elevation_->describe();
  }
  const Coverage& coverage() const override { return coverage_; }

 private:
  std::unique_ptr<ChartSource> chart_;
  std::unique_ptr<ElevationRaster> elevation_;
  Coverage coverage_;
};

}  // namespace

OpenedChart open_chart(const std::filesystem::path& path) {
  OpenedChart opened;
  if (path.empty()) {
    opened.chart = open_gshhg(GshhgReader::find_finest());
    return opened;
  }
  std::error_code error;
  if (std::filesystem::is_directory(path, error)) {
    const auto cells = cells_below(path);
    if (!cells.empty()) return open_cells(cells);
    opened.chart = open_gshhg(GshhgReader::find_finest({path}));
    return opened;
  }
  const std::string ending = ending_of(path);
  if (ending == ".nc") {
    opened.chart = open_gshhg(path);
  } else if (ending == ".000") {
    opened.chart = std::make_unique<S57Chart>(S57Chart::open(path, opened.warnings));
  } else if (ending == ".geojson" || ending == ".json" || ending == ".shp") {
    opened.chart = std::make_unique<VectorChart>(VectorChart::open(path, opened.warnings));
  } else {
    throw std::runtime_error(fmt::format(
        "chart file {}: expected .nc (GSHHG), .000 (S-57 ENC), .geojson, .json, .shp, or "
        "a directory of them",
        path.string()));
  }
  return opened;
}

OpenedChart open_charts(const std::vector<std::filesystem::path>& paths) {
  if (paths.empty()) return open_chart({});
  if (paths.size() == 1) return open_chart(paths.front());
  OpenedChart all;
  std::vector<std::unique_ptr<ChartSource>> layers;
  for (const std::filesystem::path& path : paths) {
    OpenedChart one = open_chart(path);
    layers.push_back(std::move(one.chart));
    all.warnings.insert(all.warnings.end(), one.warnings.begin(), one.warnings.end());
  }
  all.chart = std::make_unique<LayeredChart>(std::move(layers));
  return all;
}

OpenedElevation open_elevation(const std::filesystem::path& path) {
  OpenedElevation opened;
  opened.elevation =
      std::make_unique<ElevationRaster>(ElevationRaster::open(path, opened.warnings));
  return opened;
}

std::unique_ptr<ChartSource> with_elevation(std::unique_ptr<ChartSource> chart,
                                            std::unique_ptr<ElevationRaster> elevation) {
  return std::make_unique<ElevatedChart>(std::move(chart), std::move(elevation));
}

}  // namespace skerry::echo
