#include "server/app/options/charts.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <filesystem>
#include <stdexcept>

#include "echo/chart/gdal/open_chart.hpp"
#include "echo/chart/gshhg_reader.hpp"

namespace skerry::server {
namespace {

bool is_world(const std::filesystem::path& path) {
  if (path.extension() == ".nc") return true;
  std::error_code ignored;
  if (!std::filesystem::is_directory(path, ignored)) return false;
  const auto files = std::filesystem::directory_iterator(path, ignored);
  return std::any_of(begin(files), end(files),
                     [](const auto& entry) { return entry.path().extension() == ".nc"; });
}

bool world_is_installed() {
  try {
    return !echo::GshhgReader::find_finest().empty();
  } catch (const std::runtime_error&) {
    return false;
  }
}

void require_there(const std::string& path, const char* what) {
  std::error_code ignored;
  if (!path.empty() && std::filesystem::exists(path, ignored)) return;
  throw std::runtime_error("no " + std::string(what) + " " + path +
                           "; the world's shoreline comes with `apt-get install gmt-gshhg-full` "
                           "and is found without --chart");
}

}  // namespace

std::unique_ptr<const echo::ChartSource> open_charts(const std::vector<std::string>& charts,
                                                     const std::string& elevation) {
  std::vector<std::filesystem::path> paths;
  for (const std::string& chart : charts) {
    require_there(chart, "chart");
    paths.emplace_back(chart);
  }
  if (paths.empty() || (std::none_of(paths.begin(), paths.end(), is_world) && world_is_installed()))
    paths.emplace_back();  // the finest installed
  echo::OpenedChart opened = echo::open_charts(paths);
  for (const std::string& warning : opened.warnings) spdlog::warn("chart: {}", warning);
  if (!elevation.empty()) {
    require_there(elevation, "elevation");
    echo::OpenedElevation heights = echo::open_elevation(elevation);
    for (const std::string& warning : heights.warnings) spdlog::warn("elevation: {}", warning);
    spdlog::info("{}", heights.elevation->describe());
    opened.chart = echo::with_elevation(std::move(opened.chart), std::move(heights.elevation));
  }
  spdlog::info("chart: {}", opened.chart->describe());
  return std::move(opened.chart);
}

}  // namespace skerry::server
