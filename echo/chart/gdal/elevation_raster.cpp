#include "echo/chart/gdal/elevation_raster.hpp"

#include <fmt/core.h>
#include <gdal_utils.h>
#include <gdalwarper.h>
#include <ogr_spatialref.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

#include "echo/chart/gdal/coverage.hpp"
#include "echo/chart/gdal/gdal_session.hpp"

namespace skerry::echo {
namespace {

constexpr std::uintmax_t kMostRasterBytes = 64ull << 30;
constexpr std::size_t kMostFiles = 4000;
constexpr double kFeet = 0.3048;
// Heights of the Earth's ground, with room; beyond it is no height but an undeclared "no data".
constexpr float kLowest = -1000.0f, kHighest = 10000.0f;

const std::vector<const char*> kDrivers = {"GTiff", "DTED", "SRTMHGT"};

[[noreturn]] void refuse(const std::string& file, const std::string& why) {
  throw std::runtime_error(fmt::format("elevation file {}: {}", file, why));
}

std::vector<std::string> rasters_in(const std::filesystem::path& folder) {
  static constexpr std::array<std::string_view, 6> kEndings = {".tif", ".tiff", ".dt0",
                                                               ".dt1", ".dt2",  ".hgt"};
  std::vector<std::string> files;
  std::error_code error;
  for (std::filesystem::recursive_directory_iterator it(folder, error), end; !error && it != end;
       it.increment(error)) {
    std::string ending = it->path().extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (std::find(kEndings.begin(), kEndings.end(), ending) != kEndings.end())
      files.push_back(it->path().string());
    if (files.size() > kMostFiles)
      refuse(folder.string(), fmt::format("more than {} rasters", kMostFiles));
  }
  if (error) refuse(folder.string(), error.message());
  if (files.empty()) refuse(folder.string(), "no .tif, .dt0, .dt1, .dt2 or .hgt in this directory");
  std::sort(files.begin(), files.end());
  return files;
}

DatasetPtr mosaic_of(const std::vector<std::string>& files) {
  std::vector<const char*> names;
  for (const std::string& file : files) names.push_back(file.c_str());
  int misused = FALSE;
  return DatasetPtr(GDALDataset::FromHandle(
      GDALBuildVRT("", static_cast<int>(names.size()), nullptr, names.data(), nullptr, &misused)));
}

bool is_north_up_geographic(GDALDataset& dataset) {
  const OGRSpatialReference* stated = dataset.GetSpatialRef();
  std::array<double, 6> place{};
  return stated != nullptr && stated->IsGeographic() &&
         dataset.GetGeoTransform(place.data()) == CE_None && place[2] == 0.0 && place[4] == 0.0 &&
         place[1] > 0.0 && place[5] < 0.0;
}

DatasetPtr warped(GDALDataset& dataset) {
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  char* text = nullptr;
  wgs84.exportToWkt(&text);
  const std::unique_ptr<char, void (*)(void*)> wkt(text, [](void* p) { CPLFree(p); });
  return DatasetPtr(GDALDataset::FromHandle(
      GDALAutoCreateWarpedVRT(&dataset, nullptr, wkt.get(), GRA_Bilinear, 0.125, nullptr)));
}

// Pixels [first, first + count) of an axis of `size`.
struct Stretch {
  int first = 0, count = 0;
};
Stretch stretch_between(double from, double to, int size) {
  const double first = std::clamp(std::floor(from) - 1.0, 0.0, static_cast<double>(size));
  const double end = std::clamp(std::ceil(to) + 1.0, 0.0, static_cast<double>(size));
  return {static_cast<int>(first), static_cast<int>(std::max(0.0, end - first))};
}

float metres_per_unit(GDALRasterBand& band) {
  std::string unit = band.GetUnitType() ? band.GetUnitType() : "";
  for (char& c : unit) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return unit == "ft" || unit == "feet" || unit == "foot" ? static_cast<float>(kFeet) : 1.0f;
}

}  // namespace

void ElevationRaster::Close::operator()(GDALDataset* dataset) const { GDALClose(dataset); }
ElevationRaster::ElevationRaster(ElevationRaster&&) noexcept = default;
ElevationRaster& ElevationRaster::operator=(ElevationRaster&& other) noexcept {
  while (!layers_.empty()) layers_.pop_back();
  file_ = std::move(other.file_);
  source_ = std::move(other.source_);
  layers_ = std::move(other.layers_);
  return *this;
}
ElevationRaster::~ElevationRaster() {
  while (!layers_.empty()) layers_.pop_back();
}

ElevationRaster ElevationRaster::open(const std::filesystem::path& path,
                                      std::vector<std::string>& warnings) {
  GdalErrors errors;
  ElevationRaster raster;
  raster.file_ = path.string();
  const auto keep = [&](DatasetPtr dataset, const char* what) {
    if (!dataset) refuse(raster.file_, fmt::format("{}: {}", what, errors.text()));
    raster.layers_.emplace_back(dataset.release());
  };
  if (std::filesystem::is_directory(path)) {
    const std::vector<std::string> files = rasters_in(path);
    for (const std::string& file : files) {
      DatasetPtr one = open_dataset(file, GDAL_OF_RASTER, kDrivers, {});  // registers the drivers
      if (!one) refuse(file, errors.text());
    }
    keep(mosaic_of(files), "cannot be laid side by side");
  } else {
    require_file(path, kMostRasterBytes);
    keep(open_dataset(raster.file_, GDAL_OF_RASTER, kDrivers, {}),
         "expected GeoTIFF, DTED or SRTM");
  }
  GDALDataset& first = *raster.layers_.back();
  if (first.GetRasterCount() < 1) refuse(raster.file_, "has no band");
  if (!is_north_up_geographic(first)) {
    std::array<double, 6> place{};
    if (first.GetSpatialRef() == nullptr || first.GetGeoTransform(place.data()) != CE_None)
      refuse(raster.file_, "states no place on the Earth (reference system and geotransform)");
    keep(warped(first), "cannot be brought to latitude and longitude");
  }
  GDALDataset& last = *raster.layers_.back();
  std::array<double, 6> place{};
  if (last.GetGeoTransform(place.data()) != CE_None || !(place[1] > 0.0) || !(place[5] < 0.0) ||
      !(std::abs(place[3]) <= 91.0) || !(std::abs(place[0]) <= 540.0))
    refuse(raster.file_, "lies nowhere on the Earth");
  raster.source_ = fmt::format("elevation {}, {} x {} posts", path.filename().string(),
                               last.GetRasterXSize(), last.GetRasterYSize());
  if (errors.count() > 0) warnings.push_back(fmt::format("{}: {}", raster.file_, errors.text()));
  return raster;
}

std::shared_ptr<const ElevationGrid> ElevationRaster::load(GeoPoint centre, Length radius) const {
  GdalErrors errors;
  GDALDataset& dataset = *layers_.back();
  GDALRasterBand& band = *dataset.GetRasterBand(1);
  std::array<double, 6> place{};
  if (dataset.GetGeoTransform(place.data()) != CE_None)
    refuse(file_, "states no place on the Earth");
  const double reach = 1.01 * radius.in_metres() / kLeastMetresPerDegree;
  const double shrink =
      std::cos(std::min(89.0, std::abs(centre.latitude_deg) + reach) * std::numbers::pi / 180.0);
  const double aside = std::min(180.0, reach / shrink);
  const int columns = dataset.GetRasterXSize(), rows = dataset.GetRasterYSize();
  // The raster's own count of longitudes, which may go beyond 180.
  const double middle = place[0] + 0.5 * columns * place[1];
  const double x = middle + wrapped_longitude(std::fmod(centre.longitude_deg - middle, 360.0));
  const Stretch across = stretch_between((x - aside - place[0]) / place[1],
                                         (x + aside - place[0]) / place[1], columns);
  const Stretch down = stretch_between((centre.latitude_deg + reach - place[3]) / place[5],
                                       (centre.latitude_deg - reach - place[3]) / place[5], rows);
  if (across.count == 0 || down.count == 0) return nullptr;

  const double posts = static_cast<double>(across.count) * down.count;
  const double thin = std::max(1.0, std::sqrt(posts / kMostPosts));
  auto grid = std::make_shared<ElevationGrid>();
  grid->columns = std::max(1, static_cast<int>(across.count / thin));
  grid->rows = std::max(1, static_cast<int>(down.count / thin));
  const double step_x = place[1] * across.count / grid->columns;
  const double step_y = -place[5] * down.count / grid->rows;
  grid->west_deg = wrapped_longitude(place[0] + place[1] * across.first + 0.5 * step_x);
  grid->south_deg = place[3] + place[5] * (down.first + down.count) + 0.5 * step_y;
  grid->step_lon_deg = step_x;
  grid->step_lat_deg = step_y;
  grid->source = source_;
  const auto width = static_cast<std::size_t>(grid->columns);
  const auto height = static_cast<std::size_t>(grid->rows);
  std::vector<float>& heights = grid->heights_m;
  heights.resize(width * height);

  GDALRasterIOExtraArg how;
  INIT_RASTERIO_EXTRA_ARG(how);
  if (thin > 1.0) how.eResampleAlg = GRIORA_Bilinear;
  if (band.RasterIO(GF_Read, across.first, down.first, across.count, down.count, heights.data(),
                    grid->columns, grid->rows, GDT_Float32, 0, 0, &how) != CE_None)
    refuse(file_, errors.text());

  int has_no_data = FALSE;
  const auto no_data = static_cast<float>(band.GetNoDataValue(&has_no_data));
  const auto scale = static_cast<float>(band.GetScale()),
             offset = static_cast<float>(band.GetOffset());
  const float unit = metres_per_unit(band);
  for (float& h : heights) {
    const bool none = (has_no_data && h == no_data) || !std::isfinite(h);
    h = (h * scale + offset) * unit;
    if (none || !(h >= kLowest && h <= kHighest)) h = std::numeric_limits<float>::quiet_NaN();
  }
  for (std::size_t r = 0; r < height / 2; ++r)
    std::swap_ranges(heights.begin() + static_cast<std::ptrdiff_t>(r * width),
                     heights.begin() + static_cast<std::ptrdiff_t>((r + 1) * width),
                     heights.begin() + static_cast<std::ptrdiff_t>((height - 1 - r) * width));
  return grid;
}

}  // namespace skerry::echo
